// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What stands before the points of a text table, and what its columns are.

#ifndef DETECT_PLANES_TABLE_HEAD_H
#define DETECT_PLANES_TABLE_HEAD_H

#include "input/Table_rows.h"
#include "input/table_columns.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace program {

// What tells the columns: --columns, a line of names, or the values.
enum class Source { option, header, sample };

// What stands before the points, and the first of them.
struct Table_head {
  Source source = Source::sample;
  std::vector<Column> columns;    // empty: unknown
  std::vector<std::string> names; // of a line of names
  bool is_geographic = false, has_skipped_names = false;
  std::optional<std::size_t> count;
  std::vector<Text_row> rows;
};

// Says what is wrong with a row, and what may be wrong with its commas.
[[noreturn]] void fail_at(const Text_row& row, const std::string& reason);

// columns: those of --columns, or none.
Table_head read_head(Table_rows& table, const std::vector<Column>& columns);

// The rows that have as many values as the first one; the others are reported when they are read.
Sample sample_of(const std::vector<Text_row>& rows);

// Finds integers in pairs, as 1,5, 2,5. As many values as names are told what they are.
void check_pairs(const Table_head& head);

// What the columns of a table are.
struct Table_columns {
  std::vector<Column> columns;
  bool counts_rows = false; // the first one, which is passed over
};

// A column that counts the rows need not have a name. tolerance: the name of --tolerance-column, or empty.
Table_columns columns_of(const Table_head& head, const Sample& sample, const std::string& extension,
                         const std::string& tolerance);

} // namespace program

#endif // DETECT_PLANES_TABLE_HEAD_H
