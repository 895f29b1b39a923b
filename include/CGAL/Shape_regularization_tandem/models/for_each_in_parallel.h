// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FOR_EACH_IN_PARALLEL_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FOR_EACH_IN_PARALLEL_H

#include <CGAL/Shape_regularization_tandem/models/Model_progress.h>

#include <CGAL/for_each.h>
#include <boost/iterator/counting_iterator.hpp>

#include <cstddef>

namespace CGAL::Tandem::internal {

// f(0) to f(n - 1), in parallel where TBB is linked. It is the stage of the progress, or a part of it.
template <class Function>
void for_each_in_parallel(std::size_t n, const Model_progress& progress, Function f)
{
  using Index = boost::counting_iterator<std::size_t>;
  CGAL::for_each<CGAL::Parallel_if_available_tag>(CGAL::make_range(Index(0), Index(n)), [&](std::size_t i) {
    progress.check(double(i) / double(n));
    f(i);
    return true;
  });
}

template <class Function>
void for_each_in_parallel(std::size_t n, Function f)
{
  for_each_in_parallel(n, Model_progress(), f);
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_FOR_EACH_IN_PARALLEL_H
