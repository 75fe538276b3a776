#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Measures the variants of the default chain, and writes OUT/ablation/variants.json.

    measure.py PROGRAMS OUT [--quick] [--rooms N] [--only TEXT] [--jobs N]

For each variant a copy of include/ is changed, chain.cpp is compiled with it, and score.cpp computes
the scores of the library. Libraries and scores are kept in PROGRAMS/variants: nothing is compiled or
measured twice, and a run that was stopped goes on where it was.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import queue
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # in a folder of sources

from variants import ROOT, all_variants, few_of_each_kind  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
FLAGS = ["-std=c++20", "-O1", "-DNDEBUG", "-fPIC", "-shared", "-fvisibility=hidden", "-pthread", "-w"]
FIRST_SEED = 30_001
COLUMNS = ["noise [mm]", "seed", "IoU", "by points", "impurity", "wanted", "right", "wrong"]


class Failure(Exception):
    """A variant that cannot be compiled or run."""


class Bench:
    """Compiles and runs variants, some at a time, each with a copy of include/ of its own."""

    def __init__(self, programs, jobs, words):
        self.score = programs / "score"
        self.settings = settings_of(programs)
        self.known = programs / "variants"  # libraries and scores, by digests of all that they depend on
        self.known.mkdir(exist_ok=True)
        self.words = words
        self.sources = hashlib.sha256(repr((self.settings, FLAGS)).encode())
        for file in sorted([*(ROOT / "include").rglob("*.hpp"), *HERE.glob("chain.*")]):
            self.sources.update(file.read_bytes())
        self.copies = queue.Queue()
        for i in range(jobs):
            shutil.rmtree(self.known / f"copy{i}", ignore_errors=True)
            shutil.copytree(ROOT / "include", self.known / f"copy{i}/include")
            self.copies.put(self.known / f"copy{i}")

    def measure(self, variant):
        """What the variant is, with its scores; equal libraries with equal options have equal digests."""
        copy = self.copies.get()
        try:
            library = self.compiled(variant, copy)
            digest = hashlib.sha256(library.read_bytes() + repr(variant.options).encode())
            row = {"kind": variant.kind, "what": variant.what, "place": variant.place,
                   "value": variant.value, "factor": variant.factor, "digest": digest.hexdigest()}
            words = [*self.words, *variant.options]
            digest.update(self.score.read_bytes() + repr(words).encode())
            scores = self.known / f"{digest.hexdigest()}.json"
            if not scores.exists():
                lines = run([self.score, "--chain", library, *words]).splitlines()
                (copy / "scores.json").write_text("[" + ",\n".join(lines) + "]\n", encoding="utf-8")
                (copy / "scores.json").rename(scores)
            found = json.loads(scores.read_text(encoding="utf-8"))
        except Failure as problem:
            raise Failure(f"{variant.what} {variant.value}: {problem}") from None
        finally:
            self.copies.put(copy)
        row["rooms"] = [[s[c] for c in COLUMNS] for s in found if "seed" in s]
        row["scans"] = [s for s in found if "scan" in s]
        return row

    def compiled(self, variant, copy):
        """The library of a variant."""
        changed = variant.headers(copy / "include")
        digest = self.sources.copy()
        digest.update(repr(sorted(changed.items())).encode())
        library = self.known / f"{digest.hexdigest()}.so"
        if library.exists():
            return library
        unchanged = {header: (copy / "include" / header).read_text(encoding="utf-8") for header in changed}
        write(copy / "include", changed)
        others = [word for folder in self.settings["includes"] if folder != self.settings["include"]
                  for word in ("-isystem", folder)]
        try:
            run([self.settings["compiler"], *FLAGS, "-Iinclude", *others, HERE / "chain.cpp", "-o", "chain.so"],
                copy)
            return (copy / "chain.so").rename(library)
        finally:
            write(copy / "include", unchanged)


def write(include, headers):
    for header, text in headers.items():
        (include / header).write_text(text, encoding="utf-8")


def run(words, folder=None):
    done = subprocess.run(list(map(str, words)), cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Failure(done.stderr.strip())
    return done.stdout


def settings_of(programs):
    return json.loads((programs / "compiler.json").read_text(encoding="utf-8"))


def scans_of(folder, quick):
    """The scans, or the smallest of them, if they are there."""
    found = sorted(pathlib.Path(folder).glob("*")) if os.path.isdir(folder) else []
    return [min(found, key=lambda scan: scan.stat().st_size)] if quick and found else found


def json_of(context, rows):
    """The measurements, one variant on a line."""
    lines = ",\n".join(" " + json.dumps(row, ensure_ascii=False) for row in rows)
    return f'{{"context": {json.dumps(context)},\n"variants": [\n{lines}\n]}}\n'


def main():
    parser = argparse.ArgumentParser(description="Measures the variants of the default chain.")
    parser.add_argument("programs", metavar="PROGRAMS", type=pathlib.Path)
    parser.add_argument("out", metavar="OUT", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true", help="one variant of each kind in one room")
    parser.add_argument("--rooms", type=int, default=16)
    parser.add_argument("--only", metavar="TEXT", default="", help="variants whose name has this in it")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    if not (options.programs / "score").exists():
        parser.error(f"there is no {options.programs / 'score'}")
    if options.rooms < 1 or options.jobs < 1:
        parser.error("there must be a room and a job")

    variants = [v for v in all_variants(ROOT / "include") if v.kind == "default" or options.only in v.what]
    if options.quick:
        variants, options.rooms = few_of_each_kind(variants), 1
    programs = options.programs.resolve()
    settings = settings_of(programs)
    words = ["--seeds", str(FIRST_SEED), str(options.rooms)]
    for scan in scans_of(settings["scans"], options.quick):
        words += ["--scan", str(scan)]
    bench = Bench(programs, options.jobs, words)
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as team:
        try:
            running = {v: team.submit(bench.measure, v) for v in variants if v.is_compiled}
            running[variants[0]].result()  # the others have the library of the default
            running.update((v, team.submit(bench.measure, v)) for v in variants if not v.is_compiled)
            for i, variant in enumerate(variants, 1):
                rows.append(running[variant].result())
                print(f"{i} of {len(variants)}: {variant.what} {variant.value}", flush=True)
        except Failure as problem:
            team.shutdown(cancel_futures=True)
            print(problem, file=sys.stderr)
            return 1

    context = {"quick": options.quick, "compiler": settings["version"],
               "flags": " ".join(FLAGS), "rooms": options.rooms, "first seed": FIRST_SEED, "columns": COLUMNS}
    (options.out / "ablation").mkdir(parents=True, exist_ok=True)
    (options.out / "ablation/variants.json").write_text(json_of(context, rows), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
