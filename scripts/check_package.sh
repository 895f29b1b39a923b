#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes the Debian package of a build folder and looks at what is in it. As root, where mmdebstrap is installed, apt also
# installs it in a clean root, where the program finds the planes of a cube, and removes it without a trace; this loads
# some 100 MB.
#   check_package.sh BUILD FOLDER   FOLDER: is made anew

set -eu

[ $# -eq 2 ] || { echo "usage: check_package.sh BUILD FOLDER" >&2; exit 1; }
build=$1; folder=$2

fail() { echo "check_package.sh: $*" >&2; exit 1; }

# has PATTERN: the package has such a file
has() { grep -Eq "$1" "$folder/files" || fail "the package has no $1"; }

rm -rf "$folder"
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
(cd "$build" && cpack -G DEB -B "$folder/cpack") > "$folder/log" 2>&1 || { cat "$folder/log" >&2; fail "cpack failed"; }
mv "$folder"/cpack/tandem_*.deb "$folder/tandem.deb" || fail "there is no package"
dpkg-deb --contents "$folder/tandem.deb" | sed 's/.* \.\//\//' > "$folder/files"
dpkg-deb --extract "$folder/tandem.deb" "$folder/extracted"

has '^/usr/bin/detect_planes$'
has '^/usr/include/CGAL/Shape_regularization_tandem\.h$'
has '^/usr/lib/.*cmake/Tandem/TandemConfig\.cmake$'
has '^/usr/lib/.*libtandem_engine\.'
has '^/usr/lib/.*libtandem_models\.'
has '^/usr/share/bash-completion/completions/detect_planes$'
! grep -Ev '^/usr/(bin|include|lib|share)/|^/(usr/)?((bin|include|lib|share)/)?$' "$folder/files" || fail "files are elsewhere"
! grep -i python "$folder/files" || fail "it has a part of the Python module"
copyright=$folder/extracted/usr/share/doc/tandem/copyright
grep -q 'three.js authors' "$copyright" || fail "the license of three.js is missing"
grep -q 'common-licenses/GPL-3' "$copyright" || fail "the license is missing"
dpkg-deb --field "$folder/tandem.deb" Depends | grep -q 'libc6' || fail "the libraries of the program are not named"

mkdir "$folder/project"
cat > "$folder/project/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.16)
project(use_of_package LANGUAGES CXX)
find_package(Tandem REQUIRED COMPONENTS engine models)
if(NOT TARGET Tandem::tandem_engine OR NOT TARGET Tandem::tandem_models OR NOT Tandem_DIR MATCHES "/extracted/usr/lib")
  message(FATAL_ERROR "Tandem_DIR is ${Tandem_DIR}")
endif()
END
cmake -S "$folder/project" -B "$folder/project/build" "-DCMAKE_PREFIX_PATH=$folder/extracted/usr" > "$folder/log" 2>&1 ||
  { cat "$folder/log" >&2; fail "CMake does not find the library of the package"; }

if [ "$(id -u)" -ne 0 ] || ! command -v mmdebstrap > /dev/null; then
  echo "not installed in a clean root, which needs mmdebstrap and root"
  exit 0
fi
cat > "$folder/use.sh" << 'END'
set -eux
export DEBIAN_FRONTEND=noninteractive
apt-get install -y --no-install-recommends /tandem.deb
detect_planes --version
awk 'BEGIN { for(i = 0; i < 30; ++i) for(j = 0; j < 30; ++j) for(k = 0; k < 2; ++k) {
               print i, j, 29 * k; print i, 29 * k, j; print 29 * k, i, j } }' > /cube.xyz
detect_planes /cube.xyz --maximum-distance 0.3 --planes /planes.txt
[ "$(wc -l < /planes.txt)" -eq 6 ]
dpkg -L tandem > /files
apt-get remove -y tandem
while read -r file; do
  [ -d "$file" ] || [ ! -e "$file" ] || { echo "left: $file"; exit 1; }
done < /files
END
# shellcheck source=/dev/null
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
# shellcheck disable=SC2016
mmdebstrap --variant=apt --format=null --customize-hook=": > '$folder/begun'" \
  --customize-hook="upload '$folder/tandem.deb' /tandem.deb" \
  --customize-hook="upload '$folder/use.sh' /use.sh" --customize-hook='chroot "$1" sh /use.sh' \
  "$suite" /dev/null > "$folder/log" 2>&1 || {
  cat "$folder/log" >&2
  [ ! -f "$folder/begun" ] || fail "the package cannot be used in a clean root"
  echo "not installed in a clean root, which mmdebstrap cannot make here"
  exit 0
}
echo "installed, used and removed in a clean root of $suite"
