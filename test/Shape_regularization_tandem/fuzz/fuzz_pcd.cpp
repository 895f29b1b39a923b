// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader of .pcd.

#include "fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  read_as_file(bytes, size, ".pcd", 3. / 88); // three bytes, compressed
  return 0;
}
