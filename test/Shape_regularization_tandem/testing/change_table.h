// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// For tests that corrupt a result.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHANGE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHANGE_TABLE_H

#include <CGAL/Tandem/internal/finish/export_shapes.h>

#include <algorithm>
#include <vector>

// change(std::vector<T>&): results share the table, so it is changed in a copy.
template <class T, class Change>
void change_table(CGAL::Tandem::internal::Shared_table<T>& table, Change change)
{
  std::vector<T> values(table.begin(), table.end());
  change(values);
  CGAL::Tandem::internal::Host_buffer<T> changed(values.size());
  std::copy(values.begin(), values.end(), changed.begin());
  table = std::move(changed);
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHANGE_TABLE_H
