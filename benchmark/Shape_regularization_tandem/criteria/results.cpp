// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "results.h"

#include <CGAL/version.h>

#include <cstdlib>
#include <ctime>
#include <thread>

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

std::string name_of_compiler()
{
#if defined(__clang__)
  return std::string("clang ") + __clang_version__;
#elif defined(__GNUC__)
  return std::string("g++ ") + __VERSION__;
#else
  return "unknown";
#endif
}

std::string name_of_processor()
{
  std::ifstream in("/proc/cpuinfo");
  for(std::string line; std::getline(in, line);)
    if(line.substr(0, 10) == "model name")
      return line.substr((std::min)(line.find(": ") + 2, line.size()));
  return "unknown";
}

std::string now()
{
  const std::time_t time = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
  return text;
}

} // namespace

Environment environment()
{
  Environment e;
  e.date = now();
  const char* commit = std::getenv("TANDEM_COMMIT"); // benchmark.sh asks git
  e.commit = commit ? commit : "unknown";
  e.compiler = name_of_compiler();
  e.cgal = CGAL_VERSION_STR;
  e.processor = name_of_processor();
  e.processors = (std::max)(1u, std::thread::hardware_concurrency());
  return e;
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
