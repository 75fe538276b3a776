#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# A test: what makes no sense gets a usage line, and leaves with 2.
#     bad_arguments.sh MAKE PROGRAMS
set -eu
make=$1 programs=$2
. "$(dirname "$0")/../refused.sh"

refused_by_make "$make" "$programs" "$programs/chapter3_out" page.py
refused "$programs/fig_3_5" --slow
refused "$programs/fig_3_9" more
