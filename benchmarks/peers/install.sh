#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Installs the libraries that gnomon is compared with, where the system has them (1.4 GB, most of
# it what PCL and Open3D bring along):
#     sh benchmarks/peers/install.sh
# One by one, so that a library that cannot be had takes no other with it.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$root/tools/setup.sh"
for library in libcgal-dev libtbb-dev libann-dev libgsl-dev libpcl-dev libopen3d-dev valgrind; do
    set_up -- "$library"
done
