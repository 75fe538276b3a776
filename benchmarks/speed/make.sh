#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by benchmarks/reproduce.sh: as ../peers/make.sh, on the programs of peers, FOLDER/../peers.
#     make.sh FOLDER OUT [--quick]
#     make.sh --check OUT
set -eu
here=$(cd "$(dirname "$0")" && pwd)
case ${1-} in
    --check | '') ;;
    *) programs=$(dirname "$1")/peers; shift; set -- "$programs" "$@" ;;
esac
exec sh "$here/../peers/make.sh" --scripts "$here" "$@"
