#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds the manual as HTML, after installing Doxygen if it is missing. Fails on any warning. Numbers of the method are
# those of the headers of tuning constants, by tuning.py beside its pages.
# A new page is listed in the table of Shape_regularization_tandem.txt and in the \tandemPages of the pages before and
# after it, a new example in examples.txt. After a change of the results, figures/draw.py draws pictures and writes tables
# again.
#   TANDEM_DOC_DIR    where to (default: build/doc of this repository)
#   TANDEM_CGAL_TAGS  folder of the tag files of CGAL's manual (NAME.tag), with which names of CGAL are links to
#                     https://doc.cgal.org (default: where CGAL's documentation is installed, if it is; empty: no links)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
doc=$root/doc/Shape_regularization_tandem
TANDEM_DOC_DIR=${TANDEM_DOC_DIR:-$root/build/doc}
export TANDEM_DOC_DIR

fail() { echo "doc.sh: $*" >&2; exit 1; }

# Settings of Doxygen for the tag files of folder $1, of the packages that the manual depends on.
tag_settings()
{
  while read -r package; do
    [ ! -r "$1/$package.tag" ] || echo "TAGFILES += \"$1/$package.tag=https://doc.cgal.org/latest/$package\""
  done < "$doc/dependencies"
  # Where this name is not known, Doxygen would take it for the function of this package.
  # shellcheck disable=SC2016
  ! grep -qs '<name>regularize_planes</name>' "$1/Shape_regularization.tag" ||
    echo 'ALIASES += "cgalRegularize=`CGAL::Shape_regularization::Planes::regularize_planes()`"'
}

[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" doxygen python3
mkdir -p "$TANDEM_DOC_DIR/numbers"
python3 "$doc/tuning.py" page > "$TANDEM_DOC_DIR/numbers/Numbers.txt"
settings=$(python3 "$doc/tuning.py" aliases)
tags=${TANDEM_CGAL_TAGS-$(find -L /usr/share/doc/*[cC][gG][aA][lL]* /usr/local/share/doc/*[cC][gG][aA][lL]* -maxdepth 3 \
  -name Kernel_23.tag 2> /dev/null | sed -n '1s|/[^/]*$||p')}
if [ -n "$tags" ]; then
  tags=$(cd "$tags" && pwd) || fail "TANDEM_CGAL_TAGS is no folder"
  links=$(tag_settings "$tags")
  [ -n "$links" ] || fail "$tags has no tag file of a package that the manual depends on"
fi
cd "$root"
pictures=$(echo doc/Shape_regularization_tandem/fig/*)
{ cat "$doc/Doxyfile" && printf '%s\n' "HTML_EXTRA_FILES = $pictures" "$settings" "${links:-}"; } | doxygen - > "$TANDEM_DOC_DIR/doxygen.log" 2>&1 ||
  { cat "$TANDEM_DOC_DIR/doxygen.log" >&2; fail "Doxygen has warnings or errors"; }
echo "Manual: $TANDEM_DOC_DIR/html/index.html"
