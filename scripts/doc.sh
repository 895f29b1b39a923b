#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds the manual as HTML, after installing Doxygen if it is missing. Fails on any warning.
#   doc.sh            the manual, with the pictures and tables of the repository
#   doc.sh --figures  draws these again first, by scripts/doc_figures.sh
#   TANDEM_DOC_DIR    where to (default: build/doc of this repository)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
TANDEM_DOC_DIR=${TANDEM_DOC_DIR:-$root/build/doc}
export TANDEM_DOC_DIR

fail() { echo "doc.sh: $*" >&2; exit 1; }

case ${1:-} in
  '') ;;
  --figures) "$root/scripts/doc_figures.sh" || exit 1 ;;
  *) fail "unknown argument $1; usage: doc.sh [--figures]" ;;
esac
[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" doxygen
mkdir -p "$TANDEM_DOC_DIR"
cd "$root"
doxygen doc/Shape_regularization_tandem/Doxyfile > "$TANDEM_DOC_DIR/doxygen.log" 2>&1 ||
  { cat "$TANDEM_DOC_DIR/doxygen.log" >&2; fail "Doxygen has warnings or errors"; }
echo "Manual: $TANDEM_DOC_DIR/html/index.html"
