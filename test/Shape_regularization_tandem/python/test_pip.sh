#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# pip installs the package from a copy of the sources, with the compiled part of a build folder, makes a wheel, and removes
# it; and the build says in one message what is missing.
#   test_pip.sh PYTHON BUILD FOLDER   FOLDER: is made anew

set -eu

root=$(cd "$(dirname "$0")/../../.." && pwd)
python=$1; build=$2; folder=$3

fail() { echo "test_pip.sh: $*" >&2; [ ! -f "$folder/log" ] || cat "$folder/log" >&2; exit 1; }

"$python" -c 'import ensurepip, setuptools, venv, wheel' 2> /dev/null || {
  echo "-- skipped: $python lacks venv, setuptools or wheel"; exit 77; }

rm -rf "$folder"
mkdir -p "$folder/sources/include/CGAL/Shape_regularization_tandem" "$folder/sources/examples/python" "$folder/empty"
cp "$root/setup.py" "$root/pyproject.toml" "$root/MANIFEST.in" "$root/README.md" "$root/LICENSE" "$folder/sources"
cp "$root/include/CGAL/Shape_regularization_tandem/version.h" "$folder/sources/include/CGAL/Shape_regularization_tandem"
cp -R "$root/examples/python/package" "$folder/sources/examples/python"
"$python" -m venv --system-site-packages "$folder/venv"
python=$folder/venv/bin/python
unset PYTHONPATH

export TANDEM_PYTHON_BUILD="$build"
"$python" -m pip install --no-index --no-build-isolation "$folder/sources" > "$folder/log" 2>&1 || fail "pip install fails"
cd "$folder/empty"
"$python" -c "import tandem, sys
assert tandem.__file__.startswith(sys.argv[1]), tandem.__file__
assert len(tandem.detect_planes([[x, y, 0] for x in range(20) for y in range(20)])) == 1" "$folder/venv" ||
  fail "the installed package cannot be used"
"$python" -m pip uninstall --yes tandem > "$folder/log" 2>&1 || fail "pip uninstall fails"
! "$python" -c 'import tandem' 2> /dev/null || fail "something is left of the package"

"$python" -m pip wheel --no-index --no-build-isolation --no-deps --wheel-dir "$folder/wheels" "$folder/sources" \
  > "$folder/log" 2>&1 || fail "pip wheel fails"
"$python" -m zipfile --list "$folder"/wheels/tandem-*linux*.whl > "$folder/log" || fail "there is no wheel"
for file in __init__.py _arguments.py _selection.py _tandem.pyi py.typed '_tandem\..*so'; do
  grep -q "^tandem/$file " "$folder/log" || fail "the wheel has no $file"
done

# No program is found.
unset TANDEM_PYTHON_BUILD
cd "$folder/sources"
! PATH=$folder/empty "$python" setup.py build_ext > "$folder/log" 2>&1 || fail "it is built without cmake"
grep -q '^tandem cannot be built, these are missing: cmake, make or ninja, a C++ compiler' "$folder/log" ||
  fail "what is missing is not said"
grep -q 'sudo apt install cmake make g++' "$folder/log" || fail "the packages are not named"
