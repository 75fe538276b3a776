# shellcheck shell=sh disable=SC2034
# SPDX-License-Identifier: BSL-1.0
# Sourced by scripts that run the tests of some floors: floors_of FLOOR... sets the targets that build
# them, and the pattern of their labels.
floors_of() {
    targets='' labels=''
    for floor in "$@"; do
        targets="$targets ${floor}_tests"
        labels="$labels${labels:+|}$floor"
    done
    labels="^($labels)\$"
}
