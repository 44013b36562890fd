#!/usr/bin/env python3
"""Generated stress campaign: random legal descriptions over the whole range of the language (scenes.py), judged by laws (judge.py).

    tests/stress/campaign.py BIN [--count N] [--only N,N...] [--seed S] [--verify SECONDS] [--must-judge] [--must-hold KINDS] [--keep DIR]

BIN is the directory of the programs. Each scene is computed and asked for its sky at the special places: camera on the ground, at the top of the
atmosphere and above; Sun and view at zenith, nadir, horizon, and equal. A scene fails where a program ends with anything but 0 (or 2 with a
sentence: the parser refused it); where a radiance is NaN, infinite or negative, from the moments or from the textures; where it jumps between two
places however near they are; or where more light leaves than came. With --verify each model is also compared with the Monte Carlo reference:
it fails where its error is above BOUNDS by more than two standard errors of the judge. Light of which the judge could tell fewer than eight
samples to 5 % is counted as not judged; scenes with sharp peaks are judged with all orders. Prints one line a scene;
what it needs to be repeated is its number and --seed. Exit code 1 if any failed, or with --must-judge if any was refused or not judged: by its laws, and
with --verify its bright light by the reference; or with --must-hold if a kind of scene isn't among those judged. Needs NumPy.
"""
import argparse
import json
import math
import os
import random
import re
import resource
import signal
import subprocess
import sys
import tempfile

import numpy as np

from judge import dip, special_places
from scenes import scene


HERE = os.path.dirname(os.path.abspath(__file__))
TOO_LONG = 124
JUDGING = 60 # seconds of a processor's time for the questions to a model, beside those that its computation may take
OPAQUE = 7 # optical depth through which a thousandth of the light comes
ENOUGH = 8 # samples that say something
# Largest rms error against the reference, by phase functions (gentle; with peaks sharper than the harmonics; or mainly with peaks of which the model
# warns) and by the light of a sample, of that of the brightest. Less than the last is dark, and nobody's error.
LIGHT = (("bright", 1e-2), ("faint", 1e-6))
BOUNDS = {("gentle", "bright"): 0.05, ("gentle", "faint"): 0.2, ("sharp", "bright"): 0.15, ("sharp", "faint"): 0.3,
          ("unresolved", "bright"): 1, ("unresolved", "faint"): 1}
WARNING = "too narrow for any quality" # what the manifest says of unresolved peaks


def run(command, seconds):
    """Exit code and what was said; TOO_LONG where it took more than `seconds` of a processor's time, or stood still for many times as long."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60 + 20 * seconds,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 5)))
    except subprocess.TimeoutExpired:
        return 1, f"stands still: not done after {60 + 20 * seconds:g} s"
    if done.returncode == -signal.SIGXCPU:
        return TOO_LONG, f"not done after {seconds:g} s of processor time"
    return done.returncode, (done.stderr if done.returncode else done.stdout or done.stderr).strip()


def processor_time():
    """Of the programs run so far, s."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


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
    """Complaints about one model, and by its light the largest difference between the two methods of answering; None where that took too long to be told. A program of
    its own, so that a question that never ends, or that ends the program, costs this scene alone."""
    given = os.path.join(scratch, "facts.json")
    with open(given, "w") as file:
        json.dump(facts, file)
    code, said = run([sys.executable, os.path.join(HERE, "judge.py"), model, given], options.seconds + JUDGING)
    if code == TOO_LONG:
        return [], None, False
    if code != 0:
        return [f"questions: exit code {code}: {said[-300:]}"], None, False
    answer = json.loads(said)
    complaints, error, several = answer["complaints"], answer["error"], answer["several"]
    for light, bound in (("bright", options.precision), ("faint", options.faint_precision)):
        if light in error and not error[light][0] <= bound:
            complaints.append(f"fast and precise answers differ by {100 * error[light][0]:.1f} % at {error[light][1]}")
    if several and not options.moments:
        complaints += judge_textures(os.path.join(options.bin, "showmysky"), model, facts, scratch, options.seconds)
        facts["kinds"].append("textures")
    return complaints, error, several


