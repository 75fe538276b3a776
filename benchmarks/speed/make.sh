#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by benchmarks/reproduce.sh:
#     make.sh FOLDER OUT [--quick]     measures the programs of FOLDER/../peers, and makes the page
#     make.sh --check OUT              compares the page there with what its figures make
set -eu
usage() {
    sed -n 's/^#  *make.sh/usage: make.sh/p' "$0" >&2
    exit 2
}
[ $# -ge 2 ] || usage
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
. "$root/tools/setup.sh"
python=$(python_with matplotlib)

folder=$1 out=$2
shift 2
if [ "$folder" = --check ]; then exec "$python" "$here/page.py" --check "$out"; fi
"$python" "$here/measure.py" "$(dirname "$folder")/peers" "$out" --scans "$root/../shared/data/scans" "$@"
"$python" "$here/page.py" "$out"
