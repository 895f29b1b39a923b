// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loops, compaction, collection, sums, buffers, the searches of a block, find() and find_first(), and the table of links
// beside plain loops, on any back end.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BACKEND_OPERATIONS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BACKEND_OPERATIONS_H

#include <CGAL/Tandem/internal/shapes/links.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL::Tandem::internal {

struct Visit_item {
  std::uint32_t* visits;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { ++visits[i]; }
};

struct Is_end_of_step {
  std::uint32_t step;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const { return i % step == step - 1; }
};

// Of a size that is no power of two.
struct Taken_item {
  std::uint32_t index;
  unsigned char rest[7];

  CGAL_TANDEM_HD bool operator==(const Taken_item& other) const
  {
    return index == other.index && rest[0] == other.rest[0] && rest[6] == other.rest[6];
  }
};

CGAL_TANDEM_HD inline Taken_item make_taken_item(std::uint32_t i)
{
  return {i, {(unsigned char)(i % 7), 0, 0, 0, 0, 0, (unsigned char)(i % 251)}};
}

// What is taken changes what decides which items are: an item and the one at the same distance from the end.
struct Take_items {
  std::uint32_t* counter;
  std::uint32_t size;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return counter[i] + counter[size - 1 - i] == 7; }
  CGAL_TANDEM_HD Taken_item take(std::uint32_t i) const
  {
    counter[i] += 100;
    return make_taken_item(i);
  }
};

// Large and negative summands; some items add nothing to the second and the third sum.
struct Add_to_sums {
  CGAL_TANDEM_HD void operator()(std::size_t i, std::int64_t* sums) const
  {
    const std::int64_t value = std::int64_t(i % 1000) - 300;
    sums[0] += value * (std::int64_t(1) << 40);
    if(i % 3 == 0)
      sums[1] -= value;
    if(i % 20000 == 19999)
      sums[2] += 1;
  }
};

// An addition is a link.
template <class Backend>
struct Add_links {
  const Link* addition;
  Link_set<Backend> set;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { set.add(addition[i].pair, addition[i].contact); }
};

// From the item `start` of each cell on.
struct Search_cells {
  const Range* cells;
  const std::uint8_t* is_hit;
  std::uint32_t start, most;
  std::uint32_t* found; // `most` for each cell
  std::uint32_t* size;
  std::uint32_t* first;
  std::uint32_t* visits;

  template <class Block, class Scratch>
  CGAL_TANDEM_HD void operator()(Block& block, Scratch&, std::uint32_t c) const
  {
    const std::uint8_t* hits = is_hit + cells[c].first;
    const auto test = [&](std::uint32_t i) { return hits[i] != 0; };
    const std::uint32_t n = block.find(start, cells[c].size(), most, test,
                                       [&](std::uint32_t rank, std::uint32_t i) { found[c * most + rank] = i; });
    const std::uint32_t one = block.find_first(start, cells[c].size(), test);
    block.single([&] {
      size[c] = n;
      first[c] = one;
      ++visits[c];
    });
  }
};

// Of cells of many sizes with none, few, many and only hits. Returns the number of searches that differ.
template <class Backend>
int count_wrong_searches(Backend& backend, std::uint32_t start, std::uint32_t most)
{
  std::mt19937_64 random(start + most);
  std::vector<Range> cells;
  std::vector<std::uint8_t> is_hit;
  for(std::uint32_t one_of : {0u, 1000u, 40u, 3u, 1u})
    for(std::uint32_t size : {0u, 1u, 31u, 32u, 33u, 511u, 512u, 513u, 4000u}) {
      const std::uint32_t begin = std::uint32_t(is_hit.size());
      cells.push_back({begin, begin + size});
      for(std::uint32_t i = 0; i < size; ++i)
        is_hit.push_back(one_of != 0 && random() % one_of == 0);
    }
  const std::uint32_t untouched = 0x5a5a5a5au;
  const auto ranges = to_buffer(backend, cells);
  const auto hits = to_buffer(backend, is_hit);
  auto founds = filled_buffer(backend, cells.size() * most, untouched);
  auto sizes = filled_buffer(backend, cells.size(), untouched),
       firsts = filled_buffer(backend, cells.size(), untouched),
       visited = filled_buffer(backend, cells.size(), std::uint32_t(0));
  backend.template for_each_cell<std::uint32_t>(
    cells.size(),
    Search_cells{ranges.data(), hits.data(), start, most, founds.data(), sizes.data(), firsts.data(), visited.data()});
  const std::vector<std::uint32_t> found = to_vector(backend, founds), size = to_vector(backend, sizes),
                                   first = to_vector(backend, firsts), visits = to_vector(backend, visited);
  int wrong = 0;
  for(std::size_t c = 0; c < cells.size(); ++c) {
    std::vector<std::uint32_t> expected;
    for(std::uint32_t i = start; i < cells[c].size(); ++i)
      if(is_hit[cells[c].first + i])
        expected.push_back(i);
    const std::uint32_t expected_first = expected.empty() ? cells[c].size() : expected.front();
    expected.resize((std::min)(expected.size(), std::size_t(most)));
    const bool is_size = size[c] == expected.size();
    expected.resize(most, untouched);
    wrong += first[c] != expected_first || !is_size || visits[c] != 1 ||
             !std::equal(expected.begin(), expected.end(), found.begin() + std::ptrdiff_t(c * most));
  }
  return wrong;
}

