#!/usr/bin/env python3
"""What is asked of a model by campaign.py, and the complaints about its answers. Metres and radians.

    tests/stress/judge.py MODEL FACTS.json

asks both methods of answering and prints, as JSON, the complaints, the largest difference between the two and where, of bright light and of faint, and
whether there are several orders. Needs NumPy, and the library in $SHOWMYSKY_LIBRARY.
"""
import json
import math
import os
import sys

import numpy as np

JUMP = 0.05 # of the radiance: between two views or places that are all but the same
SURPLUS = 1.05 # of the energy that comes in: the quadratures of these checks are good to a few per cent
DARKNESS = 1e-14 # of sunlight, per sr: less is nobody's light, as `calcmysky verify` has it too


def dip(facts, altitude):
    """Of the horizon below the horizontal."""
    return math.atan2(math.sqrt(altitude * (altitude + 2 * facts["planet"])), facts["planet"])


def altitudes(facts):
    """On the ground, next to it and inside; below, at and above the top, and far out in space."""
    top = facts["top"]
    return [0.0, 1e-6 * top, 0.37 * top, math.nextafter(top, 0), top, top * (1 + 1e-12), 3 * top, 10 * (facts["planet"] + top)]


def special_places(facts):
    """Rows of altitude, Sun zenith, view zenith, relative azimuth: Sun and view at zenith, nadir, horizon, horizontal, equal and opposite."""
    rows = []
    for altitude in altitudes(facts):
        horizon = math.pi / 2 + dip(facts, altitude)
        for sun in (0.0, math.pi / 4, math.pi / 2, horizon, horizon + 0.05, 3.0, math.pi):
            sun = min(sun, math.pi)
            for view in (0.0, sun, 1.0, math.pi / 2, horizon - 0.002, horizon, horizon + 1e-9, 2.5, math.pi):
                rows.append((altitude, sun, min(view, math.pi), 0.0))
            rows += [(altitude, sun, math.pi - sun, math.pi), (altitude, sun, 1.0, math.pi / 2)]
    return np.array(rows)


def steps(facts):
    """Pairs of places that are neighbours in one of the coordinates: where it begins, and one unit of the step."""
    pairs = []
    top = facts["top"]
    for altitude in (0.0, 0.37 * top, top, 3 * top):
        horizon = math.pi / 2 + dip(facts, altitude)
        for sun in (0.0, 1.0, math.pi / 2, horizon, min(math.pi, horizon + 0.01), 2.0):
            for view in (0.3, sun, math.pi / 2, horizon - 0.002, horizon + 0.01, 2.9):
                start = (altitude, sun, min(view, math.pi - 1e-3), 0.5)
                pairs += [(start, (0, 0, 1, 0)), (start, (0, 1, 0, 0)), (start, (0, 0, 0, 1))]
            for view in (0.3, 1.2, 2.9):
                pairs.append(((altitude, sun, view, 0.5), (top, 0, 0, 0)))
    return [pair for pair in pairs if not crosses_edge(facts, *pair)]


def crosses_edge(facts, start, unit):
    """Where ground and sky meet there is a jump; and horizontally from the top, where the way through the air begins with any length."""
    horizon, horizontal = (abs(start[2] - math.pi / 2 - below) < 1e-4 for below in (dip(facts, start[0]), 0.0))
    return (horizon or horizontal and start[0] == facts["top"]) and (unit[2] or unit[0])


def place(row):
    return "altitude {:.6g} m, Sun {:.5f}, view {:.5f}, azimuth {:.3g} deg".format(row[0], *np.degrees(row[1:]))


def judge_values(light, layers, facts):
    rows = special_places(facts)
    values = light.radiance(*rows.T, layers=layers)
    bad = ~np.isfinite(values).all(axis=1)
    complaints = [f"not finite at {place(row)}" for row in rows[bad]]
    complaints += [f"negative at {place(row)}" for row in rows[~bad & (np.nan_to_num(values).min(axis=1) < 0)]]
    for altitude in altitudes(facts):
        for angle in (0.0, 1.0, math.pi / 2, math.pi / 2 + dip(facts, altitude), math.pi):
            through, sun = light.transmittance(altitude, angle), light.sun_irradiance(altitude, angle)
            for what, numbers in (("transmittance", through), ("sunlight", sun / np.maximum(light.solar_irradiance, 1e-300))):
                if not (np.isfinite(numbers).all() and numbers.min() >= 0 and numbers.max() <= 1 + 1e-9):
                    complaints.append(f"{what} {numbers.min():g}..{numbers.max():g} at {altitude:.6g} m, {math.degrees(angle):.5f} deg")
    return complaints


