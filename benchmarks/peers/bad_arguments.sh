#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# A test: what makes no sense gets a usage line, and leaves with 2.
#     bad_arguments.sh SOURCES BINARIES     the folders of a benchmark, peers or one built on it
set -eu
sources=$1 binaries=$2
programs=$(dirname "$binaries")/peers
. "$(dirname "$0")/../refused.sh"

refused sh "$sources/make.sh"
refused sh "$sources/make.sh" "$binaries"
refused sh "$sources/make.sh" "$binaries" "$binaries/results" --slow
refused sh "$sources/make.sh" "$binaries/nowhere/nowhere" "$binaries/results"
refused sh "$sources/make.sh" --check "$binaries/nowhere"
refused "$programs/cloud"
refused "$programs/cloud" kitchen "$binaries" 0
refused "$programs/cloud" kitchen "$binaries" ten
refused "$programs/portable/gnomon" normals/gnomon "$binaries" 0 1
refused "$programs/portable/gnomon" normals/gnomon "$binaries" 2.5 1
refused "$programs/portable/gnomon" clusters/gnomon "$binaries" -1 1
refused "$programs/portable/gnomon" clusters/nobody "$binaries" 1 1
refused "$programs/portable/gnomon" normals/gnomon "$binaries" 10 0
