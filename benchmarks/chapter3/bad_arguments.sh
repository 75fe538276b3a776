#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# A test: what makes no sense gets a usage line, and leaves with 2.
#     bad_arguments.sh MAKE PROGRAMS
set -eu
make=$1 programs=$2
. "$(dirname "$0")/../refused.sh"

refused sh "$make"
refused sh "$make" "$programs"
refused sh "$make" "$programs" "$programs/chapter3_out" --slow
refused sh "$make" "$programs/nowhere" "$programs/chapter3_out"
refused sh "$make" "$programs" "$programs/chapter3_out" --quick more
refused "$programs/fig_3_5" --slow
refused "$programs/fig_3_9" more
refused python3 "$(dirname "$make")/report.py"
refused python3 "$(dirname "$make")/report.py" "$programs/nowhere"
