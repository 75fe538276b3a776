# SPDX-License-Identifier: BSL-1.0
"""Checks that a file does not compile, and that the compiler gives the reason we want users to read.

    expect_error.py FILE COMPILER [OPTION...]

The first comment of the file that begins with `// expect: ` holds a regular expression that the
compiler's output must match.
"""

import pathlib
import re
import subprocess
import sys

source, *command = sys.argv[1:]
expected = re.search(r"^// expect: (.+)$", pathlib.Path(source).read_text(encoding="utf-8"), re.M)
if not expected:
    sys.exit(f"{source}: no line '// expect: REGEX'")

result = subprocess.run([*command, source], capture_output=True, text=True, check=False)
if result.returncode == 0:
    sys.exit(f"{source}: compiles, but should not")
if not re.search(expected[1], result.stderr):
    sys.exit(f"{source}: no match for '{expected[1]}' in\n{result.stderr}")
