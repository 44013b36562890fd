#!/usr/bin/env python3
"""Total sky in eclipses against Monte Carlo: bench/eclipse.py BIN MODEL [SECONDS] [--only NAME] [--every N]

BIN holds calcmysky and showmysky; MODEL was computed with --radiance. Each case, or those whose name begins with NAME, gets SECONDS (30)
of Monte Carlo. Printed are, over 20 directions (or every Nth of them, so that each gets more time) of the sky and all wavelengths, the rms difference over the mean of the sky at each wavelength, without and with what the noise of the
reference explains, and the same of single scattering, which has no noise.
"""
import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

CASES = [  # name, zenith angle of the Sun, Moon's zenith angle and azimuth minus the Sun's (degrees), distance (m)
    ("total, concentric", 50, 0, 0, 371925e3),
    ("total, offset", 50, 0.004, 0.003, 371925e3),
    ("total, Sun low", 80, 0, 0, 371925e3),
    ("partial, 0.06 degrees", 50, 0.06, 0, 371925e3),
    ("partial, 0.3 degrees", 50, 0.2, 0.25, 371925e3),
    ("partial, Sun low", 85, 0.15, 0.1, 371925e3),
    ("partial, Sun lowest", 88, 0.15, 0.1, 371925e3),
    ("annular", 50, 0, 0, 400000e3),
]
DIRECTIONS = [(vza, az) for vza in (10, 35, 62, 80, 88) for az in (3, 60, 120, 180)]


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def manifest_of(binaries, model):
    done = subprocess.run([binaries / "showmysky", "info", model, "--json"], text=True, capture_output=True, check=True)
    return json.loads(done.stdout)


def columns_of(binaries, model):
    query = "altitude_m,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg\n0,50,0,50,90\n"
    done = subprocess.run([binaries / "showmysky", "probe", model, "-"], input=query, text=True, capture_output=True, check=True)
    return [name for name in done.stdout.splitlines()[0].split(",") if name.startswith("L_")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binaries", type=pathlib.Path)
    parser.add_argument("model")
    parser.add_argument("seconds", nargs="?", default="30")
    parser.add_argument("--only", default="")
    parser.add_argument("--every", type=int, default=1)
    options = parser.parse_args()
    binaries, model, seconds = options.binaries, options.model, options.seconds
    columns = columns_of(binaries, model)
    irradiance = dict(zip(columns, manifest_of(binaries, model)["solarIrradiance"]))
    print(f"{'':24} {'rms':>8} {'noise':>8} {'rest':>8} {'single':>8}")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, sza, dz, da, distance in (case for case in CASES if case[0].startswith(options.only)):
            judge = ["altitude_m,sza_deg,vza_deg,relaz_deg,lambda_nm,moon_zenith_deg,moon_azimuth_deg,earth_moon_distance_m"]
            probe = ["altitude_m,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg,moon_zenith_deg,moon_azimuth_deg,earth_moon_distance_m"]
            for vza, az in DIRECTIONS[:: options.every]:
                moon = f"{sza + dz},{da},{distance}"
                probe.append(f"0,{sza},0,{vza},{az},{moon}")
                judge += [f"0,{sza},{vza},{az},{column[2:-2]},{moon}" for column in columns]
            (folder / "judge.csv").write_text("\n".join(judge) + "\n")
            (folder / "probe.csv").write_text("\n".join(probe) + "\n")
            subprocess.run([binaries / "calcmysky", "reference", model, folder / "judge.csv", "-o", folder / "judged.csv", "--seconds",
                            seconds, "--quiet"], check=True)
            answers = {}
            for layers in ("single", "single,multiple"):
                subprocess.run([binaries / "showmysky", "probe", model, folder / "probe.csv", "-o", folder / "answers.csv", "--layers",
                                layers], check=True)
                answers[layers] = read(folder / "answers.csv")
            judged = read(folder / "judged.csv")
            sums = dict.fromkeys(("error", "noise", "single"), 0.0)
            for c, column in enumerate(columns):
                rows = judged[c :: len(columns)]
                single = [float(row["L1_per_sr"]) for row in rows]
                whole = [float(row["L1_per_sr"]) + float(row["Lms_per_sr"]) for row in rows]
                mean, mean_single = sum(whole) / len(whole), sum(single) / len(single)
                for i, row in enumerate(rows):
                    got = {layers: float(answers[layers][i][column]) / irradiance[column] for layers in answers}
                    sums["error"] += ((got["single,multiple"] - whole[i]) / mean) ** 2
                    sums["noise"] += (float(row["Lms_stderr"]) / mean) ** 2
                    sums["single"] += ((got["single"] - single[i]) / mean_single) ** 2
            count = len(judged)
            error, noise, single = (math.sqrt(sums[key] / count) for key in ("error", "noise", "single"))
            rest = math.sqrt(max(0.0, error**2 - noise**2))
            print(f"{name:24} {100 * error:7.2f}% {100 * noise:7.2f}% {100 * rest:7.2f}% {100 * single:7.2f}%", flush=True)


if __name__ == "__main__":
    main()
