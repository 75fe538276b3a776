#!/usr/bin/env python3
# SPDX-License-Identifier: BSL-1.0
"""Lets gnomon and its peers do the same work in turns, and writes what it took as peers.json.

Every library has a program of its own (peer.hpp), started afresh for every setting. It gets the
cloud, puts it into the library's own container, and does the work once without being timed: this
warms up caches and threads, and shows quality and peak memory. Then come the rounds: in each, every
library does the work once, one after another, and each round begins with another library. So
whatever else happens on the machine happens to all. A program may use as many cores as threads, and
no more; OpenMP's threads sleep while it is not their turn.
"""

import argparse
import contextlib
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

# The libraries that know a task, and the programs that they are in.
PEERS = {
    "normals": {
        OURS: "gnomon",
        "nanoflann + Eigen": "nanoflann",
        "PCL NormalEstimation": "pcl",
        "PCL NormalEstimationOMP": "pcl",
        "Open3D": "open3d",
        "CGAL pca": "cgal",
        "CGAL jet": "cgal",
        "ANN + GSL": "ann_gsl",
    },
}

# What to measure: task, cloud, numbers of neighbors. Clouds are those of cloud.cpp, or files.
FULL = [("normals", "kitchen", [10, 20, 30, 50]),
        ("normals", "pcl_office1_kinect.pcd", [30])]
QUICK = [("normals", "kitchen_medium", [20])]
THREADS = [1, 2]
BUSY = 0.2  # cores that others use when it begins, above which the figures will scatter


class Refusal(Exception):
    """Why there is nothing to measure."""


def cores():
    """The cores that may be used, or as many numbers where the system does not tell."""
    if hasattr(os, "sched_getaffinity"):
        return sorted(os.sched_getaffinity(0))
    return list(range(os.cpu_count() or 1))


