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
PEAK = math.radians(6) # about the Sun
SCATTERED = 2 | 4 # layers of the photometer: once, and more often
UNSUPPORTED = 3 # showmysky_photometry_status
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
    """What is no number, or far less than no light, the library itself refuses with a sentence: that ends this program, and so the campaign has it."""
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


def nodes(edges, counts):
    """Gauss-Legendre nodes and weights on panels between edges."""
    panels = [(np.polynomial.legendre.leggauss(count), low, high) for low, high, count in zip(edges, edges[1:], counts)]
    return (np.concatenate([0.5 * (low + high) + 0.5 * (high - low) * x for (x, _), low, high in panels]),
            np.concatenate([0.5 * (high - low) * w for (_, w), low, high in panels]))


def light_returned(light, layers, facts):
    """Share of the sunlight that meets the air that comes back, [wavelength]: by what goes up through the top, averaged over its places. Where phase
    functions are sharp, what is seen within PEAK of the Sun is left out: too narrow for these nodes, and nothing but missing."""
    below = dip(facts, facts["top"])
    suns, sun_weights = nodes((-1, -math.sin(below), 0, 1), (3, 7, 10)) # cosines
    downs, down_weights = nodes((0, math.pi / 2 - below, math.pi / 2), (16, 12)) # nadir angles, to the ground and past it
    turns, turn_weights = nodes((0, 1), (12,)) # roots of the azimuth's share of half a turn: closer where the Sun is
    azimuths = math.pi * turns**2
    sun, down, azimuth = np.arccos(suns)[None, :, None], downs[:, None, None], azimuths[None, None, :]
    weights = np.einsum("i,j,k->ijk", down_weights * np.sin(downs) * np.cos(downs), sun_weights, 4 * math.pi * turns * turn_weights)
    if not facts["gentle"]:
        weights = weights * (np.sin(sun) * np.sin(down) * np.cos(azimuth) - np.cos(sun) * np.cos(down) < math.cos(PEAK))
    flux = light.radiance(facts["top"], sun, math.pi - down, azimuth, layers) # views in a row share their ray
    return 2 * (weights[..., None] * flux).sum(axis=(0, 1, 2)) / light.solar_irradiance


def light_on_ground(light, facts):
    """Light that falls on the ground, averaged over it, by that which would without air, [wavelength]."""
    suns, weights = nodes((-1, -0.1, 0, 1), (8, 6, 10))
    falls = np.array([sum(light.horizontal_irradiance(0.0, math.acos(mu))) for mu in suns])
    return 2 * (weights[:, None] * falls).sum(axis=0) / light.solar_irradiance


def judge_energy(light, layers, facts):
    """No light from nothing, over white ground too. Averaged over the ground, sunlight that falls on it is to that without air as the light of a glowing
    ground that gets out is to the light it glows by (reciprocity): no more, however often air and ground throw it to and fro. And what the ground keeps
    and what comes back are no more together than what meets the air."""
    complaints, kept = [], 0.0
    if layers & 4: # the irradiance by the sky comes from the moments
        falls = light_on_ground(light, facts)
        kept = falls * (1 - np.array(facts["albedo"])) * (facts["planet"] / (facts["planet"] + facts["top"])) ** 2
        if not falls.max() <= SURPLUS:
            complaints.append(f"{falls.max():.3f} of the light that would fall on the ground without air does")
    returned = light_returned(light, layers, facts)
    share = (kept + returned).max()
    if not share <= SURPLUS:
        complaints.append(f"the ground keeps and the planet returns {share:.3f} of the light that meets its air")
    return complaints


def judge_without_sky(light, layers, facts):
    """What scatters nothing has no sky; and without any air nothing is in the way of the light, which the ground throws back as it falls."""
    if facts["scatters"]:
        return []
    rows = special_places(facts)
    seen = light.radiance(*rows.T, layers=layers & SCATTERED).max(axis=1)
    complaints = [f"sky without a scatterer: {seen.max():g} at {place(rows[np.argmax(seen)])}"] if seen.max() != 0 else []
    if "vacuum" not in facts["kinds"]:
        return complaints
    for altitude in altitudes(facts):
        for angle in (0.0, 1.0, math.pi / 2 + dip(facts, altitude) - 1e-4, math.pi / 2 + dip(facts, altitude) + 1e-4, math.pi):
            expected, through = float(angle < math.pi / 2 + dip(facts, altitude)), light.transmittance(altitude, angle)
            if np.abs(through - expected).max() > 1e-9:
                complaints.append(f"transmittance of a vacuum {through.min():g}..{through.max():g} at {altitude:.6g} m, {math.degrees(angle):.5f} deg")
        ground = light.radiance(altitude, 1.0, math.pi, layers=layers) / light.solar_irradiance
        if np.abs(ground - np.array(facts["albedo"]) * math.cos(1.0) / math.pi).max() > 1e-4: # single precision, and a Sun that isn't a point
            complaints.append(f"bare ground under a Sun at 1 rad sends {ground.max():g} of its light, seen from {altitude:.6g} m")
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
        except showmysky.Error as error: # one order, or nothing scatters: there are no moments
            if error.status != UNSUPPORTED:
                raise
            layers = showmysky.SINGLE_SCATTERING
        complaints = [complaint for law in (judge_values, judge_steps, judge_energy, judge_without_sky) for complaint in law(fast, layers, facts)]
        return {"complaints": complaints, "error": judge_methods(fast, reference, layers, facts),
                "several": bool(layers & showmysky.MULTIPLE_SCATTERING)}


if __name__ == "__main__":
    with open(sys.argv[2]) as file:
        print(json.dumps(judge(sys.argv[1], json.load(file))))
