// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of the statistics as dictionaries of Python.

#ifndef TANDEM_PYTHON_DICTIONARIES_H
#define TANDEM_PYTHON_DICTIONARIES_H

#include <CGAL/Tandem/Statistics.h>

#include <pybind11/pybind11.h>

namespace tandem_python {

namespace py = pybind11;

inline py::dict times(const CGAL::Tandem::Stage_times& t)
{
  using namespace py::literals;
  return py::dict("normals"_a = t.normals, "sort"_a = t.sort, "neighbors"_a = t.neighbors, "growth"_a = t.growth,
                  "regularity"_a = t.regularity, "finish"_a = t.finish, "total"_a = t.total);
}

inline py::dict score(const CGAL::Tandem::Result_score& s)
{
  using namespace py::literals;
  return py::dict("fit"_a = s.fit, "links"_a = s.links, "size"_a = s.size, "price"_a = s.price, "freedom"_a = s.freedom,
                  "total"_a = s.total());
}

inline py::dict free_points(const CGAL::Tandem::Free_points& f)
{
  using namespace py::literals;
  return py::dict("without_normal"_a = f.without_normal, "misfit"_a = f.misfit,
                  "without_neighbors"_a = f.without_neighbors, "in_small_regions"_a = f.in_small_regions,
                  "clutter"_a = f.clutter, "unselected"_a = f.unselected, "total"_a = f.total());
}

} // namespace tandem_python

#endif // TANDEM_PYTHON_DICTIONARIES_H
