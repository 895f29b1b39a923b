#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Proves that each request of a stage for what follows from labels is needed: without it, test_requests fails. A request
# is a table that a call of require() names, or a call of states_of(). The test is compiled once, with a copy of the
# headers in which an environment variable drops a request.
#   CXX  the compiler (default: g++)

set -eu

fail() { echo "check_requests.sh: $*" >&2; exit 1; }

root=$(cd "$(dirname "$0")/.." && pwd)
tests=$root/test/Shape_regularization_tandem
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r "$root/include" "$folder"
cd "$folder"

cat > request.h << 'END'
#include <cstdlib>

inline unsigned request(int number, unsigned table)
{
  const char* const dropped = std::getenv("DROPPED_REQUEST");
  return dropped != nullptr && std::atoi(dropped) == number ? 0 : table;
}
END
grep -rlE 'require\(points|states_of\(points' include/CGAL/Tandem/internal | sort > files
# shellcheck disable=SC2016
xargs awk '
  function note(what) { print ++number, FILENAME ":" FNR, what > "requests" }
  {
    line = ""
    while(match($0, /tables::[a-z]+/) && $0 line ~ /require\(points/) {
      note(substr($0, RSTART, RLENGTH))
      line = line substr($0, 1, RSTART - 1) "::request(" number ", " substr($0, RSTART, RLENGTH) ")"
      $0 = substr($0, RSTART + RLENGTH)
    }
    if(match($0, /states_of\(points, [^()]*\)/)) {
      note("states_of")
      call = substr($0, RSTART, RLENGTH)
      sub(/states_of\(points, [^()]*\)/, "(::request(" number ", 1) != 0 ? " call " : points.state())")
    }
    print line $0 > (FILENAME ".new")
  }' < files
while read -r file; do
  mv "$file.new" "$file"
done < files

${CXX:-g++} -std=c++17 -O1 -include request.h -Iinclude "-I$tests" -I/usr/include/eigen3 \
  "$tests/shapes/test_requests.cpp" "$tests"/scenes/*.cpp -lgmp -lmpfr -lpthread -o test_requests ||
  fail "the test does not compile"
./test_requests || fail "the test fails with all requests"
superfluous=0
while read -r number request; do
  if (DROPPED_REQUEST=$number ./test_requests || exit 1) > /dev/null 2>&1; then
    echo "not noticed: $request"
    superfluous=$((superfluous + 1))
  fi
done < requests
[ "$superfluous" = 0 ] || fail "$superfluous requests are not needed, or no test needs them"
echo "Each of $(wc -l < requests) requests is needed."
