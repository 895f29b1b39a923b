#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Fails when a header of the engine includes one of a later folder, or when a chain of includes within the package is
# longer than 14 files. The folders in their order:

set -eu

order='base score memory backend cloud neighbors regularity shapes growth rounds finish engine
  cuda/interface cuda/runtime cuda/execution cuda/neighbors cuda/stages cuda mpi'
longest=14

cd "$(dirname "$0")/../include"
find CGAL -name '*.h' -o -name '*.cuh' -o -name '*.cu' | sort | xargs grep -H '^#include <CGAL/\(Tandem\|Shape_reg\)' |
  sed 's/:#include </ /; s/>.*//' | awk -v order="$order" -v longest="$longest" '
    # The plain structs of the interface are below the engine, the other public headers above it.
    function rank(file, folder) {
      if(file ~ /^CGAL\/Shape_regularization_tandem\/(Parameters|Plane_relations|Statistics|detection_stage)\.h$/)
        return 0
      folder = file
      if(!sub(/^CGAL\/Tandem\/internal\//, "", folder))
        return folders + 1
      sub(/\/[^\/]*$/, "", folder)
      if(!(folder in place)) {
        print file ": its folder is not in the order of scripts/check_includes.sh"
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

    BEGIN { folders = split(order, names, /[ \n]+/); for(i = 1; i <= folders; ++i) place[names[i]] = i }

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