def judge_steps(light, layers, facts):
    """A jump is what remains however near the two places are: what a steep but continuous curve does shrinks with the step."""
    suspects, brightest = steps(facts), None
    for size in (1e-5, 1e-7, 1e-9):
        if not suspects:
            return []
        starts, units = (np.array(part, dtype=float) for part in zip(*suspects))
        a, b = (light.radiance(*rows.T, layers=layers) for rows in (starts, starts + size * units))
        brightest = brightest or max(a.max(), 1e-300)
        larger = np.maximum(np.abs(a), np.abs(b)).max(axis=1)
        jumps = np.abs(a - b).max(axis=1) / np.maximum(larger, 1e-6 * brightest)
        suspects = [pair for pair, jump in zip(suspects, jumps) if jump > JUMP]
    return [f"jumps by {100 * jump:.0f} % at {place(start)} along {'altitude Sun view azimuth'.split()[np.argmax(unit)]}"
            for jump, start, unit in zip(jumps, starts, units) if jump > JUMP]


def judge_energy(light, layers, facts):
    """No light from nothing: the ground takes no more than the whole air catches, and the planet returns no more."""
    caught = ((facts["planet"] + facts["top"]) / facts["planet"]) ** 2
    complaints = []
    if layers & 4: # the irradiance by the sky comes from the moments
        for zenith in (0.0, 0.7, 1.4, 1.55, 1.6):
            kept = sum(light.horizontal_irradiance(0.0, zenith)) * (1 - np.array(facts["albedo"])) / light.solar_irradiance
            if not kept.max() <= SURPLUS * caught:
                complaints.append(f"the ground keeps {kept.max():.3f} of the Sun's light, Sun at {math.degrees(zenith):.0f} deg")
    if facts["gentle"]:
        suns, sun_weights = np.polynomial.legendre.leggauss(12)
        downs, down_weights = np.polynomial.legendre.leggauss(16)
        horizon = math.pi / 2 - dip(facts, facts["top"]) # of the nadir angle; panels on both sides of the horizon
        azimuths = (np.arange(8) + 0.5) * math.pi / 8
        returned = 0.0
        for low, high in ((0, horizon), (horizon, math.pi / 2)):
            angle, weight = 0.5 * (low + high) + 0.5 * (high - low) * downs, 0.5 * (high - low) * down_weights
            flux = (light.radiance(facts["top"], np.arccos(suns)[:, None, None], (math.pi - angle)[None, :, None], azimuths[None, None, :], layers)
                    * (weight * np.sin(angle) * np.cos(angle))[None, :, None, None]).sum(axis=1).mean(axis=1) * 2 * math.pi
            returned = returned + 2 * (sun_weights[:, None] * flux).sum(axis=0)
        share = (returned / light.solar_irradiance).max()
        if not share <= SURPLUS:
            complaints.append(f"the planet returns {share:.3f} of the light that meets its air")
    return complaints


def judge_methods(fast, reference, layers, facts):
    """The fast answers against those in double precision: largest difference and where, of bright light and of faint."""
    rows = special_places(facts)[::3] # the precise ones take milliseconds each
    rows = rows[np.abs(rows[:, 2] - math.pi / 2 - np.array([dip(facts, h) for h in rows[:, 0]])) > 1e-6] # both sides of the horizon are right on it
    a, b = (light.radiance(*rows.T, layers=layers) for light in (fast, reference))
    brightest = max(b.max(), DARKNESS * reference.solar_irradiance.max())
    light = b.max(axis=1) / brightest
    error = np.abs(a - b).max(axis=1) / brightest / np.maximum(light, 1e-6)
    found = {}
    for name, some in (("bright", light > 1e-2), ("faint", ~(light > 1e-2))): # no number is faint
        if some.any():
            worst = int(np.argmax(np.where(some, error, -1)))
            found[name] = float(error[worst]), place(rows[worst])
    return found


def judge(model, facts):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../showmysky/python"))
    import showmysky # finds its library through $SHOWMYSKY_LIBRARY
    with showmysky.Photometer(model) as fast, showmysky.Photometer(model, reference=True) as reference:
        layers = showmysky.WHOLE_SKY
        try:
            fast.radiance(0.0, 0.0, 0.0)
        except showmysky.Error: # one order, or nothing scatters: there are no moments
            layers = showmysky.SINGLE_SCATTERING
        complaints = judge_values(fast, layers, facts) + judge_steps(fast, layers, facts) + judge_energy(fast, layers, facts)
        return {"complaints": complaints, "error": judge_methods(fast, reference, layers, facts),
                "several": bool(layers & showmysky.MULTIPLE_SCATTERING)}


if __name__ == "__main__":
    with open(sys.argv[2]) as file:
        print(json.dumps(judge(sys.argv[1], json.load(file))))
