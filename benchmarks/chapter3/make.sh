#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by benchmarks/reproduce.sh: measures, and makes the page.
#     make.sh PROGRAMS OUT [--quick]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../make_arguments.sh"

mkdir -p "$out/chapter3"
out=$(cd "$out" && pwd)
cd "$programs"
for figure in fig_3_5 fig_3_6 table_3_3 fig_3_9 fig_3_10 fig_3_11 fig_3_14 decision; do
    echo "$figure ..."
    # A line for each cell would be too many to read: one for fifty.
    ./$figure "$@" --benchmark_out="$out/chapter3/$figure.json" --benchmark_out_format=json |
        awk -v figure="$figure" 'index($0, figure "/") == 1 && ++cells % 50 == 0 {
            printf "%s: %d cells\n", figure, cells; fflush() }
            END { printf "%s: %d cells, done\n", figure, cells }'
    # Without the name of the machine and fields that are constant or redundant.
    sed -E '/"(host_name|run_name|run_type|family_index|per_family_instance_index|repetition_index|repetitions|threads)":/d' \
        "$out/chapter3/$figure.json" >"$out/chapter3/$figure.tmp"
    mv "$out/chapter3/$figure.tmp" "$out/chapter3/$figure.json"
done

# Of several Pythons, one that can draw.
python=python3
for candidate in python3 /usr/bin/python3; do
    if "$candidate" -c 'import matplotlib' 2>/dev/null; then python=$candidate && break; fi
done
exec "$python" "$here/page.py" "$out"