def confine(count):
    """Leaves only some cores to this process and those that it starts."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, cores()[-count:])


def cpu():
    """The name of the processor."""
    info = pathlib.Path("/proc/cpuinfo")
    if info.exists():
        for line in info.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


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
    """One library at one setting, warmed up and waiting for its turns."""

    def __init__(self, program, job, cloud, k, threads):
        environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_WAIT_POLICY="passive")
        self.process = subprocess.Popen(
            [program, job, cloud, str(k), str(threads)], env=environment, bufsize=0,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, preexec_fn=lambda: confine(threads))
        self.seconds = []
        self.failure = None
        self.warm_up = json.loads(self.answer())

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            raise Refusal(f"failed with status {self.process.wait()}")
        return line

    def take_turn(self):
        if self.failure:
            return
        with contextlib.suppress(BrokenPipeError):  # then there will be no answer
            self.process.stdin.write(b"\n")
        try:
            self.seconds.append(float(self.answer()))
        except Refusal as refusal:
            self.failure = str(refusal)

    def dismiss(self):
        self.process.stdin.close()
        self.process.wait()


def describe(program):
    """What a program says of itself."""
    if not program.exists():
        raise Refusal("not found; benchmarks/peers/install.sh installs it")
    told = subprocess.run([program], capture_output=True, text=True)
    if told.returncode != 0:
        raise Refusal(f"does not start: {told.stderr.strip()}")
    return json.loads(told.stdout)


def enter(folder, setting, library, cloud):
    """A row of the result as far as it is known now, and the worker that will fill it."""
    row = dict(setting, library=library, version=None, seconds=None, ratio=None, gamma=None,
               peak_bytes=None)
    try:
        program = folder / PEERS[setting["task"]][library]
        about = describe(program)
        row.update(version=about["version"], compiler=about["compiler"])
        job = {job["library"]: job for job in about["jobs"]}[library]
        if job["one_thread_only"] and setting["threads"] > 1:
            raise Refusal("has one thread only")
        worker = Worker(program, f"{setting['task']}/{library}", cloud, setting["k"],
                        setting["threads"])
    except Refusal as refusal:
        return dict(row, note=str(refusal)), None
    return row, worker


def figures(seconds, ours):
    """Medians and extremes of some rounds, in seconds and beside ours in the same rounds."""
    ratios = [theirs / our for theirs, our in zip(seconds, ours)]
    median = statistics.median(seconds)
    return {
        "seconds": median, "seconds_low": min(seconds), "seconds_high": max(seconds),
        "ratio": round(median / statistics.median(ours), 3),
        "ratio_low": round(min(ratios), 3), "ratio_high": round(max(ratios), 3),
    }


def measure(folder, setting, cloud, rounds):
    """The rows of one setting."""
    entries = [enter(folder, setting, library, cloud) for library in PEERS[setting["task"]]]
    if not entries[0][1]:
        sys.exit(f"{OURS}: {entries[0][0]['note']}")
    workers = [worker for _, worker in entries if worker]
    for turn in range(rounds):
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
            row.update(figures(worker.seconds, ours.seconds), rounds=rounds)
    return [row for row, _ in entries]


def make_cloud(programs, name, scans, directory):
    """Has the program `cloud` write a cloud; how many points it has."""
    source = name
    if "." in name:
        source = scans / name
        if not source.exists():
            raise Refusal(f"the scan {name} is not here")
    made = subprocess.run([programs / "cloud", source, directory], capture_output=True, text=True)
    if made.returncode != 0:
        raise Refusal(made.stderr.strip())
    return (pathlib.Path(directory) / "points").stat().st_size // 24


def settings(plan, flags_of, threads):
    """All that is to be measured, as the head of a row."""
    for task, cloud, ks in plan:
        for flags in flags_of:
            for count in threads:
                for k in ks:
                    yield dict(task=task, cloud=cloud, points=None, k=k, threads=count, flags=flags)


def measure_all(programs, scans, plan, rounds):
    """All rows."""
    folders = [folder for folder in (programs / "portable", programs / "native")
               if (folder / OURS).exists()]
    folder_of = {describe(folder / OURS)["flags"]: folder for folder in folders}
    threads = [count for count in THREADS if count <= len(cores())]
    todo = list(settings(plan, folder_of, threads))
    rows = []
    for number, setting in enumerate(todo, 1):
        head = (f"{setting['task']} of {setting['cloud']}, k = {setting['k']}, threads: "
                f"{setting['threads']}, {setting['flags']}")
        print(f"[{number}/{len(todo)}] {head}", file=sys.stderr, flush=True)
        with tempfile.TemporaryDirectory() as cloud:
            try:
                setting["points"] = make_cloud(programs, setting["cloud"], scans, cloud)
                rows += measure(folder_of[setting["flags"]], setting, cloud, rounds)
            except Refusal as refusal:
                rows.append(dict(setting, library=None, version=None, seconds=None, ratio=None,
                                 gamma=None, peak_bytes=None, note=str(refusal)))
    return rows


def main():
    parser = argparse.ArgumentParser(description="Measures gnomon beside other libraries.")
    parser.add_argument("programs", type=pathlib.Path, help="the folder that they were built in")
    parser.add_argument("out", type=pathlib.Path, help="the folder for peers.json")
    parser.add_argument("--scans", type=pathlib.Path, default=pathlib.Path("."),
                        help="where scans are that are no part of the repository")
    parser.add_argument("--quick", action="store_true", help="a smaller cloud and fewer rounds")
    arguments = parser.parse_args()
    if not (arguments.programs / "cloud").exists():
        parser.error(f"{arguments.programs} holds no programs")

    machine = {"cpu": cpu(), "busy_cores": busy_cores()}
    if machine["busy_cores"] > BUSY:
        print(f"Others keep {machine['busy_cores']} cores busy: figures will scatter",
              file=sys.stderr)
    rows = measure_all(arguments.programs, arguments.scans, QUICK if arguments.quick else FULL,
                       rounds=3 if arguments.quick else 5)
    arguments.out.mkdir(parents=True, exist_ok=True)
    lines = ",\n".join(json.dumps(row | machine) for row in rows)
    (arguments.out / "peers.json").write_text(f"[\n{lines}\n]\n", encoding="utf-8")


main()
