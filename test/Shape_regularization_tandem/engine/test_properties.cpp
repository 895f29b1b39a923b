// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random scenes keep all guarantees of the manual, by a check that shares nothing with that of the package. After --
// an argument SEED repeats one case, and SEED COUNT as many, from SEED on.

#include "testing/guarantees.h"
#include "testing/property_case.h"
#include "testing/same_result.h"

BOOST_AUTO_TEST_SUITE(test_properties)

// What the cases cover.
struct Totals {
  std::size_t shapes = 0, coplanar = 0, orthogonal = 0;
};

// More than 2^24 times maximum_distance, up to rounding: then the detection throws.
bool is_too_wide(const Property_case& c)
{
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for(const auto& item : c.cloud)
    for(int k = 0; k < 3 && guarantees::has_finite_values(item.first); ++k) {
      low[k] = (std::min)(low[k], item.first[k]);
      high[k] = (std::max)(high[k], item.first[k]);
    }
  const double extent = (std::max)({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  return c.parameters.maximum_distance > 0 && extent > .999 * 0x1p24 * c.parameters.maximum_distance;
}

// Parameters that were given are those of the result.
bool has_parameters(const Shapes& shapes, const Parameters& given)
{
  const Parameters& used = shapes.parameters();
  return (given.maximum_distance == 0 || used.maximum_distance == given.maximum_distance) &&
         (given.maximum_offset == 0 || used.maximum_offset == given.maximum_offset) &&
         (given.minimum_region_size == 0 || used.minimum_region_size == given.minimum_region_size) &&
         used.maximum_angle == given.maximum_angle && used.k_neighbors == given.k_neighbors &&
         used.simplicity == given.simplicity && used.regularity == given.regularity;
}

void check_case(const Property_case& c, Totals& totals)
{
  using Parallel = CGAL::Parallel_if_available_tag;
  const Cloud before = c.cloud;
  const Shapes shapes = detect_valid(c.name, c.cloud, c.parameters, c.given);
  totals.shapes += shapes.number_of_shapes();
  totals.coplanar += shapes.number_of_shapes() - shapes.number_of_coplanar_groups();
  totals.orthogonal += shapes.orthogonal_groups().size();
  const guarantees::Checker checker(c.cloud, c.given, shapes);
  for(const std::string& violation : checker.violations())
    CHECK_AT(false, c.name + ": " + violation);
  CHECK_AT(has_parameters(shapes, c.parameters), c.name);
  check_equal(difference(shapes, detect<Parallel>(c.cloud, c.parameters, c.given)), "", c.name);
  CHECK_AT(before.empty() || std::memcmp(before.data(), c.cloud.data(), before.size() * sizeof before[0]) == 0, c.name);
  Cloud shuffled = c.cloud;
  shuffle(shuffled, c.cloud.size());
  check_equal(difference({c.cloud, shapes}, {shuffled, detect<Parallel>(shuffled, c.parameters, c.given)}, c.given), "",
              c.name);
}

BOOST_AUTO_TEST_CASE(test_random_cases)
{
  const std::uint64_t first = argument(1, 1), count = argument(2, argument(1, 0) > 0 ? 1 : 100);
  Totals totals;
  for(std::uint64_t seed = first; seed < first + count; ++seed) {
    const Property_case c = Case_maker(seed).make();
    try {
      check_case(c, totals);
    } catch(const std::range_error& e) {
      CHECK_AT(is_too_wide(c), c.name + ": " + e.what());
    } catch(const std::exception& e) {
      CHECK_AT(false, c.name + ": " + e.what());
    }
  }
  CHECK_AT(count < 100 || (totals.shapes > 300 && totals.coplanar > 5 && totals.orthogonal > 20),
           std::to_string(totals.shapes) + " shapes, " + std::to_string(totals.coplanar) + " coplanar, " +
             std::to_string(totals.orthogonal) + " orthogonal pairs");
}

BOOST_AUTO_TEST_SUITE_END()
