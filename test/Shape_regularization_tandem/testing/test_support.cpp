// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "test_support.h"
#include "measured_violation.h"

std::string violation(const Cloud& cloud, const Shapes& shapes, Given given)
{
  const auto list = CGAL::Tandem::parameters::point_map(First<Kernel>());
  return given == Given::normals ? violation_of(cloud, shapes, list.normal_map(Second<Kernel>()))
                                 : violation_of(cloud, shapes, list);
}

void check_valid(const Cloud& cloud, const Shapes& shapes, const std::string& name, Given given)
{
  const std::string why = violation(cloud, shapes, given);
  CHECK_AT(why.empty(), name + ": " + why);
}

template Shapes detect<CGAL::Sequential_tag>(const Cloud&, const Parameters&, Given);
#ifdef CGAL_LINKED_WITH_TBB
template Shapes detect<CGAL::Parallel_tag>(const Cloud&, const Parameters&, Given);
#endif
