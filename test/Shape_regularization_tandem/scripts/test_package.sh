#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes the Debian package of a build folder and looks at what is in it. As root, where mmdebstrap is installed, apt also
# installs it in a clean root, where the program finds the planes of a cube, and removes it without a trace; this loads
# some 100 MB.
#   test_package.sh BUILD FOLDER   FOLDER: is made anew

set -eu

[ $# -eq 2 ] || { echo "usage: test_package.sh BUILD FOLDER" >&2; exit 1; }
build=$1

fail() { echo "test_package.sh: $*" >&2; exit 1; }

# logged WHAT COMMAND...: fails with its output and WHAT
logged() { what=$1; shift; "$@" > "$folder/log" 2>&1 || { cat "$folder/log" >&2; fail "$what"; }; }

rm -rf "$2"
mkdir -p "$2"
folder=$(cd "$2" && pwd)
logged "cpack failed" env -C "$build" cpack -G DEB -B "$folder/cpack"
mv "$folder"/cpack/tandem_*.deb "$folder/tandem.deb" || fail "there is no package"
dpkg-deb --contents "$folder/tandem.deb" | sed 's/.* \.\//\//' > "$folder/files"
dpkg-deb --extract "$folder/tandem.deb" "$folder/extracted"

for file in bin/detect_planes include/CGAL/Shape_regularization_tandem.h 'lib/.*cmake/Tandem/TandemConfig.cmake' \
  'lib/.*libtandem_engine\.[a-z.0-9]*' 'lib/.*libtandem_models\.[a-z.0-9]*' share/bash-completion/completions/detect_planes; do
  grep -q "^/usr/$file\$" "$folder/files" || fail "the package has no $file"
done
! grep -Ev '^/usr/(bin|include|lib|share)/|^/(usr/)?((bin|include|lib|share)/)?$' "$folder/files" || fail "files are elsewhere"
! grep -i python "$folder/files" || fail "it has a part of the Python module"
for text in 'three.js authors' 'common-licenses/GPL-3'; do
  grep -q "$text" "$folder/extracted/usr/share/doc/tandem/copyright" || fail "the license has no $text"
done
dpkg-deb --field "$folder/tandem.deb" Depends | grep -q 'libc6' || fail "the libraries of the program are not named"

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
