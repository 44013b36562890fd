#!/usr/bin/env python3
"""Errors of the sky beside the Sun against the Monte Carlo reference, as a Markdown table.

    bench/aureole.py BIN [--seconds S]

BIN is the directory of the programs; S, default 30, what the reference may take for each Sun. Air is the sample Earth's; with much more aerosol; with a
cloud of optical depth 2; and that cloud with a diffraction peak. Views are above the Sun and beside it, at its zenith angle, from the ground.
"""
import argparse
import csv
import math
import os
import subprocess
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ANGLES = (0.6, 1, 2, 3, 5, 8, 12, 20)
ZENITH_ANGLES = (30, 75)
WAVELENGTH, IRRADIANCE = 579.333, 1.818 # nm, as in bench/earth-4-wavelengths.atmo


def read(name):
    """A file of this folder."""
    with open(os.path.join(HERE, name), encoding="utf-8") as file:
        return file.read()


def edited(text, *script):
    return subprocess.run(["sed", *script], input=text, capture_output=True, text=True, check=True).stdout


def airs():
    """Name and description."""
    earth, cloud = read("earth-4-wavelengths.atmo"), read("cloud-layer.txt")
    yield "Earth", earth
    yield "haze", edited(earth, "s/1.03333e8/1.55e10/")
    yield "cloud", earth + cloud
    yield "drops", earth + edited(cloud, "-f", os.path.join(HERE, "diffraction-peak.sed"))


def views(zenith):
    """Direction, angle from the Sun, zenith angle and azimuth; degrees."""
    for angle in ANGLES:
        yield "above", angle, abs(zenith - angle), 0 if angle < zenith else 180
    square = math.sin(math.radians(zenith)) ** 2
    for angle in ANGLES:
        yield "beside", angle, zenith, math.degrees(math.acos((math.cos(math.radians(angle)) - 1 + square) / square))


def answers(command, questions, scratch):
    """Rows of a program that reads a table of questions."""
    path = os.path.join(scratch, "questions.csv")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(questions) + "\n")
    result = subprocess.run([path if word == "QUESTIONS" else word for word in command], check=True, capture_output=True, text=True).stdout
    return list(csv.DictReader(result.splitlines()))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="directory of calcmysky and showmysky")
    parser.add_argument("--seconds", type=float, default=30)
    options = parser.parse_args()
    calcmysky, showmysky = (os.path.join(options.bin, name) for name in ("calcmysky", "showmysky"))
    print("| air | Sun | views | " + " | ".join(f"{angle:g}°" for angle in ANGLES) + " |")
    print("|---" * (3 + len(ANGLES)) + "|")
    with tempfile.TemporaryDirectory() as scratch:
        for name, text in airs():
            description, model = os.path.join(scratch, name + ".atmo"), os.path.join(scratch, name)
            with open(description, "w", encoding="utf-8") as file:
                file.write(text.replace("scattering orders: 4", "scattering orders: all"))
            subprocess.run([calcmysky, description, "--out-dir", model, "--only", "moments", "--radiance", "-q"], check=True)
            for zenith in ZENITH_ANGLES:
                asked = list(views(zenith))
                truth = answers([calcmysky, "reference", description, "QUESTIONS", "--orders", "all", "--relative-error", "0.003", "--seconds", str(options.seconds), "-q"],
                                ["altitude_m,sza_deg,vza_deg,relaz_deg,lambda_nm"] + [f"0,{zenith},{view},{azimuth},{WAVELENGTH}" for _, _, view, azimuth in asked], scratch)
                sky = answers([showmysky, "probe", model, "QUESTIONS", "--layers", "single,multiple"],
                              ["altitude_m,sun_zenith_deg,sun_azimuth_deg,view_zenith_deg,view_azimuth_deg"] + [f"0,{zenith},0,{view},{azimuth}" for _, _, view, azimuth in asked], scratch)
                cells = {"above": [], "beside": []}
                for (where, *_), true, seen in zip(asked, truth, sky):
                    light = float(true["L1_per_sr"]) + float(true["Lms_per_sr"])
                    radiance = next(float(seen[key]) for key in seen if key.startswith(f"L_{WAVELENGTH:g}")) / IRRADIANCE
                    cells[where].append(f"{100 * (radiance / light - 1):+.1f} ± {100 * float(true['Lms_stderr']) / light:.1f}")
                for where, row in cells.items():
                    print(f"| {name} | {zenith}° | {where} | " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
