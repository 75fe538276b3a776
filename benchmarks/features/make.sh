#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by benchmarks/reproduce.sh: measures, and makes the page.
#     make.sh PROGRAMS OUT [--quick]
set -eu
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
. "$here/../../tools/setup.sh"
python=$(python_with matplotlib)

mkdir -p "$out/features"
out=$(cd "$out" && pwd)
for program in $("$python" "$here/page.py" --programs); do
    echo "$program ..."
    "$programs/$program" "$@" --out "$out/features"
done
exec "$python" "$here/page.py" "$out"
