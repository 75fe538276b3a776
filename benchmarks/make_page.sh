#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by the make.sh of a folder: measures, and makes the page.
#     make_page.sh FOLDER PROGRAMS OUT [--quick]
set -eu
name=$1
shift
here=$(cd "$(dirname "$0")" && pwd)
. "$here/make_arguments.sh"
. "$here/../tools/setup.sh"
python=$(python_with matplotlib)

mkdir -p "$out/$name"
out=$(cd "$out" && pwd)
for program in $("$python" "$here/$name/page.py" --programs); do
    if ! [ -x "$programs/$program" ]; then
        echo "$program: left out, as a dependency is not installed"
        continue
    fi
    echo "$program ..."
    "$programs/$program" "$@" --out "$out/$name"
done
exec "$python" "$here/$name/page.py" "$out"
