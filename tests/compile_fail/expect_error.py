# SPDX-License-Identifier: BSL-1.0
"""Checks that a file does not compile, and that the compiler gives the reason we want users to read.

    expect_error.py FILE COMPILER [OPTION...]

Each comment of the file that begins with `// expect: ` holds a regular expression that the compiler's
output must match. If it begins with `// expect first: `, the first error must match, without its
position: the line that has `error:`, and with clang the source line that its first note shows, if the
error only says that a function is deleted.
"""

import pathlib
import re
import subprocess
import sys

source, *command = sys.argv[1:]
text = pathlib.Path(source).read_text(encoding="utf-8")
expected = re.findall(r"^// expect( first)?: (.+)$", text, re.M)
if not expected:
    sys.exit(f"{source}: no line '// expect: REGEX' or '// expect first: REGEX'")

result = subprocess.run([*command, source], capture_output=True, text=True, check=False)
if result.returncode == 0:
    sys.exit(f"{source}: compiles, but should not")
error = re.search(r"\berror: (.*)$", result.stderr, re.M)
for first, pattern in expected:
    searched = result.stderr if not first else error[1] if error else ""
    if not re.search(pattern, searched):
        sys.exit(f"{source}: no match for '{pattern}' in\n{result.stderr}")
