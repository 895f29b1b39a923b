// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A direction on the command line: three numbers with commas between them.

#ifndef DETECT_PLANES_DIRECTION_OPTION_H
#define DETECT_PLANES_DIRECTION_OPTION_H

#include <array>
#include <istream>
#include <ostream>

namespace program {

struct Direction {
  std::array<double, 3> value;
};

// Boost reads and writes the values of options so.
inline std::istream& operator>>(std::istream& in, Direction& d)
{
  char first = 0, second = 0;
  in >> d.value[0] >> first >> d.value[1] >> second >> d.value[2];
  if(first != ',' || second != ',')
    in.setstate(std::ios::failbit);
  return in;
}

inline std::ostream& operator<<(std::ostream& out, const Direction& d)
{
  return out << d.value[0] << ',' << d.value[1] << ',' << d.value[2];
}

} // namespace program

#endif // DETECT_PLANES_DIRECTION_OPTION_H
