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
