#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Seconds and memory of the compiler for the example of README, header-only and with the library tandem_engine, and for a
# caller of outlines and a closed surface, with and without the library tandem_models, beside a file that only includes a
# kernel of CGAL.
#   compile_time.sh [COMPILER...]     (default: c++)
# TANDEM_SKIP_INSTALL=1 trusts that everything is installed.

set -eu

root=$(cd "$(dirname "$0")/.." && pwd)
[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" g++ libcgal-dev libtbb-dev time
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The first program of README.
awk '/^```/ && within { exit } within { print } /^```cpp/ { within = 1 }' "$root/README.md" > "$work/example.cpp"
printf '#include <CGAL/Simple_cartesian.h>\n#include <iostream>\n' > "$work/kernel.cpp"

cat > "$work/models.cpp" << 'END'
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Shape_regularization_tandem/closed_surface.h>
#include <CGAL/Shape_regularization_tandem/polygons.h>
using Kernel = CGAL::Simple_cartesian<double>;
std::size_t sizes(const CGAL::Tandem::Planar_shapes_3<Kernel>& shapes, const std::vector<Kernel::Point_3>& points)
{
  return CGAL::Tandem::polygons(shapes, points).points().size() +
         CGAL::Tandem::closed_surface(shapes, points).faces.size();
}
END

# measure COMPILER NAME SOURCE FLAGS...: prints a row
measure()
{
  compiler=$1; name=$2; source=$3; shift 3
  env time -f '%U %M' -o "$work/used" "$compiler" -std=c++17 -O3 -DNDEBUG -frounding-math -DCGAL_LINKED_WITH_TBB \
    "-I$root/include" "$@" -c "$work/$source.cpp" -o "$work/$source.o"
  awk -v name="$name" -v compiler="$compiler" \
    '{ printf "%-12s %-28s %5.1f s %5.2f GB\n", compiler, name, $1, $2 / 1048576 }' "$work/used"
}

[ $# -gt 0 ] || set -- c++
for compiler in "$@"; do
  measure "$compiler" 'a kernel of CGAL' kernel
  measure "$compiler" 'example, with the library' example -DCGAL_TANDEM_USE_ENGINE=1
  measure "$compiler" 'example, header-only' example
  measure "$compiler" 'models, with the libraries' models -DCGAL_TANDEM_USE_ENGINE=1 -DCGAL_TANDEM_USE_MODELS=1
  measure "$compiler" 'models, header-only' models
done
