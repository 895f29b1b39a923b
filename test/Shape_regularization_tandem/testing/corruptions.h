// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wrong values for each field of a result that is_valid_result() looks at, in turn: all but statistics and uncertainties.
// A new field of one of the structs does not compile until it is named here.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CORRUPTIONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CORRUPTIONS_H

#include <CGAL/Tandem/internal/result/Shapes_data.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

// change(std::vector<T>&): results share the table, so it is changed in a copy.
template <class T, class Change>
void change_table(CGAL::Tandem::internal::Shared_table<T>& table, Change change)
{
  std::vector<T> values(table.begin(), table.end());
  change(values);
  table = std::move(values);
}

// Numbers all corruptions, and makes one of them: that of the number `target`.
class Corruption {
public:
  using Data = CGAL::Tandem::internal::Shapes_data;

  Corruption(Data& data, std::size_t target) : target_(target)
  {
    [[maybe_unused]] auto& [coefficients, size, parallel, coplanar, orthogonal, fixed, symmetry, flipped, uncertainty,
                            shape_of, normal, parameters, statistics, points] = data;
    visit_all({"coefficients", "size", "parallel_group", "coplanar_group", "orthogonal_groups", "fixed_direction",
               "symmetry_group", "is_flipped", "shape_of", "normal"},
              coefficients, size, parallel, coplanar, orthogonal, fixed, symmetry, flipped, shape_of, normal);
    visit_parameters(parameters);
    visit_all({"points.first", "points.position"}, points.first, points.position);
  }

  // Whether there is one of that number.
  bool is_made() const { return !field_.empty(); }
  const std::string& field() const { return field_; }
  // The field, and how it was changed.
  const std::string& name() const { return name_; }

private:
  template <class... T>
  void visit_all(const std::array<const char*, sizeof...(T)>& names, T&... values)
  {
    std::size_t i = 0;
    (visit(names[i++], values), ...);
  }

  void visit_parameters(CGAL::Tandem::Parameters& p)
  {
    auto& [distance, angle, tolerance, offset, size, simplicity, regularity, surfel, k, cell, parallelism,
           orthogonality, coplanarity, fixed, fixed_regularity, is_symmetric, axis, period] = p;
    visit_all({"parameters.maximum_distance", "parameters.maximum_angle", "parameters.angle_tolerance",
               "parameters.maximum_offset", "parameters.minimum_region_size", "parameters.simplicity",
               "parameters.regularity", "parameters.surfel_size", "parameters.k_neighbors", "parameters.cell_size",
               "parameters.regularize_parallelism", "parameters.regularize_orthogonality",
               "parameters.regularize_coplanarity", "parameters.fixed_directions", "parameters.fixed_regularity",
               "parameters.regularize_axis_symmetry", "parameters.symmetry_direction", "parameters.regularity_period"},
              distance, angle, tolerance, offset, size, simplicity, regularity, surfel, k, cell, parallelism,
              orthogonality, coplanarity, fixed, fixed_regularity, is_symmetric, axis, period);
  }

  // Each kind of value has its corruptions.

  void visit(const std::string& field, double& x)
  {
    const double infinite = std::numeric_limits<double>::infinity();
    for(const double wrong : {std::numeric_limits<double>::quiet_NaN(), infinite, -infinite, -1 - x, 2 * x + 1})
      set(field, x, wrong);
  }

  void visit(const std::string& field, bool& x) { set(field, x, !x); }
  void visit(const std::string& field, std::size_t& x) { set_number(field, x); }
  void visit(const std::string& field, int& x) { set_number(field, x); }
  void visit(const std::string& field, std::uint32_t& x) { set_number(field, x); }

  void visit(const std::string& field, char& x)
  {
    set(field, x, char(1 - x));
    set(field, x, char(2));
  }

  template <class Number>
  void set_number(const std::string& field, Number& x)
  {
    const Number most = (std::numeric_limits<Number>::max)(), least = (std::numeric_limits<Number>::min)();
    for(const Number wrong : std::set<Number>{least, Number(x - 1), Number(x + 1), Number(most / 2), most})
      set(field, x, wrong);
  }

  void visit(const std::string& field, std::pair<int, int>& pair)
  {
    set(field, pair, std::make_pair(pair.second, pair.first));
    visit(field, pair.first);
    visit(field, pair.second);
  }

  template <class T, std::size_t n>
  void visit(const std::string& field, std::array<T, n>& values)
  {
    for(T& x : values)
      visit(field, x);
  }

  // Items in the middle stand for all.
  template <class T>
  void visit(const std::string& field, std::vector<T>& list)
  {
    make(
      field, " without its items", [&] { list.clear(); }, !list.empty());
    make(field, " with one item more", [&] { list.insert(list.end(), list.empty() ? T() : list.back()); });
    make(
      field, " without its last item", [&] { list.pop_back(); }, !list.empty());
    make(
      field, " in reverse", [&] { std::reverse(list.begin(), list.end()); },
      list != std::vector<T>(list.rbegin(), list.rend()));
    for(const std::size_t i : std::set<std::size_t>{0, list.size() / 2, list.size() - 1})
      if(i < list.size())
        visit(field + "[" + std::to_string(i) + "]", list[i]);
  }

  template <class T>
  void visit(const std::string& field, CGAL::Tandem::internal::Shared_table<T>& table)
  {
    const bool was_made = is_made();
    std::vector<T> values(table.begin(), table.end());
    visit(field, values);
    if(is_made() && !was_made)
      change_table(table, [&](std::vector<T>& changed) { changed = values; });
  }

  template <class T>
  void set(const std::string& field, T& x, const T& wrong)
  {
    make(
      field, " changed, " + std::to_string(next_), [&] { x = wrong; }, !(x == wrong));
  }

  template <class F>
  void make(const std::string& field, const std::string& how, F f, bool is_change = true)
  {
    if(!is_change || next_++ != target_)
      return;
    f();
    field_ = field;
    name_ = field + how;
  }

  std::size_t target_, next_ = 0;
  std::string field_, name_;
};

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CORRUPTIONS_H
