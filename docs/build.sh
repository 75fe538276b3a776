#!/bin/sh
# SPDX-License-Identifier: BSL-1.0
# Installs what is missing and builds the site, the reference with all pages:
#     sh docs/build.sh [DIR]            into DIR, build/site if not given
#     sh docs/build.sh --check [DIR]    and checks links, and that every public name is near its start
#     sh docs/build.sh --test [DIR]     the same; leaves with 77 where doxygen is not installed
# A public name without a description, or any other warning of doxygen, is an error; warnings of other
# versions than 1.9.4, that of Debian 12, are only printed.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
. "$root/tools/setup.sh"

check=false
style=/usr/share/doxygen-awesome-css
case ${1-} in
    --check) check=true; shift ;;
    --test)
        check=true
        shift
        if ! command -v doxygen >/dev/null || ! [ -d $style ]; then
            echo "doxygen or doxygen-awesome-css is missing"
            exit 77
        fi
        ;;
esac
case ${1-} in
    --help) sed -n '3,8s/^# \{0,1\}//p' "$0"; exit 0 ;;
    -*) echo "build.sh: no option $1; see --help" >&2; exit 2 ;;
    /*) GNOMON_SITE=$1 ;;
    ?*) GNOMON_SITE=$PWD/$1 ;;
    *) GNOMON_SITE=$root/build/site ;;
esac

set_up python3 doxygen doxygen-awesome-css universal-ctags
warnings=NO
case $(doxygen --version) in 1.9.4*) warnings=FAIL_ON_WARNINGS ;; esac
cd "$root"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
GNOMON_VERSION=$(sed -n 's/^#define GNOMON_VERSION_[A-Z]* //p' include/gnomon/version.hpp | paste -s -d .)
GNOMON_STYLE=$style GNOMON_SCRATCH=$scratch GNOMON_WARNINGS=$warnings
export GNOMON_WARNINGS GNOMON_SITE GNOMON_SCRATCH GNOMON_VERSION GNOMON_STYLE

# The addresses of names in the headers, then the pages that link them, then all of it.
mkdir -p "$scratch/pages" "$GNOMON_SITE"
if [ -n "$(ls -A "$GNOMON_SITE")" ] && ! [ -f "$GNOMON_SITE/doxygen.css" ]; then
    echo "build.sh: $GNOMON_SITE has files that are not those of a site" >&2
    exit 2
fi
rm -rf "$GNOMON_SITE/files" "$GNOMON_SITE/search"
rm -f "$GNOMON_SITE"/*.html
python3 docs/site/header_filter.py include "$scratch/include"
GNOMON_HTML=NO doxygen docs/site/Doxyfile || true  # warnings come again
python3 docs/site/make_pages.py "$scratch/tags.xml" "$scratch/include" "$scratch/pages" "$GNOMON_SITE"
status=0
GNOMON_HTML=YES doxygen docs/site/Doxyfile || status=$?
sed "s#$scratch/##g" "$scratch/warnings"
[ $status = 0 ] || exit $status
python3 docs/site/finish.py "$GNOMON_SITE" "$scratch/tags.xml"
if $check; then python3 docs/site/check_site.py "$GNOMON_SITE" "$scratch/tags.xml"; fi
echo "Site: $GNOMON_SITE/index.html"
