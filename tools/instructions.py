# SPDX-License-Identifier: BSL-1.0
"""Counts the instructions of a command under valgrind. Unlike seconds, they are the same on a busy
machine."""

import re
import shutil
import subprocess
import sys

COUNTING = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
            "--trace-children=yes"]


def require_valgrind(what):
    """Leaves with 77, the code of a skipped test, if there is no valgrind."""
    if not shutil.which(COUNTING[0]):
        print(f"{what} not checked: there is no valgrind here")
        sys.exit(77)


def instructions(command):
    """How many a command takes, with the processes that it starts."""
    run = subprocess.run([*COUNTING, *command], stderr=subprocess.PIPE, text=True, check=False)
    counts = re.findall(r"I +refs: +([\d,]+)", run.stderr)
    if run.returncode != 0 or not counts:
        sys.exit(run.stderr)
    return sum(int(count.replace(",", "")) for count in counts)


def hold(needed, limit):
    """Prints how many instructions each of two commands needs, and leaves with 1 if the second needs
    more than `limit` times those of the first."""
    theirs, ours = needed.values()
    for name, count in needed.items():
        print(f"{name:20} {count / 1e9:6.2f} billion instructions")
    print(f"{'ratio':20} {ours / theirs:6.2f}   (limit {limit})")
    sys.exit(0 if ours <= limit * theirs else 1)
