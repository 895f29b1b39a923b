// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What becomes of a pair of shapes, by both steps of the test.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_VERDICT_OF_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_VERDICT_OF_H

#include <CGAL/Tandem/internal/rounds/Mutual_unions.h>

#include <cstdint>

inline CGAL::Tandem::internal::Verdict verdict_of(const CGAL::Tandem::internal::Union_gain& gain,
                                                  const CGAL::Tandem::internal::Sampled_shape& a,
                                                  const CGAL::Tandem::internal::Sampled_shape& b, std::uint32_t links)
{
  return gain.may_gain(a.fitted, b.fitted, links) ? gain.near_verdict(a, b, links) : CGAL::Tandem::internal::Verdict();
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_VERDICT_OF_H
