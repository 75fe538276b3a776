# SPDX-License-Identifier: BSL-1.0
"""Checks exit status, messages and report of the program segment_scan.

    segment_scan_test.py PROGRAM
"""

import json
import pathlib
import subprocess
import sys
import tempfile

program = sys.argv[1]
STEPS = ["read", "spacing", "preprocessing", "index", "normals", "segmentation", "merging",
         "assignment",         "description", "picture", "writing"]


def check(condition, message):
    if not condition:
        sys.exit(message)


def plate(unit):
    """A plate of 40 x 40 points, 1 cm apart, in front of the sensor; `unit` of them are 1 m."""
    return "".join(f"{unit * (0.01 * i - 0.2)} {unit * (0.01 * j - 0.2)} {unit * 2.0}\n"
                   for i in range(40) for j in range(40))


def run(directory, name, text):
    scan = directory / f"{name}.xyz"
    scan.write_text(text, encoding="utf-8")
    out = directory / f"{name}_out"
    return out, subprocess.run([program, scan, "--out", out], capture_output=True, text=True,
                               check=False)


with tempfile.TemporaryDirectory() as name:
    directory = pathlib.Path(name)

    out, result = run(directory, "no_finite_point", "nan nan nan\n" * 100)
    check(result.returncode == 1, f"no finite point: exit status {result.returncode}")
    check("no finite point" in result.stderr and result.stderr.count("\n") == 1, result.stderr)
    check(not out.exists() and not result.stdout, "no finite point: something was written")

    out, result = run(directory, "metres", plate(1.0))
    check(result.returncode == 0, result.stderr)
    check("metres" not in result.stderr, result.stderr)
    report = json.loads((out / "segments.json").read_text(encoding="utf-8"))
    check([s["points"] for s in report["segments"]] == [1600], report["segments"])
    seconds = report["seconds"]
    check(sorted(seconds) == sorted([*STEPS, "total"]), seconds)
    total = sum(seconds[step] for step in STEPS)
    check(abs(seconds["total"] - total) <= 1e-9 * total, seconds)

    # In millimetres the points are 10 "m" apart.
    out, result = run(directory, "millimetres", plate(1000.0))
    check(result.returncode == 0, result.stderr)
    lines = [line for line in result.stderr.splitlines() if "metres" in line]
    check(len(lines) == 1, result.stderr)
    check((out / "segments.json").exists(), "millimetres: nothing was written")
