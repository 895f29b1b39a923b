// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables of named columns, the criteria as their cells, and CSV files of them: rows may have different columns; the file
// has them all, in the order of their first appearance, empty where a row has none.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_TABLE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_TABLE_H

#include "testing/evaluate_truth.h"

#include <fstream>
#include <iomanip>
#include <sstream>

namespace CGAL::Tandem::benchmark {

// (column, value) in the order of the columns. Names are words joined by "_"; an empty value is not known.
using Row = std::vector<std::pair<std::string, std::string>>;

template <class T>
void append_cell(Row& row, const std::string& name, const T& value)
{
  std::ostringstream text;
  text << std::boolalpha << std::setprecision(6) << value;
  row.emplace_back(name, text.str());
}

// What says nothing where there is nothing, and would look perfect, is empty there.
template <class T>
void append_cell_if(Row& row, bool is_known, const std::string& name, const T& value)
{
  if(is_known)
    append_cell(row, name, value);
  else
    row.emplace_back(name, "");
}

inline void append_criteria(Row& row, const Criteria& c)
{
  append_cell(row, "shapes", c.shapes);
  append_cell(row, "coverage", c.coverage());
  append_cell_if(row, c.assigned > 0, "mean_distance_in_epsilons", c.mean_distance_in_epsilons);
  append_cell_if(row, c.assigned > 0, "max_distance_in_epsilons", c.max_distance_in_epsilons);
  append_cell(row, "beyond_epsilon", c.beyond_epsilon);
  append_cell(row, "beyond_alpha", c.beyond_alpha);
  append_cell(row, "beyond_either", c.beyond_either);
  append_cell(row, "directions_relaxed", c.relations.directions);
  append_cell(row, "planes_relaxed", c.relations.planes);
  append_cell(row, "degrees_of_freedom_relaxed", c.relations.degrees_of_freedom);
  append_cell_if(row, c.relations.planes > 0, "complexity_relaxed", c.relations.complexity);
}

inline void append_curves(Row& row, const Curves& curves)
{
  for(std::size_t n : {10, 30, 100}) {
    append_cell(row, "top_" + std::to_string(n) + "_shapes", curves.shapes.top(n));
    append_cell(row, "top_" + std::to_string(n) + "_planes", curves.planes.top(n));
  }
  for(const Needed_freedom& needed : curves.needed)
    append_cell_if(row, needed.degrees_of_freedom > 0,
                   "degrees_of_freedom_for_" + std::to_string(int(100 * needed.coverage + .5)),
                   needed.degrees_of_freedom);
}

// Empty where the truth is not known, so that all rows have the same columns.
inline void append_truth(Row& row, bool is_known, const Truth_criteria& t)
{
  append_cell_if(row, is_known, "true_faces", t.faces);
  append_cell_if(row, is_known, "top_10_faces", t.top_10_faces);
  append_cell_if(row, is_known, "point_precision", t.point_precision);
  append_cell_if(row, is_known, "face_f1_50", t.face_f1);
  append_cell_if(row, t.shapes_matched > 0, "angle_error_deg", t.angle_error_deg);
  append_cell_if(row, t.pairs > 0, "parallel_false_relaxed", t.false_parallels);
}

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

// Without what would end a cell.
inline std::string csv_cell(std::string text)
{
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

inline void write_csv(const std::string& path, const std::vector<Row>& rows)
{
  std::vector<std::string> columns = columns_of(rows);
  std::ofstream out(path);
  for(std::size_t c = 0; c < columns.size(); ++c)
    out << (c == 0 ? "" : ",") << csv_cell(columns[c]);
  out << "\n";
  for(const Row& row : rows) {
    for(std::size_t c = 0; c < columns.size(); ++c)
      out << (c == 0 ? "" : ",") << csv_cell(cell(row, columns[c]));
    out << "\n";
  }
  out.close();
  if(!out)
    throw std::runtime_error(path + ": cannot be written");
}

inline std::vector<std::string> split_csv_line(std::istringstream line)
{
  std::vector<std::string> cells;
  for(std::string cell; std::getline(line, cell, ',');)
    cells.push_back(cell);
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
    std::vector<std::string> cells = split_csv_line(std::istringstream(line));
    if(columns.empty()) {
      columns = cells;
      continue;
    }
    cells.resize(columns.size()); // the last one may be empty
    Row row;
    for(std::size_t c = 0; c < columns.size(); ++c)
      row.emplace_back(columns[c], cells[c]);
    rows.push_back(row);
  }
  return rows;
}

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_TABLE_H
