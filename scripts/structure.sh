#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Measures how a checkout is built: lines by folder, and what a reader has to know beside the stages themselves. Two
# outputs can be compared with diff.
#   structure.sh [FOLDER]   the checkout (default: this one)

set -eu

cd "${1:-$(dirname "$0")/..}"
engine=include/CGAL/Tandem/internal
public=include/CGAL/Shape_regularization_tandem

# The source files below the folders.
sources()
{
  find "$@" -type f \( -name '*.h' -o -name '*.cuh' -o -name '*.cu' -o -name '*.cpp' -o -name '*.py' -o -name '*.sh' \
    -o -name '*.cmake' -o -name CMakeLists.txt -o -name '*.html' -o -name '*.js' -o -name '*.css' \)
}

row() { printf '%-80s %7s %7s\n' "$1" "$2" "${3:-}"; }

# Lines and files of a folder, as a row.
size()
{
  row "$1" "$(sources "$1" | xargs cat | wc -l)" "$(sources "$1" | wc -l)"
}

# The lines that match, in headers and sources below the folders; comments do not count.
code() { pattern=$1; shift; sources "$@" | xargs grep -hE "$pattern" | grep -vE '^ *(//|#[^a-z]*include)' || true; }

# How many different words match.
words() { pattern=$1; shift; code "$pattern" "$@" | grep -oE "$pattern" | sort -u | wc -l; }

program=examples/detect_planes
[ -d $program ] || program=examples/Shape_regularization_tandem/program

row "Lines and files of" lines files
# shellcheck disable=SC2231
for folder in include $public $engine $engine/*/ examples $program examples/*/ test/*/ benchmark scripts; do
  case $folder in *.*) continue ;; esac
  size "${folder%/}"
done | sort -u

echo
row "Measure" number
row "classes of engines" "$(words '^(class|struct) ([A-Za-z_]+_)?[Ee]ngine( final)?( :| \{|$)' include)"
row "operations in the list of concepts.h" \
  "$(grep -oE '^// {1,3}[a-z_]+[(<][^ ]*|^// {1,3}[a-z_]+(, [a-z_]+)+' $engine/backend/concepts.h | tr ',' '\n' | wc -l)"
row "members of Ranks that the engine calls" \
  "$(sources $engine | grep -v '/mpi/\|/backend/' | xargs grep -hoE '\branks_?(\(\))?\.(template )?[a-z_]+|Ranks<Backend>(::|\([^)]*\)\.)[a-z_]+' |
    grep -oE '[a-z_]+$' | sort -u | wc -l)"
row "lines with internal:: in public headers" \
  "$(find $public -maxdepth 1 -name '*.h' -exec cat {} + | grep -vE '^ *//' | grep -c 'internal::')"
for folder in $program examples/python examples/*/python test/*/api test/*/program test/*/python; do
  [ ! -d "$folder" ] || row "lines with internal:: in $folder" "$(code 'internal::' "$folder" | wc -l)"
done
row "conditions of the preprocessor in include, no include guards" \
  "$(code '^ *# *(if|elif)' include | grep -cvE 'ifndef CGAL_[A-Z_0-9]+_(H|CUH)$')"
row "conditions of the preprocessor in $program" \
  "$(code '^ *# *(if|elif)' $program | grep -cvE 'ifndef [A-Z_0-9]+_H$')"
row "functions that take the cloud and the shapes whole" \
  "$(sources $engine | xargs grep -zoP '\n[^\n/]*\w\([^(){};]*Labeled_cloud<Backend>& \w+,[^(){};]*Shape_table<Backend>& \w+[^(){};]*\)( const)?\s*[{:]' |
    tr -d '\0' | grep -c 'Labeled_cloud')"
row "tuning constants" \
  "$(grep -rh '^constexpr' $engine/base/Tuning.h $engine/base/tuning 2> /dev/null | wc -l)"
# shellcheck disable=SC2016
for page in Method Algorithm Parameters; do
  row "numbers of the method written by hand in $page.txt" \
    "$(sed -E 's/<sup>[^<]*<\/sup>|`[^`]*`|\\[A-Za-z_0-9{}.]+|\(c\) 2026|GPL-3.0//g' \
      doc/Shape_regularization_tandem/$page.txt | grep -oE '(^|[ (.<>-])[0-9][0-9.,/]*( %)?' | wc -l)"
done
