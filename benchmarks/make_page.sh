#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by the make.sh of a folder: measures, and makes the page.
#     make_page.sh FOLDER PROGRAMS OUT [--quick]
set -eu
name=$1
shift
usage() {
    echo "usage: make.sh PROGRAMS OUT [--quick]" >&2
    exit 2
}
[ $# -ge 2 ] || usage
here=$(cd "$(dirname "$0")" && pwd)
programs=$1 out=$2
shift 2
case "$*" in '' | --quick) ;; *) usage ;; esac
[ -d "$programs" ] || usage
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
