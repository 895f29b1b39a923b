// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "test_support.h"

#include <CGAL/Shape_regularization_tandem/is_valid_result.h>

void check_valid(const Cloud& cloud, const Shapes& shapes, const std::string& name, Given given)
{
  const auto list = CGAL::Tandem::parameters::point_map(First<Kernel>());
  std::string why;
  const bool is_valid = given == Given::normals
                          ? CGAL::Tandem::is_valid_result(cloud, shapes, list.normal_map(Second<Kernel>()), &why)
                          : CGAL::Tandem::is_valid_result(cloud, shapes, list, &why);
  CHECK_AT(is_valid, name + ": " + why);
}

template Shapes detect<CGAL::Sequential_tag>(const Cloud&, const Parameters&, Given);
#ifdef CGAL_LINKED_WITH_TBB
template Shapes detect<CGAL::Parallel_tag>(const Cloud&, const Parameters&, Given);
#endif
