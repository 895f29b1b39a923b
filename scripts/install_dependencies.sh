#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the Debian packages named as arguments, or those that every build of Tandem
# needs; only what is missing, without questions, as root or through sudo.

set -eu

fail() { echo "install_dependencies.sh: $*" >&2; exit 1; }

[ $# -gt 0 ] ||
  set -- g++ make ninja-build cmake libcgal-dev libeigen3-dev libboost-program-options-dev libboost-test-dev libtbb-dev \
    nlohmann-json3-dev

command -v dpkg-query > /dev/null ||
  fail "this system has no dpkg; install the counterparts of these packages yourself: $*"
missing=
for package in "$@"; do
  dpkg-query -W -f '${Status}' "$package" 2> /dev/null | grep -q 'install ok installed' ||
    missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
[ "$(id -u)" -eq 0 ] || as_root=sudo
[ -z "$as_root" ] || command -v sudo > /dev/null || fail "missing:$missing; run as root or install sudo"
echo "Installing$missing"
# shellcheck disable=SC2086
install() { $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing; }
# The lists of packages may be absent or too old, so a failed first try is no error.
install > /dev/null 2>&1 || { $as_root apt-get update && install; } || fail "apt-get could not install$missing"
