# SPDX-License-Identifier: BSL-1.0
"""Runs gnomon and other libraries in turns on the same tasks, for all comparisons.

Every library has a program of its own (peer.hpp), started afresh for every setting. It gets the
cloud, puts it into the library's own container, and does the work once without being timed: this
warms up caches and threads, and shows quality and peak memory. Then come the rounds: in each, every
library does the work once, one after another, and each round begins with another library. So
whatever else happens on the machine happens to all. A program may use as many cores as threads, and
no more; OpenMP's threads sleep while it is not their turn.
"""

import argparse
import contextlib
import dataclasses
import functools
import json
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile
import time

OURS = "gnomon"
GAIN = "gain of threads"  # the task of rows that compare gnomon with itself
OFFICE = "pcl_office1_kinect.pcd"  # a scan of a depth camera

BUSY = 0.2  # cores that others use when it begins, above which the figures will scatter

HOW_TO_GET = {"nanoflann_newer": "not measured: GNOMON_NEWER_NANOFLANN_INCLUDE_DIR names none"}


class Refusal(Exception):
    """The reason why a library is not measured."""


def cores():
    """The cores that may be used; all, where the system does not list them."""
    if hasattr(os, "sched_getaffinity"):
        return sorted(os.sched_getaffinity(0))
    return list(range(os.cpu_count() or 1))


