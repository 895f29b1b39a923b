// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables as CSV files: rows may have different columns; the file has them all,
// in the order of their first appearance, empty where a row has none.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_CSV_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_CSV_H

#include "testing/evaluate_columns.h"

#include <fstream>

namespace CGAL {
namespace Tandem {
namespace benchmark {

// Empty, too, where there is no such column.
inline std::string cell(const Row& row, const std::string& column)
{
  auto found = std::find_if(row.begin(), row.end(), [&](const auto& c) { return c.first == column; });
  return found == row.end() ? std::string() : found->second;
}

inline std::vector<std::string> columns_of(const std::vector<Row>& rows)
{
  std::vector<std::string> columns;
  for(const Row& row : rows)
    for(const auto& c : row)
      if(std::find(columns.begin(), columns.end(), c.first) == columns.end())
        columns.push_back(c.first);
  return columns;
}

inline std::string csv_quoted(const std::string& text)
{
  if(text.find_first_of(",\"\n\r") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for(char c : text) {
    quoted += c == '\n' || c == '\r' ? ' ' : c;
    if(c == '"')
      quoted += '"';
  }
  quoted += '"';
  return quoted;
}

inline void write_csv(const std::string& path, const std::vector<Row>& rows)
{
  std::vector<std::string> columns = columns_of(rows);
  std::ofstream out(path);
  for(std::size_t c = 0; c < columns.size(); ++c)
    out << (c == 0 ? "" : ",") << csv_quoted(columns[c]);
  out << "\n";
  for(const Row& row : rows) {
    for(std::size_t c = 0; c < columns.size(); ++c)
      out << (c == 0 ? "" : ",") << csv_quoted(cell(row, columns[c]));
    out << "\n";
  }
  out.close();
  if(!out)
    throw std::runtime_error(path + ": cannot be written");
}

inline std::vector<std::string> split_csv_line(const std::string& line)
{
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for(std::size_t i = 0; i < line.size(); ++i) {
    char c = line[i];
    if(c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if(c == '"')
      is_quoted = !is_quoted;
    else if(c == ',' && !is_quoted)
      cells.emplace_back();
    else if(c != '\r')
      cells.back() += c;
  }
  return cells;
}

// Lines that begin with # are comments.
inline std::vector<Row> read_csv(const std::string& path)
{
  std::ifstream in(path);
  if(!in)
    throw std::runtime_error(path + ": cannot be opened");
  std::vector<Row> rows;
  std::vector<std::string> columns;
  std::string line;
  while(std::getline(in, line)) {
    if(line.empty() || line[0] == '#')
      continue;
    std::vector<std::string> cells = split_csv_line(line);
    if(columns.empty()) {
      columns = cells;
      continue;
    }
    if(cells.size() != columns.size())
      throw std::runtime_error(path + ": not as many cells as columns in: " + line);
    Row row;
    for(std::size_t c = 0; c < columns.size(); ++c)
      row.emplace_back(columns[c], cells[c]);
    rows.push_back(row);
  }
  return rows;
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_RESULTS_CSV_H
