// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// For tests that corrupt a result.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHANGE_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHANGE_TABLE_H

#include <CGAL/Tandem/Shared_table.h>

#include <utility>
#include <vector>

// change(std::vector<T>&): results share the table, so it is changed in a copy.
template <class T, class Change>
void change_table(CGAL::Tandem::Shared_table<T>& table, Change change)
{
  std::vector<T> values(table.begin(), table.end());
  change(values);
  table = std::move(values);
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHANGE_TABLE_H
