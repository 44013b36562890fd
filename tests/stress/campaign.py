#!/usr/bin/env python3
"""Generated stress campaign: random legal descriptions over the whole range of the language.

    tests/stress/campaign.py BIN [--count N] [--seed S] [--verify SECONDS] [--keep DIR]

BIN is the directory of the programs. Each scene is computed, and its sky asked for at the special places: camera on the ground, at the
top of the atmosphere and above; Sun and view at zenith, nadir, horizon, and equal. A scene fails where a program ends with anything but 0
(or 2 with a sentence: the parser refused it), where a radiance is NaN, infinite or negative, where it differs between two views a
thousandth of a degree apart, or where an absorbing ground receives more light than the Sun sends. With --verify each model is also
compared with the Monte Carlo reference. Prints one line a scene; what it needs to be repeated is its number and --seed. Exit code 1 if any failed.
"""
import argparse
import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import time

AU = 149597870700.0


def spectrum(values):
    return ", ".join("%.9g" % v for v in values)


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


PHASES = {
    "isotropic": "return vec4(1.0/(4.0*PI));",
    "Rayleigh": "return vec4(3.0/(16.0*PI)*(1.0+sqr(dotViewSun)));",
    "Henyey-Greenstein 0.5": None,
    "Henyey-Greenstein 0.9": None,
    "Henyey-Greenstein 0.99": None,
    "backward -0.8": None,
    "peak": "float x = acos(clamp(dotViewSun, -1.0, 1.0)) / 0.02; return vec4(0.5/(4.0*PI) + 0.5*exp(-x*x)/(PI*0.0004));",
}


def phase_code(name):
    if PHASES[name]:
        return PHASES[name]
    g = float(name.split()[1])
    return f"const float g = {g}; return vec4((1.0-g*g)/(4.0*PI*pow(1.0+g*g-2.0*g*dotViewSun, 1.5)));"


def density_code(shape, peak, top, rng):
    """GLSL of a number density with the given peak, m^-3, and its column over the atmosphere, m^-2."""
    if shape == "exponential":
        scale = top / rng.uniform(4, 20)
        return f"return {peak:.9e}*exp(-altitude/{scale:.9e});", peak * scale * (1 - math.exp(-top / scale))
    if shape == "step":
        low = top * rng.uniform(0, 0.6)
        high = low + top * rng.uniform(0.02, 0.3)
        return f"return altitude >= {low:.9e} && altitude <= {high:.9e} ? {peak:.9e} : 0.0;", peak * (high - low)
    if shape == "bump":
        centre, width = top * rng.uniform(0.1, 0.7), top * rng.uniform(0.02, 0.1)
        return (f"float x = (altitude-{centre:.9e})/{width:.9e}; return {peak:.9e}*max(0.0, 1.0-x*x);", peak * width * 4 / 3)
    return f"return {peak:.9e};", peak * top


