# SPDX-License-Identifier: BSL-1.0
"""Learning of furniture, and its recognition in simulated rooms: results, exit status and messages of the
programs learn_objects and recognize_scan, and of segment_scan --model.

    recognize_scan_test.py LEARN_OBJECTS RECOGNIZE_SCAN SEGMENT_SCAN SIMULATE_SCAN
"""

import collections
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

LEARN, RECOGNIZE, SEGMENT, SIMULATE = sys.argv[1:5]
VIEW = ["name", "probability", "best", "second", "points", "center", "pose", "box", "log_ratio",
        "evidence"]
BOARD = "v 0 0 {z}\nv 0.5 0 {z}\nv 0.5 0.5 {z}\nv 0 0.5 {z}\nf 1 2 3 4\nv 0.2 0.2 0\nf 1 2 5\n"


def boxes(*extents):
    """A mesh file of boxes, each of (x, y, z) from and to."""
    text = ""
    for number, (low, high) in enumerate(extents):
        for corner in range(8):
            text += "v" + "".join(f" {(high if corner >> a & 1 else low)[a]}" for a in range(3)) + "\n"
        for face in ("1342", "5687", "1265", "3784", "1573", "2486"):
            text += "f" + "".join(f" {int(c) + 8 * number}" for c in face) + "\n"
    return text


# A desk with a drawer unit, unlike all that is built in.
STAND = boxes(((0, 0, 0.72), (1.1, 0.5, 0.76)), ((0, 0, 0), (0.04, 0.5, 0.72)),
              ((0.7, 0.02, 0.2), (1.1, 0.48, 0.72)))
TYPES = {"double": "d", "float": "f", "int": "i", "uint": "I", "uchar": "B"}


def check(condition, message):
    if not condition:
        sys.exit(str(message))


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          check=False)


def must(*command):
    result = run(*command)
    check(result.returncode == 0, f"{command}: {result.stderr}")
    return result.stdout


def columns_of(path):
    """The columns of a binary PLY file of points."""
    header, data = path.read_bytes().split(b"end_header\n", 1)
    properties = re.findall(r"property (\w+) (\w+)", header.decode())
    rows = struct.iter_unpack("<" + "".join(TYPES[kind] for kind, _ in properties), data)
    return dict(zip((name for _, name in properties), zip(*rows), strict=True))


def check_view(view):
    check(list(view) == VIEW, list(view))
    check(0 <= view["probability"] <= 1, view["probability"])
    total = sum(e["log_ratio"] for e in view["evidence"])
    check(abs(total - view["log_ratio"]) <= 1e-9, (total, view["log_ratio"]))
    check(view["name"] in (view["best"], "background"), view["name"])
    check(view["best"] != view["second"], view["best"])
    check(view["center"] == view["box"]["center"], view)
    check(0 <= view["pose"]["yaw"] < math.pi + 1e-9, view["pose"])
    check(all(e["what"] for e in view["evidence"]), view["evidence"])


def class_in_office(name):
    """The class of a piece of furniture for a model of learn_objects --office."""
    if name == "stool":
        return None
    return "chair" if "chair" in name or name == "carver" else "table"


def check_room(directory, model, seed, class_of=lambda name: name):
    """The furniture of a room that is well seen, and what of it is recognized."""
    room, out = directory / f"room{seed}", directory / f"found{seed}"
    must(SIMULATE, "--scene", "furnished_room", "--seed", seed, "--sigma", "0.005", "--out", room)
    table = must(RECOGNIZE, room / "scan.ply", "--model", model, "--out", out)
    check(sorted(p.name for p in out.iterdir()) == ["labeled.ply", "objects.json", "recognized.png"],
          list(out.iterdir()))
    report = json.loads((out / "objects.json").read_text(encoding="utf-8"))
    points = columns_of(out / "labeled.ply")
    names = json.loads((room / "names.json").read_text(encoding="utf-8"))["objects"]
    furniture = {i: re.sub(r" \d+$", "", n) for i, n in enumerate(names) if re.search(r" \d+$", n)}
    sizes = collections.Counter(points["object"])
    seen = {i for i in furniture if sizes[i] >= 500}
    right, wrong, found = 0, 0, set()
    for label, view in enumerate(report["views"]):
        check_view(view)
        objects = collections.Counter(
            o for o, l in zip(points["object"], points["label"], strict=True) if l == label)
        check(view["points"] == sum(objects.values()), (label, view["points"]))
        if view["name"] == "background":
            continue
        check(view["name"] in table and view["evidence"][0]["what"], table)
        number = objects.most_common(1)[0][0]
        if int(number) in furniture and class_of(furniture[int(number)]) == view["name"]:
            right += 1
            found.add(int(number))
        else:
            wrong += 1
    return room, len(seen), len(seen & found), right, wrong


