#!/usr/bin/env python3
"""Memory that `--dry-run` announces, against what a run takes at its peak (resident set), for several models.

    bench/memory.py BIN [--full]

BIN is the directory of the programs. With --full also the large 4D tables (a minute each on two cores). A driver in software keeps the card's
buffers in the same memory; a graphics card has its own.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../examples")
UNITS = {"B": 1, "kB": 1e3, "MB": 1e6, "GB": 1e9}
QUICK = [
    ("earth-clear", ["--only", "moments"]),
    ("earth", ["--only", "moments"]),
    ("earth", ["--only", "moments", "--quality", "fine"]),
    ("hazy-city", ["--only", "moments"]),
    ("cloud", ["--only", "moments"]),
    ("cloud", ["--only", "moments", "--max-memory", "140M"]),
    ("mars", ["--only", "moments,single", "--altitudes", "0..3"]),
    ("earth-small", ["--skip", "eclipsed"]),
    ("earth-small", ["--skip", "eclipsed", "--radiance"]),
    ("earth-small", ["--only", "eclipsed", "--altitudes", "0..1"]),
]
FULL = [("earth", ["--skip", "eclipsed"]), ("earth", ["--skip", "eclipsed", "--radiance"])]


def announced(command):
    lines = subprocess.run(command + ["--dry-run"], check=True, capture_output=True, text=True).stdout.splitlines()
    total = next(line for line in lines if line.startswith("total"))
    value, unit = re.findall(r"([\d.]+) (kB|MB|GB|B)\b", total)[0] # time, memory, disk: the first that is a size
    return float(value) * UNITS[unit]


def taken(command):
    process = subprocess.Popen(command + ["-q"])
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(command)} failed.")
    return usage.ru_maxrss * 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", help="directory of calcmysky")
    parser.add_argument("--full", action="store_true", help="the large tables too")
    options = parser.parse_args()
    print(f"{'announced':>12} {'taken':>9} {'ratio':>6}  model")
    for name, more in QUICK + (FULL if options.full else []):
        with tempfile.TemporaryDirectory() as scratch:
            command = [os.path.join(options.bin, "calcmysky"), os.path.join(EXAMPLES, name + ".atmo"), "--out-dir", os.path.join(scratch, "m")] + more
            a, t = announced(command), taken(command)
            print(f"{a / 1e6:9.0f} MB {t / 1e6:6.0f} MB {a / t:6.2f}  {name} {' '.join(more)}", flush=True)


if __name__ == "__main__":
    main()
