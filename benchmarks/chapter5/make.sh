#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Called by benchmarks/reproduce.sh: measures, and makes the page.
#     make.sh PROGRAMS OUT [--quick]
exec sh "$(dirname "$0")/../make_page.sh" chapter5 "$@"
