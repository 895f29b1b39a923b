// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory that is not there: a bound on what the process may take, and a table that cannot be had. To be included by one
// source of a program, as it replaces a function of the C library.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEMORY_LIMIT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEMORY_LIMIT_H

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <fstream>

// As long as it lives, the process can take so many bytes more than it has.
class Memory_limit {
public:
  explicit Memory_limit(std::size_t bytes)
  {
    getrlimit(RLIMIT_AS, &before_);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before_;
    limit.rlim_cur = pages * std::size_t(sysconf(_SC_PAGESIZE)) + bytes;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~Memory_limit() { setrlimit(RLIMIT_AS, &before_); }

  Memory_limit(const Memory_limit&) = delete;
  Memory_limit& operator=(const Memory_limit&) = delete;

private:
  rlimit before_;
};

// How many tables can still be had before one cannot. Negative: all.
inline std::atomic<long>& tables_left()
{
  static std::atomic<long> left(-1);
  return left;
}

// The tables of the engine are from here; Open MPI calls other functions.
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t bytes)
{
  if(tables_left() >= 0 && tables_left()-- == 0)
    return nullptr;
  void* memory = nullptr;
  return posix_memalign(&memory, alignment, bytes) == 0 ? memory : nullptr;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MEMORY_LIMIT_H
