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
STEPS = ["reading", "spacing", "floor", "index", "noise", "cells", "normals", "planes", "assignment",
         "merging", "planes of surfaces", "description", "picture", "writing"]
FILES = ["normals.ply", "segments.json", "segments.ply", "segments.png"]
SEGMENT = ["label", "points", "centroid", "normal", "flat", "surface_variation", "aspect_ratio",
           "box_size", "plane", "viewpoint"]
WRONG_OPTIONS = [
    ["--k", "0"], ["--k", "-1"], ["--k", "2.5"], ["--k", ""], ["--k"],
    ["--max-angle", "-1"], ["--max-angle", "90.5"], ["--max-angle", "nan"], ["--max-angle", "x"],
    ["--min-points", "0"], ["--min-points", "-3"], ["--min-points", "1e3"],
    ["--merge", "all"], ["--merge", ""],
    ["--noise", "radar"], ["--noise", "0"], ["--noise", "-0.01"], ["--noise", "nan"],
    ["--noise", "inf"], ["--noise", "0.01m"], ["--noise", ""],
    ["--sigma", "measured"], ["--sigma", "0"], ["--sigma", "stereo"],
    ["--viewpoint", "1,2"], ["--viewpoint", "1,2,nan"], ["--viewpoint", "1,2,3,4"],
    ["--up", "0,0,0"], ["--up", "up"], ["--threads", "-1"], ["--threads", "2000"],
    ["--remove-floor=yes"], ["--tolerance", "1"], ["a_second_scan.xyz"],
]


def check(condition, message):
    if not condition:
        sys.exit(str(message))


def plate(unit):
    """A plate of 40 x 40 points, 1 cm apart, in front of the sensor; `unit` of them are 1 m."""
    return "".join(f"{unit * (0.01 * i - 0.2)} {unit * (0.01 * j - 0.2)} {unit * 2.0}\n"
                   for i in range(40) for j in range(40))


def ball():
    """Points all around the sensor."""
    points = [(i, j, k) for i in range(-9, 10) for j in range(-9, 10) for k in range(-9, 10)]
    return "".join(f"{x} {y} {z}\n" for x, y, z in points if 80 <= x * x + y * y + z * z <= 100)


def run(directory, name, text, *options):
    scan = directory / f"{name}.xyz"
    scan.write_text(text, encoding="utf-8")
    out = directory / f"{name}_out"
    return out, subprocess.run([program, scan, "--out", out, *options], capture_output=True,
                               text=True, check=False)


def report_of(directory, name, text, *options):
    """What the program reports of a scan, which it must be able to segment."""
    out, result = run(directory, name, text, *options)
    check(result.returncode == 0, f"{name}: {result.stderr}")
    check(sorted(p.name for p in out.iterdir()) == FILES, f"{name}: {sorted(out.iterdir())}")
    return json.loads((out / "segments.json").read_text(encoding="utf-8")), result.stderr


def near(a, b, tolerance):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b, strict=True))


def check_plate(report):
    check([s["points"] for s in report["segments"]] == [1600], report["segments"])
    segment = report["segments"][0]
    check(sorted(segment) == sorted(SEGMENT), list(segment))
    check(segment["label"] == 0 and segment["flat"] is True, segment)
    check(near(segment["centroid"], [-0.005, -0.005, 2.0], 1e-6), segment["centroid"])
    check(near(segment["normal"], [0, 0, -1], 1e-6), segment["normal"])
    check(segment["viewpoint"] == [0, 0, 0], segment["viewpoint"])
    plane = segment["plane"]
    check(near(plane["normal"], [0, 0, -1], 1e-6), plane)
    check(abs(plane["offset"] + 2.0) <= 1e-6, plane)
    check(near(plane["axes"][2], plane["normal"], 1e-9), plane)
    check([len(row) for row in plane["covariance"]] == [3, 3, 3], plane)
    check(all(0 < plane["covariance"][i][i] < 1e-4 for i in range(3)), plane)


with tempfile.TemporaryDirectory() as name:
    directory = pathlib.Path(name)

    out, result = run(directory, "no_finite_point", "nan nan nan\n" * 100)
    check(result.returncode == 1, f"no finite point: exit status {result.returncode}")
    check("no finite point" in result.stderr and result.stderr.count("\n") == 1, result.stderr)
    check(not out.exists() and not result.stdout, "no finite point: something was written")

    for options in WRONG_OPTIONS:
        out, result = run(directory, "wrong", plate(1.0), *options)
        check(result.returncode == 2, f"{options}: exit status {result.returncode}")
        check("usage: segment_scan" in result.stderr, f"{options}: {result.stderr}")
        check(not out.exists() and not result.stdout, f"{options}: something was written")

    result = subprocess.run([program, "--help"], capture_output=True, text=True, check=False)
    check(result.returncode == 0 and "--noise" in result.stdout and not result.stderr, result)

    # A camera has an optical axis.
    out, result = run(directory, "all_around", ball(), "--noise", "stereo")
    check(result.returncode == 1 and "optical axis" in result.stderr, result.stderr)
    check(not out.exists(), "all around: something was written")

    report, messages = report_of(directory, "metres", plate(1.0), "--noise", "0.005")
    check("metres" not in messages, messages)
    check(report["points"] == report["valid"] == 1600, report["valid"])
    check(report["noise"] == {"model": "constant", "at_1m": 0.005, "at_3m": 0.005}, report["noise"])
    check(report["segments_before_merging"] == 1, report["segments_before_merging"])
    check_plate(report)
    seconds = report["seconds"]
    check(sorted(seconds) == sorted([*STEPS, "total"]), seconds)
    total = sum(seconds[step] for step in STEPS)
    check(abs(seconds["total"] - total) <= 1e-9 * total, seconds)

    same, _ = report_of(directory, "sigma", plate(1.0), "--sigma", "0.005")
    check(same["noise"] == report["noise"] and same["segments"] == report["segments"], same)

    report, _ = report_of(directory, "camera", plate(1.0), "--noise", "structured_light")
    check_plate(report)
    check(report["noise"]["model"] == "structured_light", report["noise"])
    check(abs(report["noise"]["at_3m"] - (0.0012 + 0.0019 * 2.6**2)) <= 1e-9, report["noise"])

    # A plate without noise has none to measure.
    report, _ = report_of(directory, "unknown", plate(1.0), "--merge", "none")
    check(report["noise"]["model"] == "across_surface" and report["noise"]["reason"],
          report["noise"])
    check("merging" not in report["seconds"], report["seconds"])
    check_plate(report)

    report, _ = report_of(directory, "few", plate(1.0), "--noise=0.005", "--min-points=2000")
    check(report["segments"] == [], report["segments"])

    report, _ = report_of(directory, "seen_from", plate(1.0), "--noise=0.005", "--viewpoint=0,0,4")
    check(near(report["segments"][0]["normal"], [0, 0, 1], 1e-6), report["segments"])
    check(report["segments"][0]["viewpoint"] == [0, 0, 4], report["segments"])

    # In millimetres the points are 10 "m" apart.
    _, messages = report_of(directory, "millimetres", plate(1000.0))
    check(sum("metres" in line for line in messages.splitlines()) == 1, messages)
