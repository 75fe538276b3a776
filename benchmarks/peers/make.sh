#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by benchmarks/reproduce.sh:
#     make.sh PROGRAMS OUT [--quick]     measures, and makes the page
#     make.sh --check OUT                compares the page there with what its figures make
# by measure.py and page.py in this folder, or in that which --scripts names before.
set -eu
usage() {
    sed -n 's/^#  *make.sh/usage: make.sh/p' "$0" >&2
    exit 2
}
here=$(cd "$(dirname "$0")" && pwd)
scripts=$here
if [ "${1-}" = --scripts ]; then scripts=$2; shift 2; fi
[ $# -ge 2 ] || usage
root=$here/../..
. "$root/tools/setup.sh"
python=$(python_with matplotlib)

programs=$1 out=$2
shift 2
if [ "$programs" = --check ]; then exec "$python" "$scripts/page.py" --check "$out"; fi
"$python" "$scripts/measure.py" "$programs" "$out" --scans "$root/../shared/data/scans" "$@"
"$python" "$scripts/page.py" "$out"