constexpr std::uint32_t search_starts[] = {0, 1, 32, 700}, search_sizes[] = {1, 31, 32, 33, 600};

template <class Backend>
class Backend_operations {
public:
  explicit Backend_operations(Backend& backend) : backend_(backend) {}

  // What is wrong.
  std::vector<std::string> run()
  {
    for(std::uint32_t n : {0u, 1u, 1023u, 1024u, 1025u, 32768u, 32769u, 300000u}) {
      test_loops(n);
      for(std::uint32_t step : {1u, 3u, 20000u, 400000u})
        test_collect(n, step);
      test_sums(n);
      test_buffers(n);
    }
    for(std::uint32_t start : search_starts)
      for(std::uint32_t most : search_sizes)
        check(count_wrong_searches(backend_, start, most) == 0, "searches", most);
    for(std::size_t n : {0, 100, 4095, 30000})
      for(std::uint32_t ids : {2u, 8192u, 0xfffffff0u}) {
        const std::vector<Link> additions = random_additions(n, ids);
        for(std::size_t size : {1, 1024, 65536}) // also where it is too small
          test_links(additions, size);
      }
    return wrong_;
  }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  void check(bool is_right, const std::string& what, std::size_t n)
  {
    if(!is_right)
      wrong_.push_back(what + " of " + std::to_string(n));
  }

  // Each item once, whatever number of items is said to be worth a thread.
  void test_loops(std::size_t n)
  {
    Buffer<std::uint32_t> visits = filled_buffer(backend_, n, std::uint32_t(0));
    std::uint32_t times = 0;
    for(std::size_t grain : {1, 3, 32, 4096, 1000000}) {
      backend_.for_each(n, Visit_item{visits.data()}, grain);
      check(to_vector(backend_, visits) == std::vector<std::uint32_t>(n, ++times), "a loop", n);
    }
  }

  // The items come in their order, and each is taken once.
  void test_collect(std::uint32_t n, std::uint32_t step)
  {
    std::vector<std::uint32_t> kept, before(n, 4);
    for(std::uint32_t i = 0; i < n; ++i)
      if(Is_end_of_step{step}(i)) {
        kept.push_back(i);
        before[i] = 3;
      }
    check(to_vector(backend_, backend_.compact(n, Is_end_of_step{step})) == kept, "a compaction", n);
    check(to_vector(backend_, backend_.compact(n, Is_end_of_step{step}, kept.size())) == kept,
          "a compaction of a known size", n);
    std::vector<Taken_item> expected;
    std::vector<std::uint32_t> after = before;
    for(std::uint32_t i = 0; i < n; ++i)
      if(before[i] + before[n - 1 - i] == 7) {
        expected.push_back(make_taken_item(i));
        after[i] += 100;
      }
    Buffer<std::uint32_t> counter = to_buffer(backend_, before);
    const auto items = backend_.template collect<Taken_item>(n, Take_items{counter.data(), n});
    static_assert(std::is_same<decltype(items), const Buffer<Taken_item>>::value, "they stay where functors run");
    check(to_vector(backend_, items) == expected, "a collection", n);
    check(to_vector(backend_, counter) == after, "what is taken, ", n);
    counter = to_buffer(backend_, before);
    check(backend_.template collect_on_host<Taken_item>(n, Take_items{counter.data(), n}) == expected,
          "a collection on the host", n);
    check(to_vector(backend_, counter) == after, "what is taken on the host, ", n);
  }

