#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Prints how large a checkout is: lines of code, neither blank nor comment, and files of each of its houses; headers that
# one other header or source of include needs; and tuning constants. What git does not track does not count, where there is
# git. The notes of a change of the structure compare two of these tables.
#   structure.sh [FOLDER]   the checkout (default: this one)

set -eu

cd "${1:-$(dirname "$0")/..}"
{ git ls-files 2> /dev/null || find . -type f ! -path './build/*' | cut -c3-; } |
  grep -E '(\.(h|cuh|cu|cpp|py|sh|cmake|html|js|css)|CMakeLists\.txt)$' | grep -vE 'corpus/|expected' | awk '
    BEGIN {
      count = split(";include;include/CGAL/Tandem;include/CGAL/Shape_regularization_tandem/models;" \
        "include/public headers;test;benchmark;scripts;examples/detect_planes;examples/python;" \
        "examples/Shape_regularization_tandem;doc;cmake", folder, ";")
    }
    {
      code = 0
      while((getline line < $0) > 0) {
        code += line !~ /^[ \t]*($|\/\/|#( |$|!)|\*|\/\*|<!--)/
        constants += /\/base\/tuning\// && line ~ /^constexpr/
        if(/^include/ && sub(/^#include <CGAL\//, "", line) && line ~ /^(Tandem|Shape_regularization_tandem)/)
          ++includers[line]
      }
      close($0)
      if(/^include/ && !/^include\/CGAL\/(Tandem|Shape_regularization_tandem\/models)\//)
        sub(/CGAL/, "public headers")
      for(i = 1; i <= count; ++i)
        if(index("/" $0, "/" folder[i]) == 1) {
          lines[i] += code
          ++files[i]
        }
    }
    END {
      printf "%-52s %7s %7s\n", "", "lines", "files"
      for(i = 1; i <= count; ++i)
        printf "%-52s %7d %7d\n", i == 1 ? "whole repository" : folder[i], lines[i], files[i]
      for(header in includers)
        single += includers[header] == 1
      printf "%-60s %7d\n%-52s %7d\n", "headers in include with one includer there", single, "tuning constants", constants
    }'
