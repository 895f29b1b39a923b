#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Unpacks a cloud of CGAL's Debian package libcgal-demo, unless it is there already.
#   sample_cloud.sh CLOUD.ply [NAME]
# NAME is that of a file of the package: building.ply (default), a laser scan; b9_training.ply, an airborne one.
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)

fail() { echo "sample_cloud.sh: $*" >&2; exit 1; }

[ $# -eq 1 ] || [ $# -eq 2 ] || fail "usage: sample_cloud.sh CLOUD.ply [NAME]"
name=${2:-building.ply}
[ ! -s "$1" ] || exit 0
folder=$(dirname "$1")
mkdir -p "$folder"
data=/usr/share/doc/libcgal-dev/data.tar.gz
[ -f $data ] || [ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" libcgal-demo
# Minimal containers drop /usr/share/doc when a package is installed: then the package itself is fetched and opened.
[ -f $data ] || {
  (cd "$folder" && apt-get download libcgal-demo && dpkg-deb -x libcgal-demo_*.deb package) ||
    fail "cannot get the package libcgal-demo, which has the sample cloud"
  data=$folder/package$data
}
tar -xzOf "$data" data/points_3/"$name" > "$1.part" || fail "no $name in $data"
mv "$1.part" "$1"
