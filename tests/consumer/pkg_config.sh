#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Compiles and runs the consumer with what pkg-config says:
#     pkg_config.sh PKGCONFIG_DIR OUT_DIR COMPILER
set -eu
command -v pkg-config >/dev/null || exit 77

here=$(cd "$(dirname "$0")" && pwd)
export PKG_CONFIG_PATH="$1"
mkdir -p "$2"
# shellcheck disable=SC2046  # the flags are words
"$3" -std=c++20 $(pkg-config --cflags gnomon) "$here/main.cpp" -o "$2/consumer" \
    $(pkg-config --libs gnomon)
"$2/consumer"
