#!/usr/bin/env python3
"""Kills calcmysky at random moments and looks at what it leaves.

    kill_loop.py CALCMYSKY SHOWMYSKY ONE.atmo OTHER.atmo [--kills N] [--seed N]

Two models take turns in one directory. After each kill the directory is absent (only before the first model was completed), or
every byte of it is that of one of the two, and `showmysky info` opens it. Half of the kills come at any time; the other half when
the manifest has been written and the exchange of the directories is near. At the end a run that nobody kills leaves its model alone
in the place, with no debris. Exit code 77: there is no OpenGL here, nothing was tested.
"""

import argparse
import collections
import hashlib
import pathlib
import random
import subprocess
import sys
import tempfile
import time

ENDED = "ended before the kill"


def command(program, description, directory):
    return [program, description, "--out-dir", directory, "--quality", "draft", "--only", "moments,transmittance", "-q"]


def checksums(directory):
    return {str(path.relative_to(directory)): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(directory.rglob("*")) if path.is_file()}


def wait_for_manifest(place, process):
    while process.poll() is None:
        if any(place.glob(".model.partial-*/manifest.json")):
            return
        time.sleep(2e-4)


def killed(place, arguments, longest, random_numbers):
    """Starts a run and kills it; says when."""
    process = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    if random_numbers.random() < 0.5:
        moment = "any time"
        time.sleep(random_numbers.uniform(0, longest))
    else:
        moment = "near the exchange"
        wait_for_manifest(place, process)
        time.sleep(random_numbers.uniform(0, 0.004))
    process.kill()
    return moment if process.wait() < 0 else ENDED


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("calcmysky")
    parser.add_argument("showmysky")
    parser.add_argument("descriptions", nargs=2)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    random_numbers = random.Random(options.seed)

    with tempfile.TemporaryDirectory() as scratch:
        place = pathlib.Path(scratch, "place")
        model = place / "model"
        place.mkdir()
        known, runs, longest = {}, [], 0.0
        for name, description in zip(("one", "other"), options.descriptions):
            directory = pathlib.Path(scratch, name)
            start = time.monotonic()
            result = subprocess.run(command(options.calcmysky, description, directory), capture_output=True, text=True)
            longest = max(longest, time.monotonic() - start)
            if "context can be made" in result.stderr:
                print("SKIPPED: " + result.stderr.strip())
                return 77
            if result.returncode != 0:
                sys.exit(result.stderr)
            known[name] = checksums(directory)
            runs.append(command(options.calcmysky, description, model))

        seen, moments, completed = collections.Counter(), collections.Counter(), False
        for i in range(options.kills):
            moments[killed(place, runs[i % 2], longest, random_numbers)] += 1
            if not model.exists():
                if completed:
                    sys.exit(f"Kill {i + 1} took the model away.")
                seen["absent"] += 1
                continue
            completed = True
            found = checksums(model)
            names = [name for name, files in known.items() if files == found]
            if not names:
                sys.exit(f"Kill {i + 1} left something that is neither model: {found}")
            seen[names[0]] += 1
            info = subprocess.run([options.showmysky, "info", model], capture_output=True, text=True)
            if info.returncode != 0:
                sys.exit(f"Kill {i + 1} left a model that does not open: {info.stderr}")

        subprocess.run(runs[0], check=True) # which nobody kills
        if checksums(model) != known["one"] or [path.name for path in place.iterdir()] != ["model"]:
            sys.exit(f"The last run left {[path.name for path in place.iterdir()]}.")
    print("kills:", dict(moments))
    print("found:", dict(seen))


if __name__ == "__main__":
    sys.exit(main())
