// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether all ranks throw the same exception.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_FAILURE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_FAILURE_H

#include "mpi_support.h"

#include <new>
#include <stdexcept>

// Not of the standard library.
struct Stop {};

// The exception of f() by type and message. The types are those that other ranks can throw again.
template <class F>
std::string failure_of(F f)
{
  try {
    f();
  } catch(const std::invalid_argument& e) {
    return std::string("invalid_argument: ") + e.what();
  } catch(const std::logic_error& e) {
    return std::string("logic_error: ") + e.what();
  } catch(const std::range_error& e) {
    return std::string("range_error: ") + e.what();
  } catch(const std::runtime_error& e) {
    return std::string("runtime_error: ") + e.what();
  } catch(const std::bad_alloc&) {
    return "bad_alloc";
  } catch(const Stop&) {
    return "Stop";
  }
  return "nothing";
}

// The same text on all ranks, which has the words.
inline void check_failure(const Ranks& ranks, const std::string& text, std::initializer_list<const char*> words,
                          const std::string& name)
{
  for(const char* word : words)
    CHECK_AT(text.find(word) != std::string::npos, name + ": " + word + " is not in: " + text);
  const Words letters(text.begin(), text.end()), all = gather(ranks, letters, 0);
  Words expected;
  for(int r = 0; r < ranks.size() && ranks.rank() == 0; ++r)
    expected.insert(expected.end(), letters.begin(), letters.end());
  CHECK_AT(all == expected, name + ": the ranks do not agree on: " + text);
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_FAILURE_H