def check_refusal(directory, message, *command):
    out = directory / "refused"
    result = run(*command, "--out", out)
    check(result.returncode == 1, f"{command}: exit status {result.returncode}")
    check(re.search(message, result.stderr) and result.stderr.count("\n") == 1, result.stderr)
    check(not out.exists() and not result.stdout, f"{command}: something was written")


def check_files(directory):
    """Learning from mesh files, where the program reads these."""
    models = directory / "models"
    (models / "shelf").mkdir(parents=True)
    (models / "background").mkdir()
    for name, height in [("stand.obj", 0.9), ("shelf/low.obj", 0.2), ("shelf/lower.obj", 0.3),
                         ("background/other.obj", 0.5)]:
        (models / name).write_text(BOARD.format(z=height), encoding="utf-8")
    (models / "notes.txt").write_text("no model", encoding="utf-8")
    model = directory / "files.json"
    result = run(LEARN, "--models", models, "--views", 6, "--out", model)
    if "without Assimp" in result.stderr:
        return
    check(result.returncode == 0, result.stderr)
    learned = json.loads(model.read_text(encoding="utf-8"))
    check(sorted(learned["classes"]) == ["background", "shelf", "stand"], learned["classes"])
    large = directory / "large.obj"
    large.write_text(BOARD.format(z=900).replace("0.5", "500"), encoding="utf-8")  # millimetres
    check_refusal(directory, "metres", LEARN, "--models", large)
    large.write_text(BOARD.format(z=0.9).replace("0.5", "4.8"), encoding="utf-8")
    check("left out: large" in must(SIMULATE, "--scene", "furnished_room", "--furniture", large,
                                    "--out", directory / "large_room"), "too large for a room")
    (models / "stand.obj").write_text("v 0 0 0\n", encoding="utf-8")
    check_refusal(directory, "stand.obj", LEARN, "--models", models)
    (directory / "no_models").mkdir()
    check_refusal(directory, "no mesh files", LEARN, "--models", directory / "no_models")
    (directory / "only" / "background").mkdir(parents=True)
    (directory / "only" / "background" / "a.obj").write_text(BOARD.format(z=1), encoding="utf-8")
    check_refusal(directory, "only", LEARN, "--models", directory / "only")


def check_own_file(directory):
    """A mesh file of one's own is learned, put into a simulated room, and recognized there."""
    stand = directory / "my_stand.obj"
    stand.write_text(STAND, encoding="utf-8")
    model, room, out = directory / "own.json", directory / "own_room", directory / "own_found"
    result = run(LEARN, "--models", stand, "--views", 16, "--out", model)
    if "without Assimp" in result.stderr:
        return
    check(result.returncode == 0, result.stderr)
    learned = json.loads(model.read_text(encoding="utf-8"))
    check(sorted(learned["classes"]) == ["background", "my_stand"], learned["classes"])
    must(SIMULATE, "--scene", "furnished_room", "--furniture", stand, "--sigma", "0.005", "--out", room)
    names = json.loads((room / "names.json").read_text(encoding="utf-8"))["objects"]
    check(sum(n.startswith("my_stand") for n in names) >= 3, names)
    must(RECOGNIZE, room / "scan.ply", "--model", model, "--out", out)
    report = json.loads((out / "objects.json").read_text(encoding="utf-8"))
    check("my_stand" in [v["name"] for v in report["views"]], report["views"])
    result = run(SIMULATE, "--furniture", stand, "--out", directory / "no_room")
    check(result.returncode == 2 and "furnished_room" in result.stderr, result.stderr)
    check_refusal(directory, "nowhere.obj", SIMULATE, "--scene", "furnished_room", "--furniture",
                  directory / "nowhere.obj")


def check_office(directory):
    """Chairs and tables of a room, whatever their kind."""
    model = directory / "office.json"
    printed = must(LEARN, "--office", "--views", 16, "--out", model)
    learned = json.loads(model.read_text(encoding="utf-8"))
    check(sorted(learned["classes"]) == ["background", "chair", "table"], printed)
    _, seen, found, right, wrong = check_room(directory, model, 23, class_in_office)
    check(found >= 0.5 * seen and wrong <= 0.15 * (right + wrong), (seen, found, right, wrong))
    mine = directory / "of_mine"
    for name in ("chair", "lamp", "background"):
        (mine / name).mkdir(parents=True)
        (mine / name / "mine.obj").write_text(STAND, encoding="utf-8")
    result = run(LEARN, "--office", "--models", mine, "--views", 1, "--out", model)
    if "without Assimp" in result.stderr:
        return
    check(result.returncode == 0, result.stderr)
    more = json.loads(model.read_text(encoding="utf-8"))
    check(sorted(more["classes"]) == ["background", "chair", "lamp", "table"], more["classes"])
    scans = re.search(r"^chair +(\d+)", result.stdout, re.M)
    check(scans and int(scans[1]) == 5 + 16 + 1, result.stdout)


