#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Installs what is missing and builds the site, the reference with all pages:
#     sh docs/build.sh [DIR]            into DIR, build/site if not given
#     sh docs/build.sh --check [DIR]    and checks that every public name is three clicks from its start
# A public name without a description, or any other warning of doxygen, is an error.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/tools/setup.sh"

check=false
if [ "${1-}" = --check ]; then check=true; shift; fi
case ${1-} in
    -*) sed -n 's/^# \{0,1\}//p' "$0" | sed 1d; exit 2 ;;
    /*) GNOMON_SITE=$1 ;;
    ?*) GNOMON_SITE=$PWD/$1 ;;
    *) GNOMON_SITE=$root/build/site ;;
esac

set_up python3 doxygen doxygen-awesome-css universal-ctags
cd "$root"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
GNOMON_VERSION=$(sed -n 's/^#define GNOMON_VERSION_[A-Z]* //p' include/gnomon/version.hpp | paste -s -d .)
GNOMON_STYLE=/usr/share/doxygen-awesome-css
GNOMON_SCRATCH=$scratch
export GNOMON_SITE GNOMON_SCRATCH GNOMON_VERSION GNOMON_STYLE

# The addresses of names in the headers, then the pages that link them, then all of it.
mkdir -p "$scratch/pages" "$GNOMON_SITE"
rm -rf "$GNOMON_SITE/files" "$GNOMON_SITE/search"
rm -f "$GNOMON_SITE"/*.html
python3 docs/site/header_filter.py include "$scratch/include"
GNOMON_HTML=NO doxygen docs/site/Doxyfile || true  # warnings come again
python3 docs/site/make_pages.py "$scratch/tags.xml" "$scratch/include" "$scratch/pages" "$GNOMON_SITE"
GNOMON_HTML=YES doxygen docs/site/Doxyfile || {
    sed "s#$scratch/##g" "$scratch/warnings"
    exit 1
}
python3 docs/site/finish.py "$GNOMON_SITE" "$scratch/tags.xml"
if $check; then python3 docs/site/check_site.py "$GNOMON_SITE" "$scratch/tags.xml"; fi
echo "Site: $GNOMON_SITE/index.html"
