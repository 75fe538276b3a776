#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# A test: what makes no sense gets a usage line, and leaves with 2.
#     bad_arguments.sh MAKE PROGRAMS
set -eu
make=$1 programs=$2
here=$(dirname "$make")
. "$(dirname "$0")/../refused.sh"

refused sh "$make"
refused sh "$make" "$programs"
refused sh "$make" "$programs" "$programs/ablation_out" --slow
refused sh "$make" "$programs/nowhere" "$programs/ablation_out"
refused "$programs/score"
refused "$programs/score" --chain
refused "$programs/score" --chain "$programs/chain.so" --without everything
refused "$programs/score" --chain "$programs/chain.so" --noise little
refused "$programs/score" --chain "$programs/chain.so" --seeds 30001 0
refused python3 "$here/measure.py" "$programs"
refused python3 "$here/measure.py" "$programs/nowhere" "$programs/ablation_out"
refused python3 "$here/measure.py" "$programs" "$programs/ablation_out" --rooms 0
refused python3 "$here/page.py"
refused python3 "$here/page.py" "$programs/nowhere"
