#!/usr/bin/env python3
"""Zenith brightness against the distance to a city, beside Walker's law (brightness ~ distance^-2.5).

    PYTHONPATH=showmysky/python SHOWMYSKY_LIBRARY=BUILD/lib/libShowMySky.so bench/light_pollution.py MODEL [PICTURE.svg]

Prints luminances of the zenith (cd/m^2) for a city of 5 km radius and 1 cd/m^2, the logarithmic slope between neighbours, and what
one city takes of time. With a picture it draws the curve.
"""

import sys
import time

import numpy as np

import showmysky

RADIUS, LUMINANCE = 5e3, 1.0
DISTANCES = np.array([7.5, 10, 15, 20, 30, 40, 50, 70, 100, 150, 200]) * 1e3


def main():
    sky = showmysky.Photometer(sys.argv[1])

    def zenith(distance):
        light = sky.city_radiance(0.0, 0.0, 0.0, [(distance, 0.0, RADIUS, LUMINANCE)])
        return sky.colour(light)[1]

    start = time.perf_counter()
    zenith(1e3)
    print(f"first question about a radius: {time.perf_counter() - start:.2f} s")
    start = time.perf_counter()
    values = np.array([zenith(d) for d in DISTANCES])
    print(f"each question after that:      {(time.perf_counter() - start) / len(DISTANCES) * 1e6:.0f} us\n")
    slopes = np.diff(np.log(values)) / np.diff(np.log(DISTANCES))
    print("distance km   zenith cd/m^2   slope from the line above")
    for i, (distance, value) in enumerate(zip(DISTANCES, values)):
        print(f"{distance / 1e3:11.1f}   {value:13.3e}" + (f"   {slopes[i - 1]:6.2f}" if i else ""))
    near = (DISTANCES >= 10e3) & (DISTANCES <= 50e3)
    print(f"\nslope fitted from 10 to 50 km: {np.polyfit(np.log(DISTANCES[near]), np.log(values[near]), 1)[0]:.2f}")
    if len(sys.argv) > 2:
        draw(values, sys.argv[2])


def draw(values, path):
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "walker"
    import matplotlib.pyplot as plt

    _, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    axes.loglog(DISTANCES / 1e3, values, "o-", label="zenith, all orders, curved planet")
    anchor = int(np.searchsorted(DISTANCES, 20e3))
    axes.loglog(DISTANCES / 1e3, values[anchor] * (DISTANCES / DISTANCES[anchor]) ** -2.5, "--", label="Walker's law, distance$^{-2.5}$")
    axes.set_xlabel("distance to a city of 5 km radius, 1 cd/m², km")
    axes.set_ylabel("luminance of the zenith, cd/m²")
    axes.grid(True, which="both", alpha=0.3)
    axes.legend()
    plt.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main()
