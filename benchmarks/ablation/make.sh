#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by benchmarks/reproduce.sh: measures, and makes the page.
#     make.sh PROGRAMS OUT [--quick]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../make_arguments.sh"
. "$here/../../tools/setup.sh"
python=$(python_with json)

mkdir -p "$out/ablation"
"$python" "$here/measure.py" "$programs" "$out" "$@"
exec "$python" "$here/page.py" "$out"