def rms_of(rows):
    """Relative error of rows (error, noise), the noise of the judge removed, and what that leaves uncertain."""
    errors, noise = (np.array(part) for part in zip(*rows))
    rms = math.sqrt(max(0.0, float(np.mean(errors**2 - noise**2))))
    of_square = math.sqrt(float(np.sum(4 * errors**2 * noise**2 + 2 * noise**4))) / len(rows)
    return rms, of_square / (2 * rms) if rms**2 > of_square else math.sqrt(of_square)


def sees_ground(facts, row):
    """Whether light of the ground reaches the camera within a peak: it would be the air's to the reference and the ground's to the model. A black ground
    sends none, and through opaque air none comes."""
    wavelength = int(np.argmin(np.abs(np.array(facts["wavelengths"]) - row["lambda_nm"])))
    downwards = math.radians(row["vza_deg"]) > math.pi / 2 + dip(facts, row["altitude_m"])
    return downwards and facts["albedo"][wavelength] > 0 and not (from_space(facts, row) and facts["transport"][wavelength] > OPAQUE)


def from_space(facts, row):
    return row["altitude_m"] > (1 - 1e-6) * facts["top"]


def kind_of(options, model, facts):
    """Phase functions of a model, by what BOUNDS are for."""
    if facts["gentle"]:
        return "gentle"
    if options.unresolved_as_sharp:
        return "sharp"
    with open(os.path.join(model, "manifest.json")) as file:
        return "unresolved" if any(WARNING in sentence for sentence in json.load(file)["warnings"]) else "sharp"


def verify(options, model, facts, scratch):
    """Complaints, and ((phase functions, light), rms error, its uncertainty) against the Monte Carlo reference; (.., None, None) where it could not tell.
    Left out: what is dark; and where phase functions have sharp peaks the ground in view."""
    report, kind = os.path.join(scratch, "v.json"), kind_of(options, model, facts)
    code, said = run([os.path.join(options.bin, "calcmysky"), "verify", model, "--seconds", str(options.verify), "--json", report, "-q"],
                     options.seconds + 10 * options.verify)
    if code == TOO_LONG: # the judge's own time, not the model's
        return [], [((kind, name), None, None) for name, _ in LIGHT]
    if code != 0:
        return [f"verify: exit code {code}: {said[-300:]}"], []
    with open(report) as file:
        rows = json.load(file).get("rows") or []
    light = {id(row): row["reference_single"] + row["reference_multiple"] for row in rows}
    brightest = max(light.values(), default=0)
    used = {name: [] for name, _ in LIGHT}
    for row in rows:
        name = next((name for name, share in LIGHT if light[id(row)] > share * brightest), None)
        if name and (facts["gentle"] or not sees_ground(facts, row)):
            used[name].append((row["error"], row["reference_stderr"] / light[id(row)]))
    found = [((kind, name), *(rms_of(part) if len(part) >= ENOUGH else (None, None))) for name, part in used.items()]
    return [f"error {100 * rms:.1f} % +- {100 * noise:.1f} % of {name} light" for (_, name), rms, noise in found
            if rms is not None and rms - 2 * noise > BOUNDS[kind, name]], found


def summary(verdicts):
    """Errors by phase functions and light: how many scenes were judged, and how the errors spread."""
    for kind, bound in BOUNDS.items():
        mine = sorted((rms, noise, number) for number, name, rms, noise in verdicts if name == kind and rms is not None)
        told = len(mine)
        asked = sum(name == kind for _, name, _, _ in verdicts)
        print(f"  {' '.join(kind):17}  bound {100 * bound:3.0f} %, {told:2d} of {asked} scenes judged" + (f"; rms error: median {100 * mine[told // 2][0]:.1f} %, nine of ten below "
              f"{100 * mine[min(told - 1, 9 * told // 10)][0]:.1f} %, largest {100 * mine[-1][0]:.1f} +- {100 * mine[-1][1]:.1f} % (scene {mine[-1][2]})" if mine else ""))


