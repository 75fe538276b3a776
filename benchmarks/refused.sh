# SPDX-License-Identifier: BSL-1.0
# Sourced by tests: refused COMMAND... requires a usage line and exit status 2.
refused() {
    status=0
    said=$("$@" 2>&1 >/dev/null) || status=$?
    case $status:$said in
        2:*usage:*) ;;
        *) echo "not refused, but $status: $*"; exit 1 ;;
    esac
}

# refused_by_make MAKE PROGRAMS OUT PAGE: so it is for what no make.sh and no page of results takes.
refused_by_make() {
    refused sh "$1"
    refused sh "$1" "$2"
    refused sh "$1" "$2" "$3" --slow
    refused sh "$1" "$2" "$3" --quick more
    refused sh "$1" "$2/nowhere" "$3"
    refused python3 "$(dirname "$1")/$4"
    refused python3 "$(dirname "$1")/$4" "$2/nowhere"
}
