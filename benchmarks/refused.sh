# SPDX-License-Identifier: BSL-1.0
# To be read by tests: refused COMMAND... wants it to give a usage line, and to leave with 2.
refused() {
    status=0
    said=$("$@" 2>&1 >/dev/null) || status=$?
    case $status:$said in
        2:*usage:*) ;;
        *) echo "not refused, but $status: $*"; exit 1 ;;
    esac
}
