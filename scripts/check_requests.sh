#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Proves that each request of a stage for what follows from labels is needed: without it, test_requests fails. A request
# is a table that a call of update_tables() names, or a call of states_of(). The test is compiled once, with a copy of the
# headers in which an environment variable drops a request.
#   CXX  the compiler (default: g++)
#   TANDEM_SKIP_INSTALL=1  trusts that everything is installed

set -eu

fail() { echo "check_requests.sh: $*" >&2; exit 1; }

root=$(cd "$(dirname "$0")/.." && pwd)
tests=$root/test/Shape_regularization_tandem
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
[ "${TANDEM_SKIP_INSTALL:-0}" = 1 ] || "$root/scripts/install_dependencies.sh" g++ libcgal-dev libeigen3-dev libboost-test-dev python3
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
python3 - << 'END'
import itertools, pathlib, re
numbers, requests = itertools.count(1), open("requests", "w")
for path in sorted(pathlib.Path("include/CGAL/Tandem/internal").rglob("*.*")):
    lines = path.read_text().split("\n")
    for i, line in enumerate(lines):
        def dropped(call):
            number = next(numbers)
            print(number, f"{path}:{i + 1}: {call[0]}", file=requests)
            return (f"::request({number}, {call[0]})" if call[0].startswith("tables::") else
                    f"(::request({number}, 1) != 0 ? {call[0]} : points.state())")
        tables = r"tables::[a-z]+|" if "update_tables(points" in line else ""
        lines[i] = re.sub(tables + r"states_of\(points, [^()]*\)", dropped, line)
    path.write_text("\n".join(lines))
END

${CXX:-g++} -std=c++17 -O1 -DBOOST_TEST_DYN_LINK -include request.h -Iinclude "-I$tests" -I/usr/include/eigen3 \
  "$tests/testing/main.cpp" "$tests/shapes/test_requests.cpp" "$tests"/scenes/*.cpp -lboost_unit_test_framework -lgmp \
  -lmpfr -lpthread -o test_requests ||
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
