#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by benchmarks/reproduce.sh: measures, and makes the page.
#     make.sh PROGRAMS OUT [--quick]
# A comparison with an older version of the library needs OUT/surfaces/rooms_before.json, by a
# program that older_library.hpp describes.
exec sh "$(dirname "$0")/../make_page.sh" surfaces "$@"
