# SPDX-License-Identifier: BSL-1.0
"""Checks that programs and scripts print their usage for --help, and do nothing else.

    help_test.py PROGRAM...

Programs that are not built are listed; one at least must be.
"""

import pathlib
import subprocess
import sys
import tempfile

INTERPRETERS = {".py": [sys.executable], ".sh": ["sh"]}

problems, missing = [], []
programs = [pathlib.Path(word).resolve() for word in sys.argv[1:]]
for program in programs:
    if not program.exists():
        missing.append(program.name)
        continue
    command = [*INTERPRETERS.get(program.suffix, []), str(program), "--help"]
    with tempfile.TemporaryDirectory() as folder:
        result = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                                text=True, timeout=60, check=False)
        written = list(pathlib.Path(folder).iterdir())
    # A script may print the comment at its head.
    is_usage = result.stdout.startswith(f"usage: {program.name}") or (
        program.suffix == ".sh" and program.name in result.stdout)
    if result.returncode != 0 or result.stderr or written or not is_usage:
        problems.append(f"{program}: exit status {result.returncode}, {result.stdout[:60]!r}, "
                        f"{result.stderr[:60]!r}, wrote {written}")

for line in problems:
    print(line)
if missing:
    print("not built:", *missing)
print(f"{len(programs) - len(missing)} programs, {len(problems)} problems")
sys.exit(1 if problems or len(missing) == len(programs) else 0)
