# SPDX-License-Identifier: BSL-1.0
"""Checks exit status, messages and report of the program segment_scan.

    segment_scan_test.py PROGRAM
"""

import json
import math
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

program = sys.argv[1]
STEPS = ["reading", "spacing", "floor", "index", "noise", "cells", "normals", "planes", "assignment",
         "merging", "planes of surfaces", "description", "picture", "writing"]
FILES = ["normals.ply", "segments.json", "segments.ply", "segments.png"]
SEGMENT = ["label", "points", "centroid", "normal", "flat", "surface_variation", "aspect_ratio",
           "box_size", "plane", "box", "polygon", "viewpoint"]
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
    ["--remove-floor=yes"], ["--polygons=1"], ["--tolerance", "1"], ["a_second_scan.xyz"],
]


def check(condition, message):
    if not condition:
        sys.exit(str(message))


def plate(unit):
    """A plate of 40 x 40 points, 1 cm apart, in front of the sensor; `unit` of them are 1 m."""
    return "".join(f"{unit * (0.01 * i - 0.2)} {unit * (0.01 * j - 0.2)} {unit * 2.0}\n"
                   for i in range(40) for j in range(40))


def slanted_wall():
    """A wall of 2 m x 1.5 m with a window of 0.6 m x 0.5 m, 3 m from the sensor, in no direction of
    the axes, and a wall of 0.6 m x 1.5 m at 1 m from its edge."""
    u, v, n = (0.6, 0.48, 0.64), (-0.8, 0.36, 0.48), (0.0, -0.8, 0.6)
    lines = []
    for i in range(181):
        for j in range(76):
            x, y = 0.02 * i - 1.0, 0.02 * j - 0.75
            if (abs(x) > 0.29 or abs(y) > 0.24) and not 1.01 < x < 1.99:
                lines.append(" ".join(f"{x * a + y * b + 3 * c:.9f}" for a, b, c in zip(u, v, n)))
    return "\n".join(lines) + "\n"


def ball():
    """Points all around the sensor."""
    points = [(i, j, k) for i in range(-9, 10) for j in range(-9, 10) for k in range(-9, 10)]
    return "".join(f"{x} {y} {z}\n" for x, y, z in points if 80 <= x * x + y * y + z * z <= 100)


def run(directory, name, text, *options, environment=()):
    scan = directory / f"{name}.xyz"
    scan.write_text(text, encoding="utf-8")
    out = directory / f"{name}_out"
    return out, subprocess.run([program, scan, "--out", out, *options], capture_output=True,
                               text=True, check=False, env={**os.environ, **dict(environment)})


def report_of(directory, name, text, *options):
    """What the program reports of a scan, which it must be able to segment."""
    files = sorted(FILES + ["polygons.ply"] if "--polygons" in options else FILES)
    out, result = run(directory, name, text, *options)
    check(result.returncode == 0, f"{name}: {result.stderr}")
    check(sorted(p.name for p in out.iterdir()) == files, f"{name}: {sorted(out.iterdir())}")
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
    box = segment["box"]
    check(near(box["lengths"], [0.39, 0.39, 0.0], 1e-6), box)
    check(near(box["center"], [-0.005, -0.005, 2.0], 1e-6), box)
    check(box["axes"] == plane["axes"], box)
    polygon = segment["polygon"]
    check(abs(polygon["area"] - 0.39**2) <= 1e-6 and not polygon["holes"], polygon)
    check(len(polygon["outline"]) == 4 * 39 and not polygon["islands"], polygon)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b, strict=True))


def cross(a, b):
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def area_within(path, normal):
    """Of a closed path in a plane, positive if it is counterclockwise seen against the normal."""
    total = [0.0, 0.0, 0.0]
    for a, b in zip(path, path[1:] + path[:1]):
        total = [t + c for t, c in zip(total, cross(a, b))]
    return dot(total, normal) / 2


