// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points exactly at 0 0 0, which invalid pixels of depth cameras become.

#ifndef DETECT_PLANES_ZEROS_H
#define DETECT_PLANES_ZEROS_H

#include "input/point_set.h"
#include "ranks/Ranks.h"

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace program {

inline bool is_zero(const Kernel::Point_3& p) { return p.x() == 0 && p.y() == 0 && p.z() == 0; }

// While they are hidden, these points have no finite coordinates, so that nothing depends on them.
class Hidden_zeros {
public:
  Hidden_zeros(bool are_hidden, Point_set& cloud, Ranks& ranks) : points(cloud)
  {
    if(!are_hidden)
      return;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::size_t others = 0;
    for(Point_set::Index i : points)
      if(is_zero(points.point(i)))
        hidden.push_back(i);
      else
        ++others;
    for(Point_set::Index i : hidden)
      points.point(i) = Kernel::Point_3(nan, nan, nan);
    number_of_all_ = ranks.sums({(long long)(hidden.size())})[0];
    const bool is_any = ranks.largest(double(others)) > 0;
    ranks.together([&] {
      if(!is_any)
        throw std::runtime_error("all points are at 0 0 0, which --ignore-zeros leaves out");
    });
  }

  // Of all ranks.
  std::size_t number_of_all() const { return std::size_t(number_of_all_); }

  // The coordinates are those of the input again.
  void show()
  {
    for(Point_set::Index i : hidden)
      points.point(i) = Kernel::Point_3(0, 0, 0);
    hidden.clear();
  }

private:
  Point_set& points;
  std::vector<Point_set::Index> hidden;
  long long number_of_all_ = 0;
};

} // namespace program

#endif // DETECT_PLANES_ZEROS_H
