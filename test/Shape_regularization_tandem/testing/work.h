// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The work of a detection beside that of another one, and beside bounds.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WORK_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WORK_H

#include "checks.h"

#include <CGAL/Tandem/Statistics.h>

#include <string>

// The numbers that do not depend on the back end.
inline void check_same_loops(const CGAL::Tandem::Work& a, const CGAL::Tandem::Work& b, const std::string& name)
{
  check_equal(a.passes_over_points, b.passes_over_points, name + ": passes over points");
  check_equal(a.passes_over_lists, b.passes_over_lists, name + ": passes over lists");
  check_equal(a.loops_over_shapes, b.loops_over_shapes, name + ": loops over shapes");
}

// All numbers, of back ends of the host.
inline void check_same_work(const CGAL::Tandem::Stage_work& a, const CGAL::Tandem::Stage_work& b,
                            const std::string& name)
{
  const auto check = [](const CGAL::Tandem::Work& x, const CGAL::Tandem::Work& y, const std::string& stage) {
    check_same_loops(x, y, stage);
    check_equal(x.launches, y.launches, stage + ": launches");
    check_equal(x.waits, std::size_t(0), stage + ": waits");
    check_equal(x.bytes_copied, std::size_t(0), stage + ": bytes");
  };
  check(a.prepare, b.prepare, name + ", preparation");
  check(a.rounds, b.rounds, name + ", rounds");
  check(a.finish, b.finish, name + ", end");
}

inline void check_at_most(double value, double most, const std::string& what)
{
  CHECK_AT(value <= most, what + ": " + std::to_string(value) + " instead of at most " + std::to_string(most));
}

// The work of each of so many rounds, say, is not more than that.
inline void check_bounded(const CGAL::Tandem::Work& found, double times, const CGAL::Tandem::Work& most,
                          const std::string& name)
{
  const auto& [points, lists, shapes, launches, waits, bytes] = found;
  check_at_most(points / times, most.passes_over_points, name + ": passes over points");
  check_at_most(lists / times, most.passes_over_lists, name + ": passes over lists");
  check_at_most(double(shapes) / times, double(most.loops_over_shapes), name + ": loops over shapes");
  check_at_most(double(launches) / times, double(most.launches), name + ": launches");
  check_at_most(double(waits) / times, double(most.waits), name + ": waits");
  check_at_most(double(bytes) / times, double(most.bytes_copied), name + ": bytes");
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WORK_H