def campaign(options):
    os.environ.setdefault("SHOWMYSKY_LIBRARY", os.path.join(options.bin, "../lib/libShowMySky.so"))
    failed = refused = late = unjudged = 0
    held = set() # kinds of the scenes that were judged
    verdicts, differences = [], []
    numbers = options.only or range(options.first, options.first + options.count)
    for number in numbers:
        text, facts = scene(random.Random(f"{options.seed}-{number}"))
        if options.verify > 0 and not facts["gentle"]: # light in a truncated peak is no event to the model
            text = re.sub("(scattering orders: )[2-9]", r"\1all", text)
        with tempfile.TemporaryDirectory() as scratch:
            folder = options.keep or scratch
            os.makedirs(folder, exist_ok=True)
            atmo, model = os.path.join(folder, f"{number}.atmo"), os.path.join(folder, f"{number}")
            with open(atmo, "w") as file:
                file.write(text)
            before = processor_time()
            command = [os.path.join(options.bin, "calcmysky"), atmo, "--out-dir", model, "--radiance", "--quality", options.quality, "-q"]
            code, said = run(command + (["--only", "moments"] if options.moments else [] if facts["eclipsed"] else ["--skip", "eclipsed"]), options.seconds)
            took = processor_time() - before
            complaints, verdict, judged = [], "ok", False
            if code == TOO_LONG and options.moments:
                late += 1
                verdict = f"not judged: it takes more than {options.seconds:g} s"
            elif code == 2 and said:
                refused += 1
                verdict = "refused: " + said.splitlines()[0]
            elif code != 0:
                complaints.append(f"exit code {code}: {said[-300:]}")
            else:
                complaints, difference, several = judge(options, model, facts, scratch)
                if difference is not None:
                    differences.append(difference)
                    judged = options.verify <= 0
                elif not complaints:
                    late += 1
                    verdict = f"not judged: the questions take more than {options.seconds + JUDGING:g} s"
                if options.verify > 0 and several:
                    wrong, found = verify(options, model, facts, scratch)
                    complaints += wrong
                    judged = difference is not None and any(name == "bright" and rms is not None for (_, name), rms, _ in found)
                    verdicts += [(number, *what) for what in found]
            failed += bool(complaints)
            unjudged += not judged
            held.update(facts["kinds"] if judged else ())
            print(f"{number:4d} {took:6.1f} s  {'FAILED  ' if complaints else ''}{'; '.join(complaints[:3]) or verdict}  [{facts['about']}]", flush=True)
    print(f"{len(numbers)} scenes, {refused} refused by the parser, {late} too long to judge, {failed} failed (seed {options.seed})")
    for name, _ in LIGHT:
        errors = sorted(difference[name][0] for difference in differences if name in difference)
        if errors:
            print(f"  fast against precise answers, {name} light: {100 * errors[-1]:.2g} % at most, {100 * errors[len(errors) // 2]:.2g} % median")
    if verdicts:
        summary(verdicts)
    if options.must_judge and unjudged:
        print(f"  {unjudged} scenes that had to be judged were not")
        return 1
    if missing := set(options.must_hold) - held:
        print(f"  of these kinds no scene was judged: {', '.join(sorted(missing))}")
        return 1
    return 1 if failed else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="directory of calcmysky and showmysky")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene")
    parser.add_argument("--only", type=lambda text: [int(n) for n in text.split(",")], help="numbers of scenes in place of these: 3,14,15")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=300, help="processor time for each program")
    parser.add_argument("--quality", default="draft", help="of the models; the judge looks for what no quality excuses")
    parser.add_argument("--precision", type=float, default=0.1, help="largest difference between fast and precise answers, of bright light")
    parser.add_argument("--faint-precision", type=float, default=0.1, help="the same of faint light")
    parser.add_argument("--moments", action="store_true", help="judge the moments alone, and leave out scenes that take longer than --seconds")
    parser.add_argument("--verify", type=float, default=0, help="seconds of Monte Carlo for each scene")
    parser.add_argument("--unresolved-as-sharp", action="store_true", help="give peaks that the model calls unresolved the bounds of sharp ones")
    parser.add_argument("--must-judge", action="store_true", help="fail where a scene is refused, takes too long, or leaves the reference too uncertain")
    parser.add_argument("--must-hold", type=lambda text: text.split(","), default=[],
                        help="fail where no scene that was judged is of each of these kinds (scenes.py): deep,64 wavelengths,textures")
    parser.add_argument("--keep", help="keep descriptions and models here")
    sys.exit(campaign(parser.parse_args()))