def confine(to):
    """Leaves only some cores to this process and those that it starts."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, to)


def cpu():
    """The name of the processor, and the widest vectors that it has."""
    info = pathlib.Path("/proc/cpuinfo")
    fields = {}
    if info.exists():
        for line in info.read_text(encoding="utf-8").splitlines():
            name, _, value = line.partition(":")
            fields.setdefault(name.strip(), value.strip())
    name = fields.get("model name") or platform.processor() or platform.machine()
    flags = fields.get("flags", "").split()
    for flag, vectors in (("avx512f", "AVX-512"), ("avx2", "AVX2")):
        if flag in flags:
            return f"{name}, {vectors}"
    return name


def busy_cores():
    """How many cores others keep busy, watched for a second; zero where the system is silent."""
    info = pathlib.Path("/proc/stat")
    if not info.exists():
        return 0.0

    def ticks():
        words = info.read_text(encoding="utf-8").split("\n", 1)[0].split()
        times = [int(word) for word in words[1:9]]
        return sum(times), times[3] + times[4]  # of these idle, or waiting for a disk

    all_before, idle_before = ticks()
    time.sleep(1)
    all_after, idle_after = ticks()
    idle = (idle_after - idle_before) / max(1, all_after - all_before)
    return round((1 - idle) * (os.cpu_count() or 1), 2)


class Worker:
    """One library at one setting, warmed up and waiting for its turns; on the last cores, or on
    some."""

    def __init__(self, program, job, cloud, reach, threads, on=None):
        environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_WAIT_POLICY="passive")
        self.process = subprocess.Popen(
            [program, job, cloud, str(reach), str(threads)], env=environment, bufsize=0,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            preexec_fn=lambda: confine(on or cores()[-threads:]))
        self.seconds = []
        self.failure = None
        self.warm_up = json.loads(self.answer())

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            raise Refusal(f"failed with status {self.process.wait()}")
        return line

    def take_turn(self):
        self.begin()
        self.end()

    def begin(self):
        with contextlib.suppress(BrokenPipeError):  # then there will be no answer
            self.process.stdin.write(b"\n")

    def end(self):
        if self.failure:
            return
        try:
            self.seconds.append(float(self.answer()))
        except Refusal as refusal:
            self.failure = str(refusal)

    def dismiss(self):
        self.process.stdin.close()
        self.process.wait()


@functools.cache
def describe(program):
    """The self-description of a program."""
    if not program.exists():
        raise Refusal(HOW_TO_GET.get(program.name, "not found; benchmarks/peers/install.sh installs it"))
    done = subprocess.run([program], capture_output=True, text=True)
    if done.returncode != 0:
        raise Refusal(f"does not start: {done.stderr.strip()}")
    return json.loads(done.stdout)


@dataclasses.dataclass(frozen=True)
class Part:
    """A part of a plan: a task on a cloud, at all combinations of some settings."""

    task: str
    cloud: str      # a name of cloud.cpp, or a file; NAME/POINTS takes that number of its points
    reaches: list   # numbers of neighbors; for clusters, radii [m]
    peers: dict     # the libraries, ours first, and the programs that they are in
    threads: tuple = (1, 2)
    flags: tuple = ("portable", "native")  # the folders of programs
    rounds: int = 5
    left_out: dict = dataclasses.field(default_factory=dict)  # libraries, and why

    def settings(self, programs):
        """The folder, and the head of a row, for each combination."""
        name = "radius" if self.task == "clusters" else "k"
        folders = [programs / flags for flags in self.flags if (programs / flags / OURS).exists()]
        for folder in folders:
            for threads in self.threads:
                if threads > len(cores()):
                    continue
                for reach in self.reaches:
                    yield folder, {"task": self.task, "cloud": self.cloud, "points": None,
                                   name: reach, "threads": threads,
                                   "flags": describe(folder / OURS)["flags"]}


def reach_of(setting):
    return setting["radius"] if setting["task"] == "clusters" else setting["k"]


def blank(setting, library):
    """A row without measurements."""
    return dict(setting, library=library, version=None, seconds=None, ratio=None, gamma=None,
                peak_bytes=None)


def unmeasured(setting, library, note):
    """A row with the reason why nothing was measured."""
    return blank(setting, library) | {"note": note}


def enter(folder, setting, part, library, cloud):
    """A row of the result without times, and the worker that will measure them."""
    row = blank(setting, library)
    try:
        program = folder / part.peers[library]
        about = describe(program)
        row.update(version=about["version"], compiler=about["compiler"])
        if library in part.left_out:
            raise Refusal(part.left_out[library])
        job = {(job["task"], job["library"]): job for job in about["jobs"]}[part.task, library]
        if job["one_thread_only"] and setting["threads"] > 1:
            raise Refusal("has one thread only")
        worker = Worker(program, f"{part.task}/{library}", cloud, reach_of(setting),
                        setting["threads"])
    except Refusal as refusal:
        return dict(row, note=str(refusal)), None
    return row, worker


def figures(seconds, ours):
    """Medians and extremes over rounds: seconds, and ratios to ours in the same rounds."""
    ratios = [theirs / our for theirs, our in zip(seconds, ours)]
    median = statistics.median(seconds)
    return {
        "seconds": median, "seconds_low": min(seconds), "seconds_high": max(seconds),
        "ratio": round(median / statistics.median(ours), 3),
        "ratio_low": round(min(ratios), 3), "ratio_high": round(max(ratios), 3),
    }


def measure(folder, setting, part, cloud):
    """The rows of one setting."""
    entries = [enter(folder, setting, part, library, cloud) for library in part.peers]
    if not entries[0][1]:
        sys.exit(f"{OURS}: {entries[0][0]['note']}")
    workers = [worker for _, worker in entries if worker]
    for turn in range(part.rounds):
        first = turn % len(workers)
        for worker in workers[first:] + workers[:first]:
            worker.take_turn()
    for worker in workers:
        worker.dismiss()
    ours = entries[0][1]
    if ours.failure:
        sys.exit(f"{OURS}: {ours.failure}")
    for row, worker in entries:
        if worker and worker.failure:
            row["note"] = worker.failure
        elif worker:
            row.update(worker.warm_up)
            row.update(figures(worker.seconds, ours.seconds), rounds=part.rounds)
    return [row for row, _ in entries]


class Clouds:
    """Has the program `cloud` write clouds into a folder of its own. The last one stays there."""

    def __init__(self, programs, scans):
        self.program = programs / "cloud"
        self.scans = scans
        self.name = None

    def __enter__(self):
        self.folder = tempfile.TemporaryDirectory()
        return self

    def __exit__(self, *problem):
        self.folder.cleanup()

    def make(self, name):
        """The folder with a cloud, and how many points it has."""
        if name != self.name:
            self.name = None  # until it is made
            source, _, points = name.partition("/")
            if "." in source:
                if not (self.scans / source).exists():
                    raise Refusal(f"the scan {source} is not here")
                source = self.scans / source
            made = subprocess.run(
                [self.program, source, self.folder.name] + ([points] if points else []),
                capture_output=True, text=True)
            if made.returncode != 0:
                raise Refusal(made.stderr.strip())
            self.name = name
        return self.folder.name, (pathlib.Path(self.folder.name) / "points").stat().st_size // 24


def text_of(setting):
    reach = f"r = {setting['radius']} m" if "radius" in setting else f"k = {setting['k']}"
    return (f"{setting['task']} of {setting['cloud']}, {reach}, threads: {setting['threads']}, "
            f"{setting['flags']}")


def measure_all(programs, clouds, plan):
    """All rows."""
    todo = [(part, *rest) for part in plan for rest in part.settings(programs)]
    rows = []
    for number, (part, folder, setting) in enumerate(todo, 1):
        print(f"[{number}/{len(todo)}] {text_of(setting)}", file=sys.stderr, flush=True)
        try:
            cloud, setting["points"] = clouds.make(part.cloud)
            rows += measure(folder, setting, part, cloud)
        except Refusal as refusal:
            rows.append(unmeasured(setting, None, str(refusal)))
    return rows


def main(name, full, quick, more=lambda programs, clouds, quick: []):
    """Measures a plan, adds the rows of more(programs, clouds, quick), and writes NAME.json."""
    parser = argparse.ArgumentParser(description="Compares gnomon with other libraries.")
    parser.add_argument("programs", type=pathlib.Path, help="the folder that they were built in")
    parser.add_argument("out", type=pathlib.Path, help=f"the folder for {name}.json")
    parser.add_argument("--scans", type=pathlib.Path, default=pathlib.Path("."),
                        help="where scans are that are no part of the repository")
    parser.add_argument("--quick", action="store_true", help="a smaller cloud and fewer rounds")
    arguments = parser.parse_args()
    programs = arguments.programs
    if not (programs / "cloud").exists():
        parser.error(f"{programs} holds no programs")

    machine = {"cpu": cpu(), "busy_cores": busy_cores()}
    if machine["busy_cores"] > BUSY:
        print(f"Others keep {machine['busy_cores']} cores busy: figures will scatter",
              file=sys.stderr)
    with Clouds(programs, arguments.scans) as clouds:
        rows = measure_all(programs, clouds, quick if arguments.quick else full)
        rows += more(programs, clouds, arguments.quick)
    arguments.out.mkdir(parents=True, exist_ok=True)
    lines = ",\n".join(json.dumps(row | machine) for row in rows)
    (arguments.out / f"{name}.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")
