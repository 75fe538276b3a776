#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# A test: what makes no sense gets a usage line, and leaves with 2.
#     bad_arguments.sh MAKE PROGRAMS
set -eu
make=$1 programs=$2
. "$(dirname "$0")/../refused.sh"

refused_by_make "$make" "$programs" "$programs/surfaces_out" page.py
refused "$programs/rooms"
refused "$programs/rooms" --out "$programs/surfaces_out" --density thrice
refused "$programs/rooms" --out "$programs/surfaces_out" --seeds 1 0
refused "$programs/floors" --out "$programs/surfaces_out" --slow
refused "$programs/scans"
refused "$programs/limits" --out "$programs/surfaces_out" --slow