def scene(rng):
    """Text of a description, and what the checks need to know of it."""
    planet = log_uniform(rng, 1e5, 1e10)
    top = log_uniform(rng, 1, min(1e6, planet))
    count = rng.choice([4, 4, 4, 5, 16, 64])
    sun = rng.choice([0.5, 1.0, 1.0, 30.0, 1e20]) * AU
    albedo = [rng.choice([0.0, 0.0, 1.0, 0.3])] * count
    scatterers = rng.choice([1, 1, 1, 2, 2, 3, 20])
    lines = [
        "version: 6",
        f"Earth radius: {planet:.9e} m",
        f"atmosphere height: {top:.9e} m",
        f"Earth-Sun distance: {sun / AU:.9e} AU",
        "Earth-Moon distance: 384400 km",
        f"scattering orders: {rng.choice([1, 2, 4, 4, 'all'])}",
        f"wavelengths: min=400nm, max=700nm, count={count}",
        f"solar irradiance at TOA: {spectrum([1.0] * count)}",
        f"ground albedo: {spectrum(albedo)}",
        "transmittance texture size for VZA: 4", "transmittance texture size for altitude: 2",
        "irradiance texture size for SZA: 4", "irradiance texture size for altitude: 2",
        f"scattering texture size for VZA: {rng.choice([4, 8])}", "scattering texture size for dot(view,sun): 2",
        f"scattering texture size for SZA: {rng.choice([2, 5])}", "scattering texture size for altitude: 2",
    ]
    words, depth_sum = [], 0.0
    for i in range(scatterers):
        depth = rng.choice([0.0, 1e-9, 1e-3, 0.1, 0.5, 1.0, 3.0, 10.0, 1000.0]) / (scatterers if scatterers > 3 else 1)
        phase = rng.choice(list(PHASES))
        shape = rng.choice(["exponential", "exponential", "step", "bump", "constant"])
        single_scattering_albedo = rng.choice([1.0, 1.0, 0.9, 0.0])
        kind = rng.choice(["smooth", "achromatic", "general"])
        code, column = density_code(shape, 1e20, top, rng)
        cross = depth / column
        depth_sum += depth
        words.append(f"{phase} {shape} {depth:g} {single_scattering_albedo:g}")
        lines += [f'Scatterer "s{i}":', "{", "number density:", "```", code, "```", "phase function:", "```", phase_code(phase), "```",
                  f"phase function type: {kind}", f"cross section at 1 um: {cross:.9e} m^2", f"angstrom exponent: {rng.choice([0, 1.3, 4])}",
                  f"single scattering albedo: {spectrum([single_scattering_albedo] * count)}", "}"]
    if rng.random() < 0.3:
        lines += ['Absorber "a":', "{", "number density:", "```", "return altitude > 0.3*atmosphereHeight ? 1.0 : 0.0;", "```",
                  f"cross section: {spectrum([rng.choice([0.0, 1.0]) / top] * count)}", "}"]
    about = f"R {planet:.2g} m, top {top:.2g} m, Sun {sun / AU:g} AU, {count} wavelengths, albedo {albedo[0]:g}: " + "; ".join(words[:3])
    return "\n".join(lines) + "\n", {"top": top, "planet": planet, "albedo": albedo[0], "about": about + (" ..." if len(words) > 3 else "")}


def special_places(facts):
    """(altitude, Sun zenith, view zenith, view azimuth) in metres and degrees, each followed by a neighbour a little aside."""
    rows = []
    for altitude in (0.0, 0.37 * facts["top"], facts["top"], 3 * facts["top"]):
        dip = math.degrees(math.acos(min(1.0, facts["planet"] / (facts["planet"] + altitude))))
        for sun in (0.0, 45.0, 89.99, 90.0 + dip, 95.0, 180.0):
            for view, azimuth in ((0.0, 0.0), (sun, 0.0), (60.0, 90.0), (min(180.0, 89.9 + dip), 180.0), (90.0 + dip, 0.0), (180.0, 0.0)):
                rows.append((altitude, sun, view, azimuth))
                if abs(view - 90.0 - dip) > 0.05 and abs(view - sun) > 1:
                    rows.append((altitude, sun, abs(view - 0.001), azimuth))
    return rows


def run(command, seconds):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return 124, f"not done after {seconds} s"
    return done.returncode, (done.stderr or done.stdout).strip()


def judge_sky(answers):
    """Complaints about the radiances of one model."""
    complaints = []
    rows = list(csv.DictReader(open(answers)))
    names = [name for name in rows[0] if name.startswith("L_")]
    before = None
    for row in rows:
        values = [float(row[name]) for name in names]
        place = tuple(float(row[k]) for k in ("altitude_m", "sun_zenith_deg", "view_zenith_deg", "view_azimuth_deg"))
        if not all(math.isfinite(v) for v in values):
            complaints.append(f"not finite at {place}")
        elif min(values) < 0:
            complaints.append(f"negative at {place}")
        elif before and before[0][:2] == place[:2] and abs(abs(before[0][2] - place[2]) - 0.001) < 1e-6 and before[0][3] == place[3]:
            brightest = max(values + before[1])
            jump = max(abs(a - b) for a, b in zip(values, before[1]))
            if jump > 0.05 * brightest and brightest > 1e-12:
                complaints.append(f"jumps by {100 * jump / brightest:.0f} % at {place}")
        before = (place, values)
    return complaints


