// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small cloud on many ranks, of which one fails: in a property map or in the callback.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_FAILING_RANK_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_FAILING_RANK_H

#include "mpi_failure.h"

#include <functional>
#include <set>
#include <string>

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::Callback;

inline Dealt_case make_case()
{
  Parameters parameters = make_parameters(.01, 30);
  parameters.cell_size = 64;
  return {{"cube", to_cloud(scenes::make_scene("cube", scene_options(1200, .001, .1))), parameters, Given::normals},
          Deal::random};
}

inline std::set<int> first_and_last(const Ranks& ranks) { return {0, ranks.size() - 1}; }

// The ranks are as they were before.
inline void check_alive(const Ranks& ranks) { CHECK(sum_over(ranks, compare_with_one(ranks, {make_case()})) >= 6); }

template <class List>
auto detect_with(const Ranks& ranks, const Cloud& part, const List& list)
{
  return CGAL::Tandem::detect_planes<Mpi_tag<CGAL::Sequential_tag>>(
    part, list.point_map(First<Kernel>()).normal_map(Second<Kernel>()).communicator(ranks));
}

// On one rank it fails at one of the points.
struct Failing_map {
  using key_type = Cloud::value_type;
  using value_type = Kernel::Point_3;
  using reference = const value_type&;
  using category = boost::readable_property_map_tag;

  friend reference get(const Failing_map& map, const key_type& item)
  {
    if(&item == map.failing)
      map.fail();
    return item.first;
  }

  const key_type* failing;
  std::function<void()> fail;
};

template <class F>
std::string failure_with_callback(const Ranks& ranks, int calling, F callback)
{
  const Callback none, own = callback;
  const Cloud part = make_case().part(ranks);
  const auto list = np::settings(make_case().parameters).callback(ranks.rank() == calling ? own : none);
  return failure_of([&] { detect_with(ranks, part, list); });
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_FAILING_RANK_H
