// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of links beside a map, on any back end, also where it is too small.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LINK_SETS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LINK_SETS_H

#include <CGAL/Tandem/internal/shapes/links.h>

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace CGAL::Tandem::internal {

// An addition is a link.
template <class Backend>
struct Add_links {
  const Link* addition;
  Link_set<Backend> set;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { set.add(addition[i].pair, addition[i].count); }
};

template <class Backend>
class Link_sets {
public:
  explicit Link_sets(Backend& backend) : backend_(backend) {}

  // What is wrong.
  std::vector<std::string> run()
  {
    for(std::size_t n : {0, 100, 4095, 30000})
      for(std::uint32_t ids : {2u, 8192u, 0xfffffff0u}) {
        const std::vector<Link> additions = random_additions(n, ids);
        for(std::size_t size : {1, 1024, 65536})
          test_set(additions, size);
      }
    return wrong_;
  }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  using Counts = std::map<std::uint64_t, std::uint32_t>; // by pair

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
      a = {pairs[random() % pairs.size()], random() % 4 == 0 ? 1 + std::uint32_t(random() % 1000) : 1u};
    return additions;
  }

  void check(bool is_right, const std::string& what)
  {
    if(!is_right)
      wrong_.push_back(what);
  }

  // A pair is either counted in full, in one place, or its additions are lost, each of them.
  void test_set(const std::vector<Link>& additions, std::size_t size)
  {
    const std::string where =
      std::to_string(additions.size()) + " additions to a table of " + std::to_string(size) + ": ";
    Counts expected, number; // edges, and additions
    for(const Link& a : additions) {
      expected[a.pair] += a.count;
      ++number[a.pair];
    }
    Buffer<Link> table = filled_buffer(backend_, size, Link());
    Buffer<std::uint32_t> lost = filled_buffer(backend_, 1, std::uint32_t(0));
    const Buffer<Link> source = to_buffer(backend_, additions);
    backend_.for_each(additions.size(),
                      Add_links<Backend>{source.data(), {table.data(), std::uint32_t(size), lost.data()}}, 32);
    Counts got;
    for(const Link& link : to_vector(backend_, table.data(), size))
      check(link.pair == Link::none ? link.count == 0 : got.emplace(link.pair, link.count).second,
            where + "a pair has two links, or none has one");
    std::uint32_t expected_lost = 0;
    for(const auto& e : expected)
      if(got.count(e.first) == 0)
        expected_lost += number[e.first];
      else
        check(got[e.first] == e.second, where + "edges of a link");
    for(const auto& g : got)
      check(expected.count(g.first) == 1, where + "a link of another pair");
    check(to_vector(backend_, lost.data(), 1)[0] == expected_lost, where + "additions that are lost");
    check(expected.size() <= size || expected_lost > 0, where + "none is lost");
    check((4 * expected.size() > size && expected.size() > 1) || expected_lost == 0, where + "some are lost");
    for(std::uint32_t minimum : {1u, 2u, 700u}) {
      const auto links =
        to_vector(backend_, backend_.template collect<Link>(size, Take_links{table.data(), lost.data(), minimum}));
      Counts enough, taken;
      for(const auto& e : expected)
        if(e.second >= minimum)
          enough.insert(e);
      for(const Link& link : links)
        taken.emplace(link.pair, link.count);
      check(expected_lost > 0 ? links.size() == size : taken == enough && links.size() == enough.size(),
            where + "links of at least " + std::to_string(minimum) + " edges, or all slots");
    }
  }

  Backend& backend_;
  std::vector<std::string> wrong_;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_LINK_SETS_H
