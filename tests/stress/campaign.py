#!/usr/bin/env python3
"""Generated stress campaign: random legal descriptions over the whole range of the language (scenes.py), judged by laws (judge.py).

    tests/stress/campaign.py BIN [--count N] [--only N,N...] [--seed S] [--verify SECONDS] [--keep DIR]

BIN is the directory of the programs. Each scene is computed and asked for its sky at the special places: camera on the ground, at the top of the
atmosphere and above; Sun and view at zenith, nadir, horizon, and equal. A scene fails where a program ends with anything but 0 (or 2 with a
sentence: the parser refused it); where a radiance is NaN, infinite or negative, from the moments or from the textures; where it jumps between two
places however near they are; or where more light leaves than came. With --verify each model is also compared with the Monte Carlo reference.
Prints one line a scene; what it needs to be repeated is its number and --seed. Exit code 1 if any failed. Needs NumPy.
"""
import argparse
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import time

from judge import judge_energy, judge_methods, judge_steps, judge_values, special_places
from scenes import scene


def run(command, seconds):
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return 124, f"not done after {seconds} s"
    return done.returncode, (done.stderr or done.stdout).strip()


def judge_textures(viewer, model, facts, scratch, seconds):
    """Finite and not negative: more can't be asked of two texels."""
    queries, answers = os.path.join(scratch, "q.csv"), os.path.join(scratch, "a.csv")
    with open(queries, "w") as out:
        out.write("altitude_m,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg\n")
        for altitude, sun, view, azimuth in [row for row in special_places(facts) if row[0] <= facts["top"]][::7]:
            out.write(f"{altitude!r},{math.degrees(sun)!r},0,{math.degrees(view)!r},{math.degrees(azimuth)!r}\n")
    code, said = run([viewer, "probe", model, queries, "-o", answers, "--source", "textures"], seconds)
    if code != 0:
        return [f"probe of the textures: exit code {code}: {said[-300:]}"]
    with open(answers) as file:
        rows = [line.split(",")[5:] for line in file.read().splitlines()[1:]]
    return [f"textures answer {value}" for row in rows for value in row if not 0 <= float(value) < math.inf][:1]


def judge(options, model, facts, scratch):
    """Complaints about one model, and the largest difference between the two methods of answering."""
    import showmysky # finds its library through $SHOWMYSKY_LIBRARY
    with showmysky.Photometer(model) as fast, showmysky.Photometer(model, reference=True) as reference:
        layers = showmysky.WHOLE_SKY
        try:
            fast.radiance(0.0, 0.0, 0.0)
        except showmysky.Error: # one order, or nothing scatters: there are no moments
            layers = showmysky.SINGLE_SCATTERING
        complaints = judge_values(fast, layers, facts) + judge_steps(fast, layers, facts) + judge_energy(fast, layers, facts)
        error, where = judge_methods(fast, reference, layers, facts)
        if not error <= options.precision:
            complaints.append(f"fast and precise answers differ by {100 * error:.1f} % at {where}")
    if layers & showmysky.MULTIPLE_SCATTERING:
        complaints += judge_textures(os.path.join(options.bin, "showmysky"), model, facts, scratch, options.seconds)
    return complaints, error


def verify(options, model, scratch):
    """Complaints, and (rms error, regime) against the Monte Carlo reference."""
    report = os.path.join(scratch, "v.json")
    code, said = run([os.path.join(options.bin, "calcmysky"), "verify", model, "--seconds", str(options.verify), "--json", report, "-q"],
                     options.seconds + 6 * options.verify)
    if code != 0:
        return [f"verify: exit code {code}: {said[-300:]}"], []
    with open(report) as file:
        return [], [(part["rms_error"], regime) for regime, part in json.load(file)["regimes"].items() if part["rows"] > 0]


def campaign(options):
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../showmysky/python"))
    os.environ.setdefault("SHOWMYSKY_LIBRARY", os.path.join(options.bin, "../lib/libShowMySky.so"))
    failed = refused = 0
    errors, differences = [], []
    numbers = options.only or range(options.first, options.first + options.count)
    for number in numbers:
        text, facts = scene(random.Random(f"{options.seed}-{number}"))
        with tempfile.TemporaryDirectory() as scratch:
            folder = options.keep or scratch
            os.makedirs(folder, exist_ok=True)
            atmo, model = os.path.join(folder, f"{number}.atmo"), os.path.join(folder, f"{number}")
            with open(atmo, "w") as file:
                file.write(text)
            start = time.time()
            command = [os.path.join(options.bin, "calcmysky"), atmo, "--out-dir", model, "--radiance", "--quality", options.quality, "-q"]
            code, said = run(command + ([] if facts["eclipsed"] else ["--skip", "eclipsed"]), options.seconds)
            took = time.time() - start
            complaints, verdict = [], "ok"
            if code == 2 and said:
                refused += 1
                verdict = "refused: " + said.splitlines()[0]
            elif code != 0:
                complaints.append(f"exit code {code}: {said[-300:]}")
            elif facts["about"].endswith("vacuum"):
                verdict = "ok: a vacuum has no sky to ask for"
            else:
                complaints, difference = judge(options, model, facts, scratch)
                differences.append((difference, number))
                if options.verify > 0:
                    wrong, found = verify(options, model, scratch)
                    complaints += wrong
                    errors += [(rms, number, regime) for rms, regime in found]
            failed += bool(complaints)
            print(f"{number:4d} {took:6.1f} s  {'FAILED  ' if complaints else ''}{'; '.join(complaints[:3]) or verdict}  [{facts['about']}]", flush=True)
    print(f"{len(numbers)} scenes, {refused} refused by the parser, {failed} failed (seed {options.seed})")
    if differences:
        print(f"  fast against precise answers: {100 * max(differences)[0]:.2g} % at most, {100 * sorted(differences)[len(differences) // 2][0]:.2g} % median")
    for rms, number, regime in sorted(errors, reverse=True)[:10]:
        print(f"  scene {number}, {regime}: rms error {100 * rms:.1f} %")
    return 1 if failed else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="directory of calcmysky and showmysky")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene")
    parser.add_argument("--only", type=lambda text: [int(n) for n in text.split(",")], help="numbers of scenes in place of these: 3,14,15")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=300, help="time for each program")
    parser.add_argument("--quality", default="draft", help="of the models; the judge looks for what no quality excuses")
    parser.add_argument("--precision", type=float, default=0.1, help="largest difference between fast and precise answers")
    parser.add_argument("--verify", type=float, default=0, help="seconds of Monte Carlo for each scene")
    parser.add_argument("--keep", help="keep descriptions and models here")
    sys.exit(campaign(parser.parse_args()))
