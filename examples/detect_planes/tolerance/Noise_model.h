// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The noise of a sensor by the range: the value of --noise.

#ifndef DETECT_PLANES_NOISE_MODEL_H
#define DETECT_PLANES_NOISE_MODEL_H

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace program {

// The standard deviation at the range r is c[0] + c[1] r + c[2] r^2.
struct Noise_model {
  std::array<double, 3> c = {0, 0, 0};

  // The same with every compiler.
  double operator()(double range) const { return std::fma(range, std::fma(range, c[2], c[1]), c[0]); }
};

// Reads a sum of terms in any order. A term is a product of numbers and powers of r, where the sign of a product may be
// left out: 2.8e-3*r^2, 2.8e-3 r r, r*.0028*r.
class Noise_parser {
public:
  explicit Noise_parser(std::string_view expression) : text(expression), rest(expression) {}

  Noise_model parse()
  {
    Noise_model noise;
    skip_blanks();
    do
      read_term(noise);
    while(!rest.empty());
    if(noise.c == std::array<double, 3>())
      fail("is 0 at every range");
    for(double c : noise.c)
      if(!std::isfinite(c))
        fail("has too large a number");
    return noise;
  }

private:
  [[noreturn]] void fail(const std::string& reason) const
  {
    throw std::invalid_argument("--noise is '" + std::string(text) + "', which " + reason +
                                "; it must be a sum of numbers and powers of the range r, as in 0.001 + 0.0028*r^2");
  }

  void skip_blanks() { rest.remove_prefix((std::min)(rest.find_first_not_of(" \t\r\n"), rest.size())); }

  bool skip(std::string_view token)
  {
    if(rest.substr(0, token.size()) != token)
      return false;
    rest.remove_prefix(token.size());
    skip_blanks();
    return true;
  }

  bool is_at_sign() const { return !rest.empty() && (rest[0] == '+' || rest[0] == '-'); }
  bool is_at_range() const { return !rest.empty() && (rest[0] == 'r' || rest[0] == 'R'); }

  void read_term(Noise_model& noise)
  {
    double value = 1;
    std::size_t power = 0;
    read_factor(value, power);
    while(skip("*") || is_at_range())
      read_factor(value, power);
    if(!rest.empty() && !is_at_sign())
      fail("has '" + next_word() + "' where + or - is expected");
    if(power >= noise.c.size())
      fail("has r^" + std::to_string(power) + ", and the largest power is r^2");
    noise.c[power] += value;
  }

  // May have several signs, as in + -0.001.
  void read_factor(double& value, std::size_t& power)
  {
    while(is_at_sign())
      value = skip("-") ? -value : (skip("+"), value);
    if(skip("r") || skip("R")) {
      power += read_power();
      return;
    }
    double number = 0;
    const auto end = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    if(end.ec == std::errc::result_out_of_range)
      fail("has a number out of range");
    if(end.ec != std::errc() || !std::isfinite(number))
      fail(rest.empty() ? "ends where a number or r is expected"
                        : "has '" + next_word() + "' where a number or r is expected");
    rest.remove_prefix(std::size_t(end.ptr - rest.data()));
    skip_blanks();
    value *= number;
  }

  std::size_t read_power()
  {
    if(skip("\u00b2"))
      return 2;
    if(!skip("^") && !skip("**"))
      return 1;
    unsigned power = 0;
    const auto end = std::from_chars(rest.data(), rest.data() + rest.size(), power);
    if(end.ec != std::errc() || power > 100)
      fail("has no power behind r^");
    rest.remove_prefix(std::size_t(end.ptr - rest.data()));
    skip_blanks();
    return power;
  }

  std::string next_word() const { return std::string(rest.substr(0, rest.find_first_of(" \t+-*")).substr(0, 20)); }

  std::string_view text, rest;
};

inline Noise_model parse_noise(const std::string& text) { return Noise_parser(text).parse(); }

} // namespace program

#endif // DETECT_PLANES_NOISE_MODEL_H
