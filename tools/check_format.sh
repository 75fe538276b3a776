#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Layout by clang-format 16 (other versions differ), spelling by codespell. Leaves with 77 where one
# of them is missing and the other has nothing to say.
set -eu
cd "$(dirname "$0")/.."
status=0

if command -v clang-format-16 >/dev/null; then
    find include tests examples benchmarks -name '*.[ch]pp' -exec clang-format-16 --dry-run -Werror {} + ||
        status=1
else
    echo "clang-format-16 is missing: layout not checked"
    status=77
fi

if command -v codespell >/dev/null; then
    codespell --ignore-words-list positionof,nees,frome --skip '.git,build,single_include,*_out' . || status=1
else
    echo "codespell is missing: spelling not checked"
    [ $status -ne 0 ] || status=77
fi
exit $status
