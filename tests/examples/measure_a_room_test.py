# SPDX-License-Identifier: BSL-1.0
"""Checks exit status, messages and lengths of the program measure_a_room.

    measure_a_room_test.py PROGRAM
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

program = sys.argv[1]

# A room of 4 m x 3 m x 2.5 m with a door in one wall and a window in the opposite one.
SIZE = (4.0, 3.0, 2.5)
SENSOR = (1.9, 1.4, 1.3)
DOOR = (0.8, 1.7, 0.0, 2.0)  # x from, to, z from, to, in the wall y = 3
WINDOW = (2.1, 3.3, 0.9, 2.1)  # in the wall y = 0
THICK = 0.2


def check(condition, message):
    if not condition:
        sys.exit(str(message))


def hit(direction):
    """The first surface of the room in a direction, or nothing behind an opening."""
    ranges = [((SIZE[a] if direction[a] > 0 else 0.0) - SENSOR[a]) / direction[a]
              for a in range(3) if direction[a] != 0.0]
    nearest = min(r for r in ranges if r > 0)
    x, y, z = (SENSOR[a] + nearest * direction[a] for a in range(3))
    for wall, opening in ((SIZE[1], DOOR), (0.0, WINDOW)):
        if abs(y - wall) < 1e-9 and opening[0] < x < opening[1] and opening[2] < z < opening[3]:
            # The reveals, and no return behind them.
            exits = [((opening[1] if direction[0] > 0 else opening[0]) - SENSOR[0]) / direction[0],
                     ((opening[3] if direction[2] > 0 else opening[2]) - SENSOR[2]) / direction[2]]
            out = min(exits)
            behind = abs(SENSOR[1] + out * direction[1] - wall)
            return out if behind < THICK else None
    return nearest


def scan():
    """A scan all around, with noise of 2 mm, in a fixed pseudo-random order."""
    state, lines = 1, []
    for i in range(360):
        for j in range(170):
            azimuth, elevation = math.radians(i + 0.37), math.radians(j - 84.6)
            d = (math.cos(azimuth) * math.cos(elevation), math.sin(azimuth) * math.cos(elevation),
                 math.sin(elevation))
            noise = 0.0
            for _ in range(12):  # the sum of twelve uniform numbers is nearly normal
                state = (6364136223846793005 * state + 1442695040888963407) % 2 ** 64
                noise += state / 2 ** 64 - 0.5
            r = hit(d)
            if r is not None:
                lines.append(" ".join(f"{(r + 0.002 * noise) * c:.6f}" for c in d))
    return "\n".join(lines) + "\n"


def run(*arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    (folder / "room.xyz").write_text(scan(), encoding="utf-8")
    out = folder / "out"
    result = run(folder / "room.xyz", "--out", out)
    check(result.returncode == 0, result.stderr)
    check(sorted(p.name for p in out.iterdir()) == ["room.json", "room.png"], list(out.iterdir()))
    check((out / "room.png").read_bytes().startswith(b"\x89PNG"), "room.png is no PNG file")
    report = json.loads((out / "room.json").read_text(encoding="utf-8"))
    check(len(report["walls"]) == 4, report["walls"])
    check(sorted(o["name"] for o in report["openings"]) == ["door 1", "window 1"],
          report["openings"])
    lengths = {l["name"]: l for l in report["lengths"]}
    expected = {"length": 4.0, "width": 3.0, "height": 2.5, "door 1 width": 0.9,
                "door 1 height": 2.0, "window 1 width": 1.2, "window 1 height": 1.2,
                "window 1 sill": 0.9}
    for key, truth in expected.items():
        check(key in lengths, f"{key} is missing in {sorted(lengths)}")
        error, sigma = lengths[key]["value"] - truth, lengths[key]["sigma"]
        check(0.0 < sigma < 0.02, f"{key}: {sigma}")
        check(abs(error) < 4.0 * sigma, f"{key}: {error} +- {sigma}")
    for wall in ("length", "width", "height"):
        check(lengths[wall]["sigma"] < 1e-3, lengths[wall])
    along = sorted(l["value"] for l in report["lengths"] if l["kind"] == "wall")
    check(len(along) == 4, along)
    for value, truth in zip(along, (3.0, 3.0, 4.0, 4.0)):
        check(abs(value - truth) < 2e-3, along)

    (folder / "nothing.xyz").write_text("nan nan nan\n", encoding="utf-8")
    for arguments, status in ((["--out"], 2), ([], 2), (["--out", out, "--up", "0,0,0"], 2),
                              (["--out", out, "--sigma", "0"], 2),
                              ([folder / "missing.xyz", "--out", out], 1),
                              ([folder / "nothing.xyz", "--out", out], 1)):
        result = run(*arguments)
        check(result.returncode == status, f"{arguments}: {result.returncode} {result.stderr}")
        check(result.stderr.startswith("measure_a_room: "), result.stderr)
