#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what the tests of clicks on the page of detect_planes --view drive Chromium with: playwright-core, from npm.
# Nothing is done if it is there.
#   install_playwright.sh FOLDER    becomes FOLDER/node_modules/playwright-core

set -eu

fail() { echo "install_playwright.sh: $*" >&2; exit 1; }

[ $# -eq 1 ] || fail "needs a folder"
[ ! -r "$1/node_modules/playwright-core/package.json" ] || exit 0
command -v npm > /dev/null || fail "there is no npm (Debian: npm)"
mkdir -p "$1"
npm install --no-save --no-audit --no-fund --ignore-scripts --prefix "$1" playwright-core@1.65.1 > "$1/npm.log" 2>&1 ||
  { cat "$1/npm.log" >&2; fail "npm cannot install playwright-core"; }
