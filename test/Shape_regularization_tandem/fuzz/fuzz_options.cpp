// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line of detect_planes: a word in each line.

#include "program_options.h"

#include <cassert>
#include <cstdint>

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
    assert(!command_line.help.empty());
    assert(command_line.options.wants_help || !command_line.options.inputs.empty());
  } catch(const program::Usage_error& e) {
    assert(e.what()[0] != '\0');
  } // anything else is a fault: it would not be exit code 2
  return 0;
}
