#!/usr/bin/env python3
"""Error of the baked tables of scattering against the time to make them: each of their sizes halved and doubled around small ones, as CSV.

    bench/textures.py BIN > OUT/textures.csv

BIN is the directory of the programs. The judge is bench/reference/earth.csv, as for the moments in bench/run, which calls this and draws the plot.
"""
import csv
import os
import re
import resource
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
AXES = {"view angles": "VZA", "azimuths": "dot(view,sun)", "suns": "SZA", "altitudes": "altitude"}
SMALL = {"view angles": 128, "azimuths": 8, "suns": 32, "altitudes": 32}
FULL = {"view angles": 128, "azimuths": 16, "suns": 128, "altitudes": 64}
REGIMES = ("day", "sunset", "twilight", "from high up")


def variants():
    """Label and sizes."""
    yield "small", SMALL
    for axis, size in SMALL.items():
        yield f"half the {axis}", SMALL | {axis: size // 2}
        yield f"twice the {axis}", SMALL | {axis: 2 * size}
    yield "half the altitudes, twice the suns", SMALL | {"altitudes": SMALL["altitudes"] // 2, "suns": 2 * SMALL["suns"]}
    yield "full", FULL


def processor_time():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def measure(programs, sizes, scratch):
    """Processor time in s; megabytes; rms error and its uncertainty in % by regime."""
    with open(os.path.join(HERE, "earth-small-4-wavelengths.atmo"), encoding="utf-8") as file:
        text = file.read()
    for axis, size in sizes.items():
        text, found = re.subn(rf"(?m)^(scattering texture size for {re.escape(AXES[axis])}): .*", rf"\1: {size}", text)
        assert found == 1, axis
    description, model = os.path.join(scratch, "sizes.atmo"), os.path.join(scratch, "model")
    with open(description, "w", encoding="utf-8") as file:
        file.write(text)
    before = processor_time()
    subprocess.run([os.path.join(programs, "calcmysky"), description, "--out-dir", model, "--radiance", "--only", "single,multiple", "-q"], check=True)
    seconds = processor_time() - before
    table = subprocess.run([os.path.join(programs, "bench_accuracy"), model, os.path.join(HERE, "reference/earth.csv"), "--source", "textures"],
                           check=True, capture_output=True, text=True).stdout
    errors = [re.search(rf"(?m)^{regime} +\d+ +([\d.]+) % +([\d.]+) %", table).groups() for regime in REGIMES]
    megabytes = sum(os.path.getsize(os.path.join(model, name)) for name in os.listdir(model)) / 1e6
    return seconds, megabytes, errors


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["label", *AXES, "processor_s", "megabytes", *(f"{regime}{what}" for regime in REGIMES for what in ("", " uncertainty"))])
    for label, sizes in variants():
        with tempfile.TemporaryDirectory() as scratch:
            seconds, megabytes, errors = measure(sys.argv[1], sizes, scratch)
        out.writerow([label, *sizes.values(), f"{seconds:.2f}", f"{megabytes:.2f}", *(value for pair in errors for value in pair)])
        sys.stdout.flush()


if __name__ == "__main__":
    main()
