// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The help of detect_planes, and its messages, do not offer what the program was built without, whatever is missing;
// the options stay known, so that a run can say why they are refused.

#include "testing/checks.h"

#include "program_options.h"

#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_help)

std::string help_of(const program::Built_with& built)
{
  const char* const words[] = {"detect_planes", "--help"};
  return program::parse(2, words, built).help;
}

// On a value that is not known.
std::string message_of(const std::vector<const char*>& options, const program::Built_with& built)
{
  std::vector<const char*> words = {"detect_planes", "cloud.ply"};
  words.insert(words.end(), options.begin(), options.end());
  try {
    program::parse(int(words.size()), words.data(), built);
  } catch(const program::Usage_error& e) {
    return e.what();
  }
  return {};
}

bool has(const std::string& help, const std::string& word) { return help.find(word) != help.npos; }

void check_messages()
{
  using Built_with = program::Built_with;
  struct Offer {
    bool Built_with::*is_there;
    std::vector<const char*> options;
    std::string word;
  };
  const std::vector<const char*> backend = {"--backend=foo"};
  const Offer offers[] = {{&Built_with::tbb, backend, "parallel"},
                          {&Built_with::cuda, backend, "cuda"},
                          {&Built_with::laszip, {"--output=a.foo"}, ".laz"}};
  for(const Offer& offer : offers) {
    Built_with built;
    const std::string all = message_of(offer.options, built);
    built.*offer.is_there = false;
    const std::string message = message_of(offer.options, built);
    CHECK_AT(has(all, "must ") && has(all, offer.word), all);
    CHECK_AT(has(message, "must ") && !has(message, offer.word), message);
  }
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  using Built_with = program::Built_with;
  struct Part {
    bool Built_with::*is_there;
    std::vector<std::string> words;
  };
  const Part parts[] = {{&Built_with::tbb, {"sequential, parallel"}},
                        {&Built_with::cuda, {"cuda"}},
                        {&Built_with::mpi, {"mpirun", "of each process", "processes"}},
                        {&Built_with::gzip, {".gz"}},
                        {&Built_with::laszip, {".laz"}},
                        {&Built_with::view, {"--view ", "browser"}}};
  const std::string all = help_of({});
  Built_with nothing;
  for(const Part& part : parts) {
    Built_with built;
    built.*part.is_there = nothing.*part.is_there = false;
    const std::string help = help_of(built);
    for(const std::string& word : part.words)
      CHECK_AT(has(all, word) && !has(help, word), word);
  }
  const std::string least = help_of(nothing);
  for(const Part& part : parts)
    for(const std::string& word : part.words)
      CHECK_AT(!has(least, word), word);
  const char* const words[] = {"detect_planes", "cloud.ply", "--view=v.html"};
  program::parse(3, words, nothing);
  check_messages();
}

BOOST_AUTO_TEST_SUITE_END()
