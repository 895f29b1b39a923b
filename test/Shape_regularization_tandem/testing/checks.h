// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks that say where they failed, and the number of failures, from which a test makes what it returns.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECKS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECKS_H

#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <iostream>
#include <limits>
#include <string>

// With a sanitizer, tests take ten times as long: some are smaller there.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CGAL_TANDEM_TEST_IS_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CGAL_TANDEM_TEST_IS_SANITIZED
#endif
#ifdef CGAL_TANDEM_TEST_IS_SANITIZED
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

inline int& failures()
{
  static int count = 0;
  return count;
}

inline int report()
{
  if(failures() > 0)
    std::cerr << failures() << " failures" << std::endl;
  return failures() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

inline void check_at(bool is_true, const char* what, int line, const std::string& where = std::string())
{
  if(is_true)
    return;
  ++failures();
  std::cerr << "line " << line << ": " << what << (where.empty() ? "" : ", ") << where << std::endl;
}

#define CHECK(condition) check_at((condition), #condition, __LINE__)
#define CHECK_AT(condition, where) check_at((condition), #condition, __LINE__, (where))

// Shows the value with all its digits.
template <class T, class U>
void check(bool is_true, const std::string& what, const T& value, const U& expected)
{
  if(is_true)
    return;
  ++failures();
  const auto precision = std::cerr.precision(std::numeric_limits<double>::max_digits10);
  std::cerr << what << " is " << value << ", expected " << expected << std::endl;
  std::cerr.precision(precision);
}

inline void check(bool is_true, const std::string& what)
{
  if(is_true)
    return;
  ++failures();
  std::cerr << what << std::endl;
}

inline void check(bool is_true, const std::string& what, double value)
{
  check(is_true, what + " " + std::to_string(value));
}

template <class T, class U>
void check_equal(const T& value, const U& expected, const std::string& what)
{
  check(value == T(expected), what, value, expected);
}

inline void check_close(double value, double expected, double tolerance, const std::string& what)
{
  check(std::fabs(value - expected) <= tolerance, what, value, expected);
}

template <class Exception, class Function>
bool throws(Function f)
{
  try {
    f();
  } catch(const Exception&) {
    return true;
  }
  return false;
}

// f() has to throw an Exception whose text has all of the words.
template <class Exception, class F>
void check_throws(F f, std::initializer_list<const char*> words, int line)
{
  try {
    f();
    check_at(false, "no exception", line);
  } catch(const Exception& e) {
    for(const char* word : words)
      check_at(std::string(e.what()).find(word) != std::string::npos, word, line,
               std::string("is not in: ") + e.what());
  }
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECKS_H
