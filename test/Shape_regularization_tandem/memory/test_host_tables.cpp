// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables of the host: pages that are kept, tables that grow, tables that are shared, lists that are parted.

#undef NDEBUG

#include "testing/Thread_backend.h"
#include "testing/test_support.h"

#include <CGAL/Tandem/internal/memory/Growing_table.h>
#include <CGAL/Tandem/internal/backend/host_loops.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Tandem::internal;

// Pages come back for a buffer of about the same size, once, and not for others.
void test_kept_pages()
{
  Host_buffer<double> buffer(1000);
  const void* const memory = buffer.data();
  buffer.keep_pages();
  buffer.release();
  CHECK(Host_buffer<double>(10).data() != memory);
  CHECK(Host_buffer<float>(1900).data() == memory);
  CHECK(Kept_pages::take(8000).memory == nullptr);
  Host_buffer<double> smaller(1000), larger(1100);
  const void* const pages[2] = {smaller.data(), larger.data()};
  smaller.keep_pages();
  larger.keep_pages();
  smaller.release();
  larger.release();
  smaller.reset(1000); // leaves the larger pages to those who need them
  larger.reset(1100);
  CHECK(smaller.data() == pages[0] && larger.data() == pages[1]);
  Host_buffer<double> rare(50000);
  const void* const rare_pages = rare.data();
  rare.keep_pages();
  rare.release();
  for(int i = 0; i < 20; ++i) { // what comes and goes leaves the others alone
    buffer.reset(1000);
    buffer.keep_pages();
    buffer.release();
  }
  CHECK(Host_buffer<double>(45000).data() == rare_pages);
  for(std::size_t i = 0; i < 20; ++i) {
    buffer.reset(1000 + 1000 * i);
    buffer.keep_pages();
  }
  buffer.release();
  Kept_pages::release();
  CHECK(Kept_pages::take(160000).memory == nullptr);
}

// Items keep their values when the table moves; new ones are T().
void test_growing_table()
{
  struct Item {
    int value = 7;
  };
  Thread_backend backend(3);
  Growing_table<Item> table;
  table.resize(backend, 3);
  for(int i = 0; i < 3; ++i)
    table[std::size_t(i)].value = i;
  table.resize(backend, 5000);
  CHECK(table.size() == 5000 && table[1].value == 1 && table[2].value == 2 && table[3].value == 7 &&
        table[4999].value == 7);
  table[4000].value = 11;
  table.keep(backend, {2, 5, 4000});
  CHECK(table.size() == 3 && table[0].value == 2 && table[1].value == 7 && table[2].value == 11);
  table.resize(backend, 4);
  CHECK(table.size() == 4 && table[2].value == 11 && table[3].value == 7);
}

// Copies share the items.
void test_shared_table()
{
  const Shared_table<int> none;
  CHECK(none.empty() && none.size() == 0 && none.begin() == none.end());
  Host_buffer<int> buffer(3);
  for(int i = 0; i < 3; ++i)
    buffer[std::size_t(i)] = i;
  const Shared_table<int> table(std::move(buffer)), copy = table;
  CHECK(copy.data() == table.data() && copy.size() == 3 && copy[2] == 2 && copy.end() - copy.begin() == 3);
}

// Only items without a value are left as they are.
void test_unset_vector()
{
  Unset_vector<int> table(3, 7);
  table.resize(5, 8);
  table.push_back(9);
  CHECK((std::vector<int>(table.begin(), table.end()) == std::vector<int>{7, 7, 7, 8, 8, 9}));
  table.reserve(100);
  const int* const memory = table.data();
  table.clear();
  table.resize(6); // as they were; of no use but here
  CHECK(table.data() == memory && table[0] == 7 && table[5] == 9);
}

// In the order of the list, each tested once, with lists of any size.
template <class Backend>
void test_parted_lists(Backend& backend)
{
  for(std::size_t n : {0, 1, 63, 64, 65, 255, 256, 1000, 5001}) {
    std::vector<int> calls(n, 0);
    const auto id = [](std::size_t i) { return std::uint32_t(3 * i + 1); };
    const auto is_chosen = [](std::uint32_t k) { return k * 2654435761u >> 30 == 1; };
    const Parted_ids parted = part_on_host(backend, n, id, [&](std::uint32_t k) {
      ++calls[k / 3];
      return is_chosen(k);
    });
    Ids all, chosen, others;
    for(std::size_t i = 0; i < n; ++i)
      all.push_back(id(i));
    std::partition_copy(all.begin(), all.end(), std::back_inserter(chosen), std::back_inserter(others), is_chosen);
    CHECK_AT(parted.chosen == chosen && parted.others == others, "a list of " + std::to_string(n));
    CHECK_AT(std::count(calls.begin(), calls.end(), 1) == std::ptrdiff_t(n), "calls for " + std::to_string(n));
    const std::int64_t sum = sum_on_host(backend, n, [&](std::size_t i) { return id(i); });
    CHECK_AT(sum == std::accumulate(all.begin(), all.end(), std::int64_t(0)), "a sum of " + std::to_string(n));
  }
}

int main()
{
  test_kept_pages();
  test_growing_table();
  test_shared_table();
  test_unset_vector();
  Sequential_backend sequential;
  test_parted_lists(sequential);
  Thread_backend threads(3);
  test_parted_lists(threads);
  return report();
}
