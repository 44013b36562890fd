#!/usr/bin/env python3
"""Plots front.csv and textures.csv (time against error, by regime; orders by themselves) and cost.csv (cost against work) of a directory, as SVG and PNG."""
import csv
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
# Letters stay letters, and the same table gives the same file.
matplotlib.rcParams.update({"svg.fonttype": "none", "font.sans-serif": ["DejaVu Sans"], "svg.hashsalt": "CalcMySky"})
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

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


def plain_log(axis, steps):
    """Plain numbers and lines at `steps` of each decade and nothing between, which would be most of an SVG."""
    axis.set_major_locator(LogLocator(subs=steps))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
    axis.grid(True, alpha=0.3)


def has_fewer_orders(row):
    return row["label"].endswith(" orders")


def plot_front(directory):
    rows = [row for row in read(directory / "front.csv") if not has_fewer_orders(row)]
    names = list(dict.fromkeys(row["name"] for row in rows))
    figure, axes = plt.subplots(len(names), 4, figsize=(14, 2.8 * len(names)), squeeze=False, sharex=True, sharey="row")
    for line, name in zip(axes, names):
        lowest = math.inf
        for axis, (regime, title) in zip(line, REGIMES.items()):
            mine = [row for row in rows if row["name"] == name]
            floor = max(1e-4, min(0.5 * float(row[regime + "_uncertainty"]) for row in mine) * 100)

            def point(row):
                return float(row["processor_s"]), max(floor, 100 * float(row[regime]))

            lowest = min(lowest, *(point(row)[1] for row in mine))
            axis.plot(*zip(*map(point, mine)), ".", color="0.6")
            axis.plot(*zip(*pareto(map(point, mine))), color="tab:blue", linewidth=1, drawstyle="steps-post")
            for row in mine:
                if row["label"] in PRESETS:
                    x, y = point(row)
                    axis.errorbar(x, y, 100 * float(row[regime + "_uncertainty"]), fmt=PRESETS[row["label"]], color="tab:red")
                    axis.annotate(row["label"], (x, y), textcoords="offset points", xytext=(5, 5))
            axis.set(xscale="log", yscale="log", title=f"{name}: {title}")
            axis.margins(0.12)
            axis.tick_params(bottom=False, left=False)
            plain_log(axis.xaxis, (1, 3))
            plain_log(axis.yaxis, (1, 2, 5))
        line[0].set(ylabel="rms error, %", ylim=(0.7 * lowest, None))
    for axis in axes[-1]:
        axis.set_xlabel("processor time of the moments, s")
    figure.tight_layout()
    save(figure, directory, "front")


def plot_orders(directory):
    """Airs whose judge has all orders: what fewer of them lack, and what they save."""
    rows = read(directory / "front.csv")
    fewer = [row for row in rows if has_fewer_orders(row) and row["label"].startswith("normal")]
    whole = [row for row in rows if row["label"] == "normal"]
    figure, axes = plt.subplots(1, 4, figsize=(14, 3.6), sharey=True)
    for axis, (regime, title) in zip(axes, REGIMES.items()):
        for name in dict.fromkeys(row["name"] for row in fewer):
            mine = [row for row in fewer + whole if row["name"] == name]
            points = [(float(row["processor_s"]), max(0.02, 100 * float(row[regime]))) for row in mine]
            axis.plot(*zip(*points), marker="o", markersize=3, linewidth=1, label=name)
            for (x, y), row in zip(points, mine):
                axis.annotate(row["label"].split()[1] if has_fewer_orders(row) else "all", (x, y), textcoords="offset points", xytext=(3, 3), fontsize=7)
        axis.set(xscale="log", yscale="log", title=title, xlabel="processor time of the moments, s")
        plain_log(axis.xaxis, (1, 3))
        plain_log(axis.yaxis, (1,))
    axes[0].set_ylabel("rms error, %")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncol=6, frameon=False)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    save(figure, directory, "orders")


def plot_textures(directory):
    rows = read(directory / "textures.csv")
    figure, axes = plt.subplots(1, 4, figsize=(14, 3.6))
    for axis, title in zip(axes, REGIMES.values()):
        points = [(float(row["processor_s"]), float(row[title])) for row in rows]
        axis.plot(*zip(*pareto(points)), color="tab:blue", linewidth=1, drawstyle="steps-post")
        for index, (row, (x, y)) in enumerate(zip(rows, points)):
            known = row["label"] in ("small", "full")
            axis.plot(x, y, "D" if known else ".", color="black" if known else f"C{index}", label=row["label"])
        axis.set(xscale="log", yscale="log", title=title, xlabel="processor time, s")
        axis.margins(0.12)
        plain_log(axis.xaxis, (1, 3))
        plain_log(axis.yaxis, (1, 2, 5))
    axes[0].set_ylabel("rms error of textures, %")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncol=6, frameon=False)
    figure.tight_layout(rect=(0, 0.14, 1, 1))
    save(figure, directory, "textures")


def slope(points):
    """Exponent of the power law that fits best, by least squares of the logarithms."""
    x, y = ([math.log(value) for value in values] for values in zip(*points))
    middle, height = sum(x) / len(x), sum(y) / len(y)
    return sum((a - middle) * (b - height) for a, b in zip(x, y)) / sum((a - middle) ** 2 for a in x)


def costs(directory):
    """Work and processor time, by what was varied: of the moments, then of the baked tables."""
    rows = read(directory / "cost.csv")
    moments = {name: [(float(r["work"]), float(r["processor_s"])) for r in rows if r["axis"] == name] for name in dict.fromkeys(r["axis"] for r in rows)}
    texels = [(math.prod(int(row[axis]) for axis in ("view angles", "azimuths", "suns", "altitudes")), float(row["processor_s"]))
              for row in read(directory / "textures.csv")]
    return moments, sorted(texels)


def plot_cost(directory):
    moments, texels = costs(directory)
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5))
    for name, points in moments.items():
        last = slope(points[-2:]) # what counts when there is much of it
        left.plot(*zip(*[(x / points[0][0], y) for x, y in points]), marker="o", label=f"{name}: exponent {slope(points):.2f}, at the end {last:.2f}")
        print(f"{name:12} exponent {slope(points):5.2f}, at the end {last:5.2f}   " + ", ".join(f"{x:g}: {y:.2f} s" for x, y in points))
    left.set(xlabel="work, relative to the least", ylabel="processor time of the moments, s")
    right.plot(*zip(*texels), ".")
    ends = [texels[0][0], texels[-1][0]]
    exponent, level = slope(texels), sum(math.log(y) - slope(texels) * math.log(x) for x, y in texels) / len(texels)
    right.plot(ends, [math.exp(level) * x**exponent for x in ends], color="0.6", label=f"exponent {exponent:.2f}")
    print(f"{'texels':12} exponent {exponent:5.2f}   " + ", ".join(f"{x:g}: {y:.2f} s" for x, y in texels))
    right.set(xlabel="texels of each table of scattering", ylabel="processor time of the tables, s")
    for axis in (left, right):
        axis.set(xscale="log", yscale="log")
        axis.grid(True, which="both", alpha=0.2)
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=2, fontsize=8, frameon=False)
    figure.tight_layout()
    save(figure, directory, "cost")


if __name__ == "__main__":
    out = Path(sys.argv[1])
    plot_front(out)
    plot_orders(out)
    plot_textures(out)
    plot_cost(out)