  void test_sums(std::size_t n)
  {
    std::array<std::int64_t, 3> expected = {};
    for(std::size_t i = 0; i < n; ++i)
      Add_to_sums()(i, expected.data());
    check(backend_.template sum<3>(n, Add_to_sums()) == expected, "three sums", n);
  }

  void test_buffers(std::uint32_t n)
  {
    std::vector<Taken_item> table(n, make_taken_item(9));
    check(to_vector(backend_, filled_buffer(backend_, n, make_taken_item(9))) == table, "a filled buffer", n);
    for(std::uint32_t i = 0; i < n; ++i)
      table[i] = make_taken_item(i);
    const Buffer<Taken_item> copy = to_buffer(backend_, table);
    check(copy.size() == n && to_vector(backend_, copy) == table, "a buffer", n);
    table.resize(n / 2);
    check(to_vector(backend_, copy.data(), n / 2) == table, "half a buffer", n);
  }

  // --- The table of links

  using Counts = std::map<std::uint64_t, std::array<std::uint64_t, 4>>; // by pair: edges and positions

  static std::array<std::uint64_t, 4> counts(const Link& link)
  {
    const std::int64_t* const p = link.contact.position;
    return {link.contact.links, std::uint64_t(p[0]), std::uint64_t(p[1]), std::uint64_t(p[2])};
  }

  // Of pairs of which each comes about three times, most of them with one edge.
  static std::vector<Link> random_additions(std::size_t n, std::uint32_t ids)
  {
    std::mt19937 random(unsigned(n) + ids);
    std::vector<std::uint64_t> pairs(n / 3 + 1);
    for(std::uint64_t& pair : pairs) {
      const std::uint64_t a = random() % (ids - 1), b = a + 1 + random() % (ids - 1 - a);
      pair = a << 32 | b;
    }
    std::vector<Link> additions(n);
    for(Link& a : additions)
      a = {pairs[random() % pairs.size()],
           {random() % 4 == 0 ? 1 + random() % 1000 : 1u, {std::int64_t(random()), -std::int64_t(random()), 7}}};
    return additions;
  }

  // A pair is either counted in full, in one place, or its additions are lost, each of them.
  void test_links(const std::vector<Link>& additions, std::size_t size)
  {
    const auto check_table = [&](bool is_right, const char* what) {
      check(is_right, std::to_string(additions.size()) + " additions, " + what + ": table", size);
    };
    Counts expected;
    std::map<std::uint64_t, std::uint32_t> number;
    for(const Link& a : additions) {
      const auto added = counts(a);
      for(std::size_t i = 0; i < added.size(); ++i)
        expected[a.pair][i] += added[i];
      ++number[a.pair];
    }
    Buffer<Link> table = filled_buffer(backend_, size, Link());
    Buffer<std::uint32_t> lost = filled_buffer(backend_, 1, std::uint32_t(0));
    const Buffer<Link> source = to_buffer(backend_, additions);
    backend_.for_each(additions.size(),
                      Add_links<Backend>{source.data(), {table.data(), std::uint32_t(size), lost.data()}}, 32);
    Counts got;
    for(const Link& link : to_vector(backend_, table.data(), size))
      check_table(link.pair == Link::none ? link.contact.links == 0 : got.emplace(link.pair, counts(link)).second,
                  "a pair has two links, or none has one");
    std::uint32_t expected_lost = 0;
    for(const auto& e : expected)
      if(got.count(e.first) == 0)
        expected_lost += number[e.first];
      else
        check_table(got[e.first] == e.second, "edges of a link");
    for(const auto& g : got)
      check_table(expected.count(g.first) == 1, "a link of another pair");
    check_table(to_vector(backend_, lost.data(), 1)[0] == expected_lost, "additions that are lost");
    check_table(expected.size() <= size || expected_lost > 0, "none is lost");
    check_table((4 * expected.size() > size && expected.size() > 1) || expected_lost == 0, "some are lost");
    for(std::uint32_t minimum : {1u, 2u, 700u}) {
      const auto links =
        to_vector(backend_, backend_.template collect<Link>(size, Take_links{table.data(), lost.data(), minimum}));
      Counts enough, taken;
      for(const auto& e : expected)
        if(e.second[0] >= minimum)
          enough.insert(e);
      for(const Link& link : links)
        taken.emplace(link.pair, counts(link));
      check_table(expected_lost > 0 ? links.size() == size : taken == enough && links.size() == enough.size(),
                  "links of at least so many edges, or all slots");
    }
  }

  Backend& backend_;
  std::vector<std::string> wrong_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_BACKEND_OPERATIONS_H
