// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Time, processor time and peak memory of a piece of work in this process.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_MEASURE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_MEASURE_H

#include <chrono>
#include <cstddef>
#include <fstream>
#include <string>

#include <malloc.h>
#include <sys/resource.h>

namespace CGAL::Tandem::benchmark {

// A value of /proc/self/status in bytes; 0 where there is none.
inline std::size_t status_bytes(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  std::string word;
  std::size_t kibibytes = 0;
  while(status >> word)
    if(word == name + ":" && status >> kibibytes)
      return kibibytes * 1024;
  return 0;
}

inline double processor_seconds()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class Meter {
public:
  // Memory that was freed before must not hide what is taken from now on, and the peak begins anew.
  Meter()
  {
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";
    bytes_ = status_bytes("VmRSS");
    processor_ = processor_seconds();
    start_ = Clock::now();
  }

  // Seconds since the construction or the last call.
  double lap()
  {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

  // Both since the construction.
  double processor() const { return processor_seconds() - processor_; }
  std::size_t peak_bytes() const
  {
    const std::size_t peak = status_bytes("VmHWM");
    return peak > bytes_ ? peak - bytes_ : 0;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_;
  double processor_;
  std::size_t bytes_;
};

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_MEASURE_H
