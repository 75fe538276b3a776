# SPDX-License-Identifier: BSL-1.0
# Sourced by make.sh PROGRAMS OUT [--quick]: sets programs and out, and leaves what follows them.
usage() {
    echo "usage: make.sh PROGRAMS OUT [--quick]" >&2
    exit 2
}
[ $# -ge 2 ] || usage
programs=$1 out=$2
shift 2
case "$*" in '' | --quick) ;; *) usage ;; esac
[ -d "$programs" ] || usage
