// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which columns of a table without a line of names are coordinates, by what its first rows look like.

#ifndef DETECT_PLANES_RECOGNIZE_COLUMNS_H
#define DETECT_PLANES_RECOGNIZE_COLUMNS_H

#include "input/Input_buffer.h"
#include "input/read_cloud.h"

#include <set>

namespace program {

// What a column has in the first rows. Numbers that often stand for no value count only for the order of values.
struct Column_look {
  bool has_words = false;                   // in most rows
  std::size_t count = 0, different = 0;     // numbers
  int digits = 0;                           // behind the point; -1: not as many in all rows
  bool is_integer = false, is_real = false; // all are integers; most are none
  bool is_rising = false;                   // they never fall
  double step = 0;                          // from row to row; 0: it differs
  double smallest = 0, largest = 0;         // magnitude

  bool has_copies() const { return different < count; }
};

// Behind the point. A number with an exponent is written otherwise than one without.
inline int digits_of(std::string_view number)
{
  constexpr int with_exponent = 100;
  const int before = number.find_first_of("eE") == number.npos ? 0 : with_exponent;
  const std::size_t point = (std::min)(number.find('.'), number.size() - 1);
  const auto end = std::find_if_not(number.begin() + std::ptrdiff_t(point) + 1, number.end(), is_digit);
  return before + int(end - number.begin()) - int(point) - 1;
}

// Zeros may be written with fewer digits, and are integers whatever a column has.
inline Column_look look_at(const Cells& values)
{
  constexpr double largest_error_of_step = .1;
  std::vector<double> numbers;
  std::set<int> digits, digits_of_zeros;
  std::size_t words = 0, reals = 0, integers = 0;
  Column_look look;
  look.smallest = std::numeric_limits<double>::infinity();
  for(std::string_view value : values) {
    const std::optional<double> number = parse_number(value);
    words += number ? 0 : 1;
    if(!number || !std::isfinite(*number))
      continue;
    numbers.push_back(*number);
    if(is_usual_for_none(*number))
      continue;
    (*number == 0 ? digits_of_zeros : digits).insert(digits_of(value));
    reals += *number != std::floor(*number) ? 1 : 0;
    integers += *number != 0 && *number == std::floor(*number) ? 1 : 0;
    look.smallest = (std::min)(look.smallest, std::fabs(*number));
    look.largest = (std::max)(look.largest, std::fabs(*number));
  }
  look.has_words = 2 * words > values.size();
  look.count = numbers.size();
  if(numbers.empty())
    return look;
  const std::set<int>& all = digits.empty() ? digits_of_zeros : digits;
  look.digits = all.size() == 1 ? *all.begin() : -1;
  look.is_integer = reals == 0;
  look.is_real = reals > integers;
  look.is_rising = std::is_sorted(numbers.begin(), numbers.end());
  const double mean = (numbers.back() - numbers.front()) / (std::max)(double(numbers.size()) - 1, 1.);
  const auto is_other = [=](double a, double b) {
    return !(std::fabs(b - a - mean) < largest_error_of_step * std::fabs(mean));
  };
  if(std::adjacent_find(numbers.begin(), numbers.end(), is_other) == numbers.end())
    look.step = mean;
  std::sort(numbers.begin(), numbers.end());
  look.different = std::size_t(std::unique(numbers.begin(), numbers.end()) - numbers.begin());
  return look;
}

// What is known of a column that may be x: that it is, as the reason is empty, or that it is not, or neither.
struct Column_verdict {
  std::string reason;
  bool is_certain = true;
  bool is_by_step = false; // which may not go on
};

// Coordinates are written alike, and neither count, nor are they times. Three columns of numbers follow; where these may
// not be coordinates, this one is.
inline Column_verdict judge_x(const std::vector<Column_look>& looks, std::size_t first)
{
  constexpr std::size_t fewest_rows = 10, fewest_rows_of_integers = 100, fewest_codes = 4;
  constexpr std::size_t most_copies = 4; // of the time of a pulse, by its returns
  constexpr double largest_length = 1e8; // more than the girth of the Earth in meters
  constexpr double far = 1000;           // the ratio of a time to lengths
  const Column_look &x = looks[first], &b = looks[first + 1], &c = looks[first + 2], &d = looks[first + 3];
  if((std::min)({x.count, b.count, c.count, d.count}) < fewest_rows)
    return {};
  const bool is_far = x.smallest > far * (std::max)({b.largest, c.largest, d.largest});
  if(is_far && x.smallest > largest_length)
    return {"too large for a length"};
  // As they are written; and where digits differ from row to row, by their values.
  const bool are_alike = b.digits >= 0 && b.digits == c.digits && (d.digits < 0 || (d.digits > 0) == (b.digits > 0));
  const bool is_other = x.digits >= 0 && are_alike && x.digits != b.digits;
  const bool are_real = b.is_real && c.is_real && d.is_real;
  const bool are_scattered = 2 * b.different > b.count && 2 * c.different > c.count;
  const auto are_codes = [](const Column_look& look) { return !look.is_rising && look.different >= fewest_codes; };
  if(x.is_integer &&
     (is_other || (are_real && (!x.has_copies() || (are_scattered && (are_codes(x) || x.digits != b.digits))))))
    return {"integers before other numbers", !x.has_copies() || are_codes(x)};
  if(is_other && most_copies * x.different > x.count)
    return {"other digits than the next columns"};
  const Column_look e = first + 4 < looks.size() ? looks[first + 4] : Column_look();
  if(b.is_integer && b.different > 1 && c.is_real && d.is_real && e.is_real) {
    const bool has_next_alike = c.digits > 0 && c.digits == d.digits && c.digits == e.digits;
    if(x.is_integer && (has_next_alike || !x.has_copies()))
      return {"integers before other numbers", !x.has_copies()};
    if(!x.is_integer && has_next_alike)
      return {"before integers", are_codes(b)};
  }
  const bool counts = x.is_integer && !x.has_copies() && b.is_integer && b.has_copies() && c.is_integer &&
                      c.has_copies() && x.count >= fewest_rows_of_integers;
  if(counts && !x.is_rising)
    return {"a different integer in each row"};
  if(x.step != 0 && b.step == 0 && b.different > 1)
    return {"equal steps from row to row", true, true};
  if(counts)
    return {"a different integer in each row", false};
  return {is_far && x.is_rising ? "rising, and far from the next columns" : "", false};
}

} // namespace program

#endif // DETECT_PLANES_RECOGNIZE_COLUMNS_H
