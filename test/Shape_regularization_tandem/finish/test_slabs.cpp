// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Slabs of clutter: the neighbors of the points of each shape against plain loops on several back ends, the bound, and
// planes through clutter, which are no shapes.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/result/explain_free_points.h>

#include <algorithm>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_slabs)

using namespace CGAL::Tandem::internal;

template <class Backend>
class Slabs_of_fixture {
public:
  Slabs_of_fixture(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f)
  {}

  void run()
  {
    test_counts(f_.label, name_);
    // Few slots for many shapes.
    std::vector<std::uint32_t> label = f_.label;
    for(std::uint32_t& s : label)
      if(s < first_mark)
        s *= Neighbor_scratch::slots / 2;
    test_counts(label, name_ + ", two slots");
  }

private:
  void test_counts(const std::vector<std::uint32_t>& label, const std::string& where)
  {
    std::uint32_t shapes = 0;
    for(std::uint32_t s : label)
      shapes = s < first_mark ? (std::max)(shapes, s + 1) : shapes;
    std::vector<Plane> plane;
    std::vector<std::uint8_t> is_crisp;
    for(std::uint32_t s = 0; s < shapes; ++s) {
      plane.push_back(f_.plane[s % f_.plane.size()]);
      is_crisp.push_back(s / 2 % 2);
    }
    std::vector<std::uint64_t> counts(std::size_t(shapes) * neighbor_counts::size, 0), expected = counts;
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      if(label[i] < first_mark)
        f_.for_each_neighbor(i, [&](std::uint32_t q) {
          if(label[q] < first_mark && label[q] != label[i] && is_crisp[label[q]])
            return;
          std::uint64_t* const c = expected.data() + std::size_t(label[i]) * neighbor_counts::size;
          ++c[neighbor_counts::all];
          c[neighbor_counts::near] +=
            label[q] == label[i] || is_near(plane[label[i]], f_.point[q], f_.tolerance_of(i).distance);
        });
    backend_.template for_each_cell<Neighbor_scratch>(
      f_.cells.size(), Count_neighbors<Backend>{f_.cloud, f_.cells.data(), label.data(), plane.data(), is_crisp.data(),
                                                counts.data(), f_.tolerance});
    check_lists(counts, expected, where + ": neighbors");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

namespace {

// Eleven of twenty suffice.
void test_bound()
{
  constexpr tuning::Share least = tuning::moves::near_neighbors;
  for(std::uint64_t all : {20u, 1000u, 4000000000u})
    for(std::uint64_t near : {all * 11 / 20 - 1, all * 11 / 20, all * 11 / 20 + 1, all}) {
      const std::uint64_t counts[] = {near, all};
      check_equal(is_slab(counts), !least.is_reached(std::int64_t(near), std::int64_t(all)),
                  std::to_string(near) + " near ones of " + std::to_string(all) + " neighbors");
    }
}

// A cube of points at random, with normals along an axis, and a face through it. Every slab of the cube, 25 of them, has
// enough points for a shape; most are dropped.
void test_slabs()
{
  constexpr double epsilon = .02;
  const std::size_t on_face = 10000, in_cube = 20000;
  Cloud cloud;
  scenes::Random random(5);
  for(std::size_t i = 0; i < on_face + in_cube; ++i) {
    const double z = i < on_face ? .5 + .2 * epsilon * random.gaussian() : random.uniform();
    cloud.emplace_back(Kernel::Point_3(random.uniform(), random.uniform(), z), Kernel::Vector_3(0, 0, 1));
  }
  const Shapes shapes = detect_valid("slabs", cloud, make_parameters(epsilon, 200));
  CHECK(shapes.number_of_shapes() <= 12);
  CHECK_AT(shapes.size(0) > on_face * 9 / 10, std::to_string(shapes.size(0)) + " points of the face");
}

} // namespace

BOOST_AUTO_TEST_CASE(all_cases)
{
  test_with_levels_on_all_backends<Slabs_of_fixture>();
  test_bound();
  test_slabs();
}

BOOST_AUTO_TEST_SUITE_END()
