// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line of detect_planes: a word in each line.

#include "program_options.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

void expect(bool is_true, const char* what)
{
  if(is_true)
    return;
  std::fprintf(stderr, "fuzz_options: %s\n", what);
  std::abort();
}

bool is_in(const std::optional<long long>& value, long long smallest, long long largest)
{
  return !value || (*value >= smallest && *value <= largest);
}

// What the program relies on after parse().
void check_parsed(const program::Options& o)
{
  expect(!o.inputs.empty(), "no input");
  expect(o.output.empty() || program::is_known_output(o.output), "format of the output");
  expect(is_in(o.threads, 1, 4096), "threads");
  expect(is_in(o.estimate_normals, 0, 1000), "neighbors of the PCA");
  expect(!o.noise || (std::isfinite(o.noise->c[0]) && std::isfinite(o.noise->c[1]) && std::isfinite(o.noise->c[2])),
         "noise");
  expect(int(o.has_local_distances) + int(o.noise.has_value()) + int(!o.tolerance_column.empty()) <= 1,
         "tolerances of points");
  expect(o.polygons.size() >= 4 || o.polygons.empty(), "format of the mesh");
  expect(o.backend == "auto" || o.backend == "sequential" || o.backend == "parallel" || o.backend == "cuda",
         "back end");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  // As in a process, words end with the first null byte.
  std::vector<std::string> words = {"detect_planes"};
  std::istringstream lines(std::string(bytes, bytes + size));
  for(std::string line; std::getline(lines, line);)
    words.push_back(line.c_str());
  std::vector<const char*> arguments;
  for(const std::string& word : words)
    arguments.push_back(word.c_str());
  try {
    const program::Command_line command_line = program::parse(int(arguments.size()), arguments.data());
    expect(!command_line.help.empty(), "no help");
    if(!command_line.options.wants_help)
      check_parsed(command_line.options);
  } catch(const program::Usage_error& e) {
    expect(e.what()[0] != '\0', "an empty message");
  } // anything else is a fault: it would not be exit code 2
  return 0;
}