with tempfile.TemporaryDirectory() as name:
    directory = pathlib.Path(name)
    model = directory / "model.json"

    printed = must(LEARN, "--views", 12, "--seed", 3, "--out", model)
    check("kitchen chair" in printed and "background" in printed, printed)
    text = model.read_text(encoding="utf-8")
    learned = json.loads(text)
    check(learned["version"] == 1 and len(learned["classes"]) == 13, learned["classes"])
    must(LEARN, "--views", 2, "--seed", 3, "--threads", 1, "--out", directory / "one.json")
    must(LEARN, "--views", 2, "--seed", 3, "--threads", 3, "--out", directory / "three.json")
    check((directory / "one.json").read_bytes() == (directory / "three.json").read_bytes(),
          "the model depends on the number of threads")

    rooms = [check_room(directory, model, seed) for seed in (21, 22)]
    seen, found, right, wrong = (sum(room[i] for room in rooms) for i in (1, 2, 3, 4))
    check(found >= 0.5 * seen and wrong <= 0.15 * (right + wrong), (seen, found, right, wrong))

    scan = rooms[0][0] / "scan.ply"
    out = directory / "segments"
    table = must(SEGMENT, scan, "--model", model, "--out", out)
    segments = json.loads((out / "segments.json").read_text(encoding="utf-8"))["segments"]
    named = [s["object"] for s in segments]
    check(set(named) <= {*learned["classes"], "background"}, named)
    check(len({*named} - {"background"}) > 0 and named[0] == "background", named)
    check(" object\n" in table, table)

    # Broken models are refused before the scan is read.
    missing = directory / "missing.ply"
    for broken, message in [("{", "byte 2: is not JSON"), (text[:len(text) // 2], "is not JSON"),
                            (text.replace('"version":1', '"version":7'), "version: is 7"),
                            (text.replace('"temperature"', '"warmth"'), "no field 'temperature'")]:
        file = directory / "broken.json"
        file.write_text(broken, encoding="utf-8")
        check_refusal(directory, message, RECOGNIZE, missing, "--model", file)
        check_refusal(directory, message, SEGMENT, missing, "--model", file)
    check_refusal(directory, "none.json", RECOGNIZE, scan, "--model", directory / "none.json")
    check_refusal(directory, "missing.ply", RECOGNIZE, missing, "--model", model)
    empty = directory / "empty.xyz"
    for content, message in [("", "empty.xyz"), ("nan nan nan\n" * 50, "no finite point"),
                             ("1 2 3\n" * 50, "has no floor"),
                             (STAND, "a mesh, which is no scan")]:
        empty.write_text(content, encoding="utf-8")
        check_refusal(directory, message, RECOGNIZE, empty, "--model", model)
    # A floor that is not in the scan can be named; there is nothing on it.
    empty.write_text("1 2 3\n" * 50, encoding="utf-8")
    must(RECOGNIZE, empty, "--model", model, "--floor", "0", "--out", directory / "nothing")
    report = json.loads((directory / "nothing" / "objects.json").read_text(encoding="utf-8"))
    check(report["views"] == [], report["views"])

    for options in [[], [scan], ["--model", model], [scan, "--model", ""],
                    [scan, "--model", model, "--noise", "0"],
                    [scan, "--model", model, "--up", "0,0,0"],
                    [scan, "--model", model, "--floor", "low"],
                    [scan, "--model", model, "--min-probability", "1.5"],
                    [scan, "--model", model, "--divergence", "-1"],
                    [scan, "--model", model, "--viewpoint", "1,2"]]:
        result = run(RECOGNIZE, *options, "--out", directory / "wrong")
        check(result.returncode == 2 and "usage: recognize_scan" in result.stderr, result.stderr)
    for options in [["--views", "0"], ["--views", "x"], ["--seed", "-1"], ["--sigma", "0"],
                    ["chair.obj"], ["--models", ""]]:
        result = run(LEARN, *options, "--out", directory / "wrong")
        check(result.returncode == 2 and "usage: learn_objects" in result.stderr, result.stderr)
    result = run(LEARN)
    check(result.returncode == 2 and "--out MODEL is missing" in result.stderr, result.stderr)
    check(not (directory / "wrong").exists(), "wrong options: something was written")
    check_refusal(directory, "no_such_folder", LEARN, "--models", directory / "no_such_folder")
    result = run(LEARN, "--views", 1, "--out", directory)
    check(result.returncode == 1, result)
    for program in (LEARN, RECOGNIZE):
        check("usage" in must(program, "--help"), program)
    check_files(directory)
    check_own_file(directory)
    check_office(directory)
