#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Fails when a header of the engine includes one of a later folder of the table in CONTRIBUTING.md, when its folder is not
# there, when one of the detector includes one of the models, when the program or the Python module includes what is not
# public, or when a chain of includes within the package is longer than 15 files.

set -eu

longest=15
if grep -rn '#include <CGAL/\(Tandem\|Shape_regularization_tandem\)/\(internal\|models\)/\|Tandem::internal::' \
  "$(dirname "$0")/../examples"; then
  echo "examples use what is not public"
  exit 1
fi

cd "$(dirname "$0")/../include"
order=$(sed -n 's/^| `\([a-z/]*\)` | .*/\1/p' ../CONTRIBUTING.md | sed -n '/^base\/tuning$/,$p' | tr '\n' ' ')
find CGAL -name '*.h' -o -name '*.cpp' -o -name '*.cuh' -o -name '*.cu' | sort | xargs grep -H '^#include <CGAL/\(Tandem\|Shape_reg\)' |
  sed 's/:#include </ /; s/>.*//' | awk -v order="$order" -v longest="$longest" \
    -v models='tandem(/models/|_models[.]h$)|/(lines|polygons|closed_surface|shape_facts)[.]h$' '
    # The plain data of both sides, in CGAL/Tandem, are below the engine, the public functions above it, the models above
    # these.
    function rank(file, folder) {
      if(file ~ models)
        return folders + 2
      if(file ~ /^CGAL\/Tandem\/[^\/]*$/)
        return 0
      folder = file
      if(!sub(/^CGAL\/Tandem\/internal\//, "", folder))
        return folders + 1
      sub(/\/[^\/]*$/, "", folder)
      if(!(folder in place)) {
        print file ": its folder is not in the table of CONTRIBUTING.md"
        failed = 1
      }
      return place[folder]
    }

    # The number of files in the longest chain that begins with the file.
    function depth(file, i, below, deepest) {
      if(file in known)
        return known[file]
      known[file] = 1
      for(i = 1; i <= includes[file]; ++i) {
        below = depth(included[file, i])
        if(below > deepest)
          deepest = below
      }
      return known[file] = deepest + 1
    }

    BEGIN { folders = split(order, names, / /); for(i = 1; i <= folders; ++i) place[names[i]] = i }

    {
      included[$1, ++includes[$1]] = $2
      if(rank($2) > rank($1)) {
        print $1 " includes " $2 ", which is in a later folder"
        failed = 1
      }
    }

    END {
      for(file in includes)
        if(depth(file) > most) {
          most = depth(file)
          deepest = file
        }
      printf "the longest chain of includes has %d files, from %s on\n", most, deepest
      if(most > longest)
        failed = 1
      exit failed
    }'
