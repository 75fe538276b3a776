#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Whether the page of a folder is what its measurements say, by a Python that can draw:
#     check_page.sh FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../tools/setup.sh"
exec "$(python_with matplotlib)" "$here/$1/page.py" --check "$here/../docs/results"
