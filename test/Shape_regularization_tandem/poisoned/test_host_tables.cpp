// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables of the host: pages that are kept, memory that is filled for tests.

#include "testing/checks.h"

#include <CGAL/Tandem/internal/memory/Host_buffer.h>

#include <algorithm>

BOOST_AUTO_TEST_SUITE(test_host_tables)

using namespace CGAL::Tandem::internal;

// The pages of the buffer, which it leaves to others.
template <class T>
const void* leave(Host_buffer<T>& buffer)
{
  const void* const pages = buffer.data();
  buffer.keep_pages();
  buffer.release();
  return pages;
}

// Pages come back for a buffer of about the same size, once, and not for others.
BOOST_AUTO_TEST_CASE(test_kept_pages)
{
  Host_buffer<double> buffer(1000), smaller(1000), larger(1100), rare(50000);
  const void* pages = leave(buffer);
  CHECK(Host_buffer<double>(10).data() != pages);
  CHECK(Host_buffer<float>(1900).data() == pages && Kept_pages::kept_bytes() == 0);
  pages = leave(smaller);
  const void* const larger_pages = leave(larger);
  smaller.reset(1000); // leaves the larger pages to those who need them
  larger.reset(1100);
  CHECK(smaller.data() == pages && larger.data() == larger_pages);
  pages = leave(rare);
  for(int i = 0; i < 20; ++i) { // what comes and goes leaves the others alone
    buffer.reset(1000);
    leave(buffer);
  }
  CHECK(Host_buffer<double>(45000).data() == pages);
  buffer.reset(1000);
  pages = leave(buffer);
  const Kept_pages::Block block = Kept_pages::allocate(1100 * sizeof(double));
  CHECK(block.memory != pages); // those are somewhat too small
  Kept_pages::put(block);
  Kept_pages::release();
  CHECK(Kept_pages::kept_bytes() == 0);
}

// Large buffers leave their memory to the next ones as long as a detection lasts, but never more than was in use at one
// time. Small ones do not, and what others still use at the end is theirs.
BOOST_AUTO_TEST_CASE(test_detection)
{
  constexpr std::size_t mebibyte = std::size_t(1) << 20;
  const auto is_kept = [](std::size_t mebibytes) { return Kept_pages::kept_bytes() == mebibytes * mebibyte; };
  Host_buffer<char> longer(8 * mebibyte);
  {
    const Kept_pages::Detection first;
    Host_buffer<char> buffer(16 * mebibyte);
    const void* const memory = buffer.data();
    buffer.reset(15 * mebibyte);
    CHECK(buffer.data() == memory && is_kept(0));
    buffer.release();
    CHECK(is_kept(16));
    Host_buffer<char>(mebibyte).release();
    CHECK(is_kept(16));
    {
      const Kept_pages::Detection second;
      const Host_buffer<char> other(8 * mebibyte); // no block has this size
      CHECK(is_kept(0));
    }
    CHECK(is_kept(8));
    longer.release();
    CHECK(is_kept(16));
    longer.reset(8 * mebibyte);
  }
  CHECK(is_kept(0));
  longer.release();
  CHECK(is_kept(0));
}

// Tests that fill unset memory rely on it: new memory, kept pages, and what is set again.
BOOST_AUTO_TEST_CASE(test_poison)
{
  const auto is_filled = [](const Host_buffer<unsigned char>& buffer) {
    return std::count(buffer.begin(), buffer.end(), 0xa5) == std::ptrdiff_t(buffer.size());
  };
  Host_buffer<unsigned char> buffer(5000);
  CHECK(is_filled(buffer));
  std::fill(buffer.begin(), buffer.end(), 7);
  const void* const memory = leave(buffer);
  buffer.reset(5000);
  CHECK(buffer.data() == memory && is_filled(buffer));
  buffer.reset(100000);
  CHECK(is_filled(buffer));
}

BOOST_AUTO_TEST_SUITE_END()
