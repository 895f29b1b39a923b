#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The lines of the README and of the manual that call CMake build what they are for and nothing else. They configure;
# what make would do then is listed only. Each folder that is known here has to have such lines.
#   test_build_lines.sh FOLDER   FOLDER: is made anew

set -eu

root=$(cd "$(dirname "$0")/../../.." && pwd)
folder=${1:?"test_build_lines.sh: which folder?"}
manual=$root/doc/Shape_regularization_tandem
failures=0

complain() { echo "test_build_lines.sh: $*" >&2; failures=1; }

# The target that a build folder has to have, and a regular expression of the others.
targets_of()
{
  case $1 in
    library) echo 'tandem_engine|tandem_models' ;;
    module) echo 'tandem_python|tandem_engine|tandem_models' ;;
    deb) echo 'detect_planes|detect_planes_[a-z]*|tandem_engine|tandem_models' ;;
    *) return 1 ;;
  esac
}

# check FILE NAME: the lines of that file for the folder build/NAME
check()
{
  file=$1; name=$2
  configure=$(sed -n "s|^cmake -S \. -B build/$name ||p" "$file")
  build=$(sed -n "s|^cmake --build build/$name *\([^&]*\)&.*|\1|p" "$file")
  rm -rf "$folder"
  mkdir -p "$folder"
  # Precompiled headers cannot be listed without being made.
  # shellcheck disable=SC2086
  cmake -G 'Unix Makefiles' -S "$root" -B "$folder" $configure -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    -DPython3_EXECUTABLE=/usr/bin/python3 > "$folder/log" 2>&1 || { cat "$folder/log" >&2; complain "$name is not configured"; return; }
  # shellcheck disable=SC2086
  cmake --build "$folder" $build -- --dry-run --keep-going > "$folder/log" 2>&1 || true
  sed -n 's|.*CMakeFiles/\([a-z_0-9]*\)\.dir/[^ ]*\.o.*|\1|p' "$folder/log" | sort -u > "$folder/targets"
  ! grep -Evx "$(targets_of "$name")" "$folder/targets" >&2 || complain "$file: build/$name builds these targets, too"
  grep -qx "$(targets_of "$name" | sed 's/|.*//')" "$folder/targets" || complain "$file: build/$name does not build what it is for"
}

checked=
for file in "$root/README.md" "$manual/Installation.txt" "$manual/Python.txt"; do
  for name in $(sed -n 's|^cmake -S \. -B build/\([a-z]*\) .*|\1|p' "$file"); do
    targets_of "$name" > /dev/null || { complain "$file: build/$name is not known here"; continue; }
    check "$file" "$name"
    checked="$checked $name"
  done
done
for name in library module deb; do
  case " $checked " in *" $name "*) ;; *) complain "there are no lines for build/$name" ;; esac
done
exit $failures
