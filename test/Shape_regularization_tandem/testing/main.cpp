// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE Tandem
#define BOOST_TEST_NO_MAIN
#include "checks.h"

// CTest takes a test for skipped by this code, not by what it prints: so a failure beside what is skipped counts.
int main(int argc, char** argv)
{
  const int result = boost::unit_test::unit_test_main(&init_unit_test, argc, argv);
  return result == 0 && is_skipped() ? 77 : result;
}
