// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options of the command line that say which of the shapes the outputs have.

#ifndef DETECT_PLANES_SELECTION_OPTIONS_H
#define DETECT_PLANES_SELECTION_OPTIONS_H

#include "Options.h"
#include "option_values.h"

#include <boost/program_options.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace program {

namespace po = boost::program_options;

// The value of --near-direction.
inline Direction_choice parse_near_direction(const std::string& text)
{
  const std::string word = text.substr(0, text.find(','));
  Direction_choice choice;
  choice.text = text;
  choice.of = word == "vertical"     ? Direction_choice::vertical
              : word == "horizontal" ? Direction_choice::horizontal
                                     : Direction_choice::direction;
  const std::size_t before_angle = choice.of == Direction_choice::direction ? 3 : 1;
  std::vector<double> numbers = read_numbers(before_angle == 1 ? "0" + text.substr(word.size()) : text);
  bool is_right = numbers.size() == before_angle;
  if(numbers.size() == before_angle + 1) {
    choice.degrees = numbers.back();
    is_right = numbers.back() >= 0 && numbers.back() <= 90;
  }
  for(std::size_t c = 0; c < 3 && is_right && before_angle == 3; ++c)
    choice.normal[c] = numbers[c];
  for(double x : choice.normal)
    is_right = is_right && std::isfinite(x);
  if(!is_right || (before_angle == 3 && choice.normal == std::array<double, 3>()))
    throw Usage_error("--near-direction is '" + text +
                      "', must be X,Y,Z, not all 0, vertical or horizontal, or one of these with ,DEG from 0 to 90");
  return choice;
}

inline void add_selection_options(po::options_description& all, Options& o)
{
  const auto number = [](std::optional<double>& target) {
    return po::value<double>()->notifier([&target](double x) { target = x; });
  };
  po::options_description group("Selection (all outputs have only the shapes that fit all of these)");
  auto add = group.add_options();
  add("largest", po::value<long long>()->value_name("N")->notifier([&o](long long n) { o.largest = n; }),
      "the N shapes with most points, of those that fit the others");
  add("minimum-area", number(o.minimum_area)->value_name("A"),
      "shapes whose points cover at least this area, in squares of the unit of the input");
  add("minimum-extent", number(o.minimum_extent)->value_name("L"),
      "shapes that are at least so long: the longer side of a rectangle around the points");
  add("near-direction", po::value<std::string>()->value_name("DIRECTION")->notifier([&o](const std::string& text) {
    o.near_direction = parse_near_direction(text);
  }),
      "shapes with a normal within 10 degrees of X,Y,Z, of either sign; 'vertical' are walls, and 'horizontal' floors "
      "and "
      "ceilings, by the symmetry direction, or else z, as upward. An angle may follow, as in vertical,5");
  all.add(group);
}

} // namespace program

#endif // DETECT_PLANES_SELECTION_OPTIONS_H