def judge_energy(directory, facts):
    """An absorbing ground can't receive more than the Sun sends: complaints about the model's irradiance."""
    if facts["albedo"] > 0:
        return []
    import showmysky # finds its library through $SHOWMYSKY_LIBRARY; needs NumPy
    with showmysky.Photometer(directory) as light:
        worst = max(float(sum(part.max() for part in light.horizontal_irradiance(0.0, math.radians(zenith))))
                    for zenith in (0, 40, 80, 89, 91))
    return [f"an absorbing ground receives {worst:.3f} of the Sun's light"] if worst > 1.02 else []


def campaign(options):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../showmysky/python"))
    os.environ.setdefault("SHOWMYSKY_LIBRARY", os.path.join(options.bin, "../lib/libShowMySky.so"))
    program, viewer = os.path.join(options.bin, "calcmysky"), os.path.join(options.bin, "showmysky")
    failed = refused = 0
    errors = []
    for number in range(options.first, options.first + options.count):
        rng = random.Random(f"{options.seed}-{number}")
        text, facts = scene(rng)
        with tempfile.TemporaryDirectory() as scratch:
            folder = options.keep or scratch
            os.makedirs(folder, exist_ok=True)
            atmo, model = os.path.join(folder, f"{number}.atmo"), os.path.join(folder, f"{number}")
            open(atmo, "w").write(text)
            start = time.time()
            code, said = run([program, atmo, "--out-dir", model, "--radiance", "--skip", "eclipsed,light-pollution", "-q"], options.seconds)
            took = time.time() - start
            complaints, verdict = [], "ok"
            if code == 2 and said:
                refused += 1
                verdict = "refused: " + said.splitlines()[0]
            elif code != 0:
                complaints.append(f"exit code {code}: {said[-300:]}")
            else:
                queries, answers = os.path.join(scratch, "q.csv"), os.path.join(scratch, "a.csv")
                with open(queries, "w") as out:
                    out.write("altitude_m,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg\n")
                    for altitude, sun, view, azimuth in special_places(facts):
                        out.write(f"{altitude!r},{sun!r},0,{view!r},{azimuth!r}\n")
                code, said = run([viewer, "probe", model, queries, "-o", answers, "--source", "cpu"], options.seconds)
                if code != 0:
                    complaints.append(f"probe: exit code {code}: {said[-300:]}")
                else:
                    complaints += judge_sky(answers) + judge_energy(model, facts)
                if options.verify > 0:
                    report = os.path.join(scratch, "v.json")
                    code, said = run([program, "verify", model, "--seconds", str(options.verify), "--json", report, "-q"],
                                     options.seconds + 6 * options.verify)
                    if code == 0:
                        for regime, part in json.load(open(report))["regimes"].items():
                            if part["rows"] > 0:
                                errors.append((part["rms_error"], number, regime))
                    else:
                        complaints.append(f"verify: exit code {code}: {said[-300:]}")
            failed += bool(complaints)
            print(f"{number:4d} {took:6.1f} s  {'FAILED  ' if complaints else ''}{'; '.join(complaints[:3]) or verdict}  [{facts['about']}]", flush=True)
    print(f"{options.count} scenes, {refused} refused by the parser, {failed} failed (seed {options.seed})")
    for rms, number, regime in sorted(errors, reverse=True)[:10]:
        print(f"  scene {number}, {regime}: rms error {100 * rms:.1f} %")
    return 1 if failed else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="directory of calcmysky and showmysky")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=120, help="time for each program")
    parser.add_argument("--verify", type=float, default=0, help="seconds of Monte Carlo for each scene")
    parser.add_argument("--keep", help="keep descriptions and models here")
    sys.exit(campaign(parser.parse_args()))
