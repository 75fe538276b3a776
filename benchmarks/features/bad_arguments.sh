#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# A test: what makes no sense gets a usage line, and leaves with 2.
#     bad_arguments.sh MAKE PROGRAMS
set -eu
make=$1 programs=$2
. "$(dirname "$0")/../refused.sh"

refused sh "$make"
refused sh "$make" "$programs"
refused sh "$make" "$programs" "$programs/features_out" --slow
refused sh "$make" "$programs/nowhere" "$programs/features_out"
refused "$programs/points"
refused "$programs/segments" --out "$programs/features_out" --slow
refused python3 "$(dirname "$make")/page.py"
refused python3 "$(dirname "$make")/page.py" "$programs/nowhere"
