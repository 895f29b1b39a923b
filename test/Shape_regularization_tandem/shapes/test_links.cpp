// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Links against plain maps, on several back ends: the table that all cells fill at the same time, also where it is too
// small, and the links of a cloud, for which the first table may be too small.

#include "testing/body_fixture.h"
#include "testing/link_sets.h"

#include <CGAL/Tandem/internal/shapes/links.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_links)

using namespace CGAL::Tandem::internal;

template <class Backend>
class Cloud_tests {
public:
  Cloud_tests(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    for(std::uint32_t shapes : {3u, 64u, 3000u})
      for(Links which : {Links::all, Links::changed})
        test_links(shapes, which);
    for(std::uint32_t parts : {1u, 3u, 16u})
      test_parts(parts);
  }

private:
  // Half of the points have any shape, the others that of the points around; some are free, and some shapes have none.
  std::vector<std::uint32_t> make_labels(std::uint32_t shapes) const
  {
    std::mt19937 random(shapes);
    std::vector<std::uint32_t> label(f_.cloud.size);
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      const std::uint32_t s = i < label.size() / 2 ? std::uint32_t(random() % shapes) : i / 150 % shapes;
      label[i] = i % 13 == 0 || s % 41 == 40 ? free_label : s;
    }
    return label;
  }

  // By shape.
  std::vector<Shape> make_shapes(const std::vector<std::uint32_t>& label, std::uint32_t shapes) const
  {
    std::vector<Shape> shape(shapes);
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark)
        shape[label[i]].moments.add(f_.point[i], 1);
    for(std::uint32_t s = 0; s < shapes; ++s)
      shape[s].history.set_linked(s % 3 != 0);
    return shape;
  }

  void test_links(std::uint32_t number, Links which)
  {
    const std::string where = name_ + ": links of " + std::to_string(number) + " shapes";
    const std::vector<std::uint32_t> label = make_labels(number);
    const std::vector<Shape> shape = make_shapes(label, number);
    std::map<std::uint64_t, std::uint32_t> expected;
    std::vector<std::uint8_t> expected_state(label.size(), tried_seed_bit);
    for(std::uint32_t i = 0; i < label.size(); ++i) {
      const std::uint32_t s = label[i];
      if(s >= first_mark || (which == Links::changed && shape[s].history.is_linked()))
        continue;
      bool is_inside = true;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = label[q];
        is_inside = is_inside && t == s;
        if(t != s && t < first_mark)
          ++expected[std::uint64_t((std::min)(s, t)) << 32 | (std::max)(s, t)];
      });
      if(is_inside)
        expected_state[i] |= interior_bit;
    }
    const std::size_t pairs = expected.size();
    for(auto e = expected.begin(); e != expected.end();)
      e = e->second < tuning::moves::minimum_edges ? expected.erase(e) : std::next(e);

    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, label, std::vector<std::uint8_t>(label.size(), tried_seed_bit));
    Shape_table<Backend> shapes = make_table(backend_, shape);
    check_links(collect_links(points, shapes, which, Phase::loop), expected, where);
    check_lists(to_vector(backend_, points.state(), label.size()), expected_state, where + ", interior points");
    for(std::uint32_t s = 0; s < number; ++s)
      check_equal(shapes.table()[s].history.is_linked(), which == Links::changed || s % 3 != 0,
                  where + ", shapes that have changed");
    // Without the interior points, which have no links.
    check_links(collect_links(points, shapes, which, Phase::loop),
                which == Links::all ? expected : std::map<std::uint64_t, std::uint32_t>(), where + " again");
    if(number == 64 && which == Links::all && label.size() > 3000)
      CHECK_AT(pairs > 1024, where + ": the first table is large enough for " + std::to_string(pairs) + " pairs");
  }

  // Of some shapes, in parts of cells, into a table that is large enough.
  void test_parts(std::uint32_t parts)
  {
    std::vector<std::uint8_t> state(f_.state.size(), 0), expected_state(state), is_selected;
    for(std::size_t s = 0; s < f_.plane.size(); ++s)
      is_selected.push_back(s % 4 != 1);
    std::map<std::uint64_t, std::uint32_t> expected, got;
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i];
      if(s >= first_mark || !is_selected[s])
        continue;
      expected_state[i] = interior_bit;
      f_.for_each_neighbor(i, [&](std::uint32_t q) {
        const std::uint32_t t = f_.label[q];
        if(t != s)
          expected_state[i] = 0;
        if(t != s && t < first_mark)
          ++expected[std::uint64_t((std::min)(s, t)) << 32 | (std::max)(s, t)];
      });
    }
    std::uint32_t size = 1, lost = 0;
    while(size < 2 * f_.neighbor.size())
      size *= 2;
    std::vector<Link> links(size);
    std::vector<std::uint32_t> label = f_.label;
    backend_.template for_each_cell<Link_scratch>(
      f_.cells.size() * parts,
      Collect_links<Backend>{
        f_.cloud, f_.parts_view(parts), label.data(), state.data(), is_selected.data(), {links.data(), size, &lost}});
    for(const Link& link : links)
      if(link.pair != Link::none)
        CHECK_AT(got.emplace(link.pair, link.count).second, name_ + ": a pair has two links");
    check_equal(lost, 0u, name_ + ": links that are lost");
    CHECK_AT(got == expected && expected.size() > 3, name_ + ": links");
    check_lists(state, expected_state, name_ + ": interior points");
  }

  void check_links(const typename Backend::template Buffer<Link>& links,
                   const std::map<std::uint64_t, std::uint32_t>& expected, const std::string& where)
  {
    std::map<std::uint64_t, std::uint32_t> got;
    for(const Link& link : to_vector(backend_, links))
      CHECK_AT(got.emplace(link.pair, link.count).second, where + ": a pair has two links");
    CHECK_AT(got == expected, where);
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

template <class Backend>
void test(Backend backend, const std::string& name)
{
  for(const std::string& wrong : Link_sets<Backend>(backend).run())
    CHECK_AT(false, name + ": " + wrong);
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  on_body_backends([](auto backend, const std::string& name) { test(backend, name); });
  test_on_all_backends<Cloud_tests>();
}

BOOST_AUTO_TEST_SUITE_END()
