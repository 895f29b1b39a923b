// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checks that cost little where they hold, so that a test can make millions of them: Boost.Test hears of those that do
// not. What is said of the place is only made then.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECKS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECKS_H

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iostream>
#include <limits>
#include <sstream>
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

// So far, of all cases.
inline int& failures()
{
  static int count = 0;
  return count;
}

// Programs that mpiexec starts have a main() of their own, and no case in progress.
inline void fail(const std::string& what, const char* file = __FILE__, int line = __LINE__)
{
  ++failures();
  if(boost::unit_test::framework::test_in_progress())
    BOOST_ERROR(what << ", at " << file << ":" << line);
  else
    std::cerr << file << ":" << line << ": " << what << std::endl;
}

// Whether a case could not run here, and has said so: then a program without failures exits with 77, see main.cpp.
inline bool& is_skipped()
{
  static bool is_any = false;
  return is_any;
}

inline void skip(const std::string& why)
{
  is_skipped() = true;
  std::cout << "skipped: " << why << std::endl;
}

// What follows `--` on the command line: test_engine --run_test=test_properties -- SEED COUNT.
inline std::uint64_t argument(int i, std::uint64_t otherwise)
{
  const auto& suite = boost::unit_test::framework::master_test_suite();
  return i < suite.argc ? std::stoull(suite.argv[i]) : otherwise;
}

// The place is a text, or anything that can be added to one.
#define CHECK_AT(condition, where)                                                                                     \
  ((condition) ? void() : fail(std::string(#condition) + ", " + (where), __FILE__, __LINE__))
#define CHECK(condition) ((condition) ? void() : fail(#condition, __FILE__, __LINE__))

// Shows the value with all its digits.
template <class T, class U>
void check(bool is_true, const std::string& what, const T& value, const U& expected)
{
  if(is_true)
    return;
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << what << " is " << value << ", expected " << expected;
  fail(text.str());
}

inline void check(bool is_true, const std::string& what)
{
  if(!is_true)
    fail(what);
}

inline void check(bool is_true, const std::string& what, double value)
{
  if(!is_true)
    fail(what + " " + std::to_string(value));
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
    fail("no exception", "line", line);
  } catch(const Exception& e) {
    for(const char* word : words)
      if(std::string(e.what()).find(word) == std::string::npos)
        fail(std::string(word) + " is not in: " + e.what(), "line", line);
  }
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECKS_H