def check_wall(segment):
    """The wall with its window, and its covariance about the axes of its box."""
    plane, box, polygon = segment["plane"], segment["box"], segment["polygon"]
    check(near(box["lengths"], [3.6, 1.5, 0.0], 0.02), box)
    check(near(plane["normal"], [0.0, 0.8, -0.6], 1e-3), plane)
    check(near(box["axes"][2], plane["normal"], 1e-9), box)
    check(abs(abs(dot(box["axes"][0], [0.6, 0.48, 0.64])) - 1.0) <= 1e-3, box)
    check(near(cross(box["axes"][0], box["axes"][1]), box["axes"][2], 1e-9), box)
    covariance = plane["covariance"]
    check(covariance[0][0] > 2 * covariance[1][1] > 0, covariance)  # the wall is long along axis 0
    check(len(polygon["holes"]) == 1 and len(polygon["islands"]) == 1, polygon["islands"])
    window = area_within(polygon["holes"][0], plane["normal"])
    outline = area_within(polygon["outline"], plane["normal"])
    island = polygon["islands"][0]
    check(abs(window + 0.6 * 0.5) <= 0.02, window)
    check(abs(outline - 2.0 * 1.5) <= 0.02, outline)
    check(abs(polygon["area"] - outline - window) <= 1e-6, polygon["area"])
    check(abs(island["area"] - 0.6 * 1.5) <= 0.03 and not island["holes"], island["area"])
    for corner in polygon["outline"] + polygon["holes"][0] + island["outline"]:
        check(abs(dot(corner, plane["normal"]) - plane["offset"]) <= 1e-9, corner)


def check_mesh(path, report):
    """The triangles are as large as the polygons of the segments whose labels they have."""
    header, data = path.read_bytes().split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in header.decode().splitlines()
              if line.startswith("element")]
    vertices = [struct.unpack_from("<3d3Bi", data, 31 * i) for i in range(counts[0])]
    area = [0.0] * len(report["segments"])
    for i in range(counts[1]):
        size, *corners = struct.unpack_from("<B3I", data, 31 * counts[0] + 13 * i)
        check(size == 3, size)
        a, b, c = (vertices[corner] for corner in corners)
        check(a[3:] == b[3:] == c[3:], (a, b, c))
        normal = cross([y - x for x, y in zip(a[:3], b)], [y - x for x, y in zip(a[:3], c)])
        segment = report["segments"][a[6]]
        # Corners on one line, moved along their rays, leave triangles of no area but of rounding.
        check(dot(normal, segment["plane"]["normal"]) > -1e-12, normal)
        area[a[6]] += math.sqrt(dot(normal, normal)) / 2
    check(len(data) == 31 * counts[0] + 13 * counts[1], counts)
    for segment, total in zip(report["segments"], area, strict=True):
        polygon = segment["polygon"]
        wanted = sum(p["area"] for p in [polygon, *polygon["islands"]]) if polygon else 0.0
        check(abs(total - wanted) <= 1e-6, (total, wanted))


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

    # The total that is printed is the sum of the steps that are printed.
    _, result = run(directory, "printed", plate(1.0), "--noise=0.005")
    times = dict(re.findall(r"^([a-z ]+?) +(\d+\.\d{3}) s$", result.stdout, re.M))
    check(list(times) == [*seconds], list(times))
    total = sum(round(1000 * float(times[step])) for step in STEPS)
    check(round(1000 * float(times["total"])) == total, times)

    # Without a font the picture has no labels.
    _, result = run(directory, "no_font", plate(1.0), "--noise=0.005",
                    environment={"GNOMON_FONT": str(directory / "no_font.ttf")})
    check(result.returncode == 0 and "labels are left out" in result.stderr, result)
    bare = (directory / "no_font_out" / "segments.png").read_bytes()
    lettered = (directory / "printed_out" / "segments.png").read_bytes()
    check(bare[:8] == lettered[:8] == b"\x89PNG\r\n\x1a\n" and bare != lettered, "no labels")

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

    report, _ = report_of(directory, "wall", slanted_wall(), "--noise=0.01", "--merge=liberal",
                          "--polygons")
    check_wall(report["segments"][0])
    check_mesh(directory / "wall_out" / "polygons.ply", report)

    # Segments that are not flat have a box, but no polygon, and are not in the mesh.
    report, _ = report_of(directory, "ball", ball(), "--noise=0.01", "--polygons", "--max-angle=90")
    check_mesh(directory / "ball_out" / "polygons.ply", report)
    for segment in report["segments"]:
        check((segment["polygon"] is None) == (segment["plane"] is None), segment["flat"])
        check(segment["box"]["lengths"][2] >= 0, segment["box"])

    report, _ = report_of(directory, "few", plate(1.0), "--noise=0.005", "--min-points=2000")
    check(report["segments"] == [], report["segments"])

    report, _ = report_of(directory, "seen_from", plate(1.0), "--noise=0.005", "--viewpoint=0,0,4")
    check(near(report["segments"][0]["normal"], [0, 0, 1], 1e-6), report["segments"])
    check(report["segments"][0]["viewpoint"] == [0, 0, 4], report["segments"])

    # In millimetres the points are 10 "m" apart.
    _, messages = report_of(directory, "millimetres", plate(1000.0))
    check(sum("metres" in line for line in messages.splitlines()) == 1, messages)
