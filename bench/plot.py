#!/usr/bin/env python3
"""Plots front.csv (time against error, by regime) and cost.csv (cost against work) of a directory, as SVG and PNG."""
import csv
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["svg.fonttype"] = "none"
import matplotlib.pyplot as plt

REGIMES = {"day": "day", "sunset": "sunset", "twilight": "twilight", "high": "from high up"}
PRESETS = {"draft": "s", "normal": "D", "good": "P", "fine": "^", "finer": "v", "reference": "*"}


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def pareto(points):
    """Those (time, error) that no quicker point beats."""
    best, kept = math.inf, []
    for time, error in sorted(points):
        if error < best:
            best = error
            kept.append((time, error))
    return kept


def save(figure, directory, name):
    for ending in ("svg", "png"):
        figure.savefig(directory / f"{name}.{ending}", dpi=110, metadata={"Date": None} if ending == "svg" else None)


def plot_front(directory):
    rows = read(directory / "front.csv")
    names = list(dict.fromkeys(row["name"] for row in rows))
    figure, axes = plt.subplots(len(names), 4, figsize=(14, 2.8 * len(names)), squeeze=False, sharex=True, sharey="row")
    for line, name in zip(axes, names):
        for axis, (regime, title) in zip(line, REGIMES.items()):
            mine = [row for row in rows if row["name"] == name]
            floor = max(1e-4, min(0.5 * float(row[regime + "_uncertainty"]) for row in mine) * 100)

            def point(row):
                return float(row["processor_s"]), max(floor, 100 * float(row[regime]))

            axis.scatter(*zip(*map(point, mine)), s=10, color="0.6")
            axis.plot(*zip(*pareto(map(point, mine))), color="tab:blue", linewidth=1, drawstyle="steps-post")
            for row in mine:
                if row["label"] in PRESETS:
                    x, y = point(row)
                    axis.errorbar(x, y, 100 * float(row[regime + "_uncertainty"]), color="tab:red", marker=PRESETS[row["label"]])
                    axis.annotate(row["label"], (x, y), textcoords="offset points", xytext=(5, 5))
            axis.set(xscale="log", yscale="log", title=f"{name}: {title}")
            axis.grid(True, which="both", alpha=0.2)
        line[0].set_ylabel("rms error, %")
    for axis in axes[-1]:
        axis.set_xlabel("processor time of the moments, s")
    figure.tight_layout()
    save(figure, directory, "front")


def slope(points):
    """Exponent of a power law between the two largest amounts of work: what counts when there is much."""
    (x0, y0), (x1, y1) = points[-2:]
    return math.log(y1 / y0) / math.log(x1 / x0)


def plot_cost(directory):
    rows = read(directory / "cost.csv")
    figure, axis = plt.subplots(figsize=(7, 4.5))
    for name in dict.fromkeys(row["axis"] for row in rows):
        points = [(float(r["work"]), float(r["processor_s"])) for r in rows if r["axis"] == name]
        axis.plot(*zip(*[(x / points[0][0], y) for x, y in points]), marker="o", label=f"{name}: exponent {slope(points):.2f}")
        print(f"{name:12} exponent {slope(points):5.2f}   " + ", ".join(f"{x:g}: {y:.2f} s" for x, y in points))
    axis.set(xscale="log", yscale="log", xlabel="work, relative to the least", ylabel="processor time of the moments, s")
    axis.grid(True, which="both", alpha=0.2)
    axis.legend()
    figure.tight_layout()
    save(figure, directory, "cost")


if __name__ == "__main__":
    out = Path(sys.argv[1])
    plot_front(out)
    plot_cost(out)
