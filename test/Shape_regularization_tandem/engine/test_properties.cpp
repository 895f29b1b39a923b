// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random scenes keep all guarantees of the manual, by a check that shares nothing with that of the package; and the
// check rejects corrupted results.
//   test_properties SEED        repeats one case
//   test_properties SEED COUNT  as many cases, from SEED on

#include "testing/change_table.h"
#include "testing/guarantees.h"
#include "testing/property_case.h"
#include "testing/same_result.h"
#include "testing/test_support.h"

#include <cstdlib>

BOOST_AUTO_TEST_SUITE(test_properties)

using Data = Shapes::Data;
using Violations = std::vector<std::string>;

// What the cases cover.
struct Totals {
  std::size_t cases = 0, too_wide = 0, points = 0, assigned = 0, shapes = 0, coplanar = 0, orthogonal = 0;

  void add(const Shapes& s)
  {
    points += s.number_of_points();
    assigned += s.statistics().number_of_assigned_points;
    shapes += s.number_of_shapes();
    coplanar += s.number_of_shapes() - s.number_of_coplanar_groups();
    orthogonal += s.orthogonal_groups().size();
  }
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
         (given.minimum_region_size == 0 || used.minimum_region_size == given.minimum_region_size) &&
         used.maximum_angle == given.maximum_angle && used.k_neighbors == given.k_neighbors &&
         used.simplicity == given.simplicity && used.regularity == given.regularity;
}

Violations violations_of(const Property_case& c, Totals& totals)
{
  using Parallel = CGAL::Parallel_if_available_tag;
  const Cloud before = c.cloud;
  const Shapes shapes = detect(c.cloud, c.parameters, c.given);
  totals.add(shapes);
  check_valid(c.cloud, shapes, c.name, c.given);
  Violations violations = guarantees::Checker(c.cloud, c.given, shapes).violations();
  if(!has_parameters(shapes, c.parameters))
    violations.push_back("parameters: others were used than were given");
  violations.push_back(difference(shapes, detect<Parallel>(c.cloud, c.parameters, c.given)));
  if(std::memcmp(before.data(), c.cloud.data(), before.size() * sizeof before[0]) != 0)
    violations.push_back("constant input: the range has changed");
  Cloud shuffled = c.cloud;
  shuffle(shuffled, c.cloud.size());
  const Shapes of_shuffled = detect<Parallel>(shuffled, c.parameters, c.given);
  violations.push_back(difference({c.cloud, shapes}, {shuffled, of_shuffled}, c.given));
  violations.erase(std::remove(violations.begin(), violations.end(), ""), violations.end());
  return violations;
}

void test_case(std::uint64_t seed, Totals& totals, bool is_shown)
{
  const Property_case c = Case_maker(seed).make();
  if(is_shown)
    std::cout << c.name << std::endl;
  ++totals.cases;
  try {
    const Violations violations = violations_of(c, totals);
    CHECK_AT(violations.empty(), c.name + ": " + std::to_string(violations.size()) + " violations, " +
                                   (violations.empty() ? "" : violations.front()));
  } catch(const std::range_error& e) {
    ++totals.too_wide;
    CHECK_AT(is_too_wide(c), c.name + ": " + e.what());
  } catch(const std::exception& e) {
    CHECK_AT(false, c.name + ": " + e.what());
  }
}

void test_cases(std::uint64_t first, std::uint64_t count)
{
  Totals totals;
  for(std::uint64_t seed = first; seed < first + count; ++seed)
    test_case(seed, totals, count == 1);
  std::cout << totals.cases << " cases, " << totals.too_wide << " too wide; " << totals.points << " points, "
            << totals.assigned << " assigned to " << totals.shapes << " shapes, " << totals.coplanar
            << " of them in the plane of another one; " << totals.orthogonal << " orthogonal pairs" << std::endl;
  CHECK(count == 1 || totals.shapes > 0);
}

// Results that break one guarantee each, by the least that can be.
class Corruptions {
public:
  explicit Corruptions(Given given)
    : given_(given), cloud_(make_cloud()), shapes_(detect(cloud_, points_only(.05, 100), given))
  {
    check_counts("four squares", shapes_, 4, 2, 3);
    CHECK(shapes_.orthogonal_groups().size() == 1);
    CHECK(guarantees::Checker(cloud_, given, shapes_).violations().empty());
  }

  // corrupt(Cloud&, Data&): a violation has to begin with the words. The others are consequences.
  template <class F>
  void check_rejected(const char* name, const std::string& words, F corrupt) const
  {
    Cloud cloud = cloud_;
    Data data = shapes_.data();
    corrupt(cloud, data);
    const Violations violations = guarantees::Checker(cloud, given_, Shapes(data)).violations();
    CHECK_AT(std::any_of(violations.begin(), violations.end(),
                         [&](const std::string& v) { return v.compare(0, words.size(), words) == 0; }),
             std::string(name) + ": " + std::to_string(violations.size()) + " violations, none of " + words);
  }

  // corrupt(Data&): the result is not the same any more.
  template <class F>
  void check_different(const char* name, F corrupt) const
  {
    Data data = shapes_.data();
    corrupt(data);
    const Shapes other(data);
    CHECK_AT(difference(shapes_, other) != "", name);
    CHECK_AT(difference({cloud_, shapes_}, {cloud_, other}, given_) != "", std::string(name) + ", in any order");
  }

  // The first point of a shape.
  std::size_t point_of(int s) const { return shapes_.points(std::size_t(s))[0]; }

  // The shapes of a group that has two; the first is the smaller one.
  std::pair<std::size_t, std::size_t> coplanar_pair() const
  {
    for(std::size_t s = 0; s < shapes_.number_of_shapes(); ++s)
      for(std::size_t t = 0; t < s; ++t)
        if(shapes_.are_coplanar(s, t))
          return {t, s};
    return {0, 0};
  }

  // The largest distance of a point of shape s, in double.
  double farthest(std::size_t s) const
  {
    double distance = 0;
    const auto& c = shapes_.coefficients(s);
    for(std::size_t i : shapes_.points(s)) {
      const auto& p = cloud_[i].first;
      distance = (std::max)(distance, c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3]);
    }
    return distance;
  }

  const Shapes& shapes() const { return shapes_; }

private:
  // Squares of 20 x 20 points: two in one plane and apart, one parallel to them, one orthogonal; and some free points.
  static Cloud make_cloud()
  {
    Cloud cloud;
    scenes::Random random(1);
    for(int i = 0; i < 400; ++i) {
      const double a = .1 * (i % 20), b = .1 * (i / 20), noise = .02 * random.uniform();
      cloud.emplace_back(Kernel::Point_3(a, b, noise), Kernel::Vector_3(0, 0, 1));
      cloud.emplace_back(Kernel::Point_3(a + 4, b, noise), Kernel::Vector_3(0, 0, 1));
      cloud.emplace_back(Kernel::Point_3(a, b, noise + 4), Kernel::Vector_3(0, 0, 1));
      cloud.emplace_back(Kernel::Point_3(noise - 4, a, b), Kernel::Vector_3(1, 0, 0));
      if(i % 20 == 0)
        cloud.emplace_back(Kernel::Point_3(a, b - 5, a + 9), Kernel::Vector_3(0, 1, 0));
    }
    return cloud;
  }

  Given given_;
  Cloud cloud_;
  Shapes shapes_;
};

using Labels = std::vector<std::int32_t>;

void test_corrupted_points(const Corruptions& c)
{
  const std::size_t i = c.point_of(0);
  const auto set_label = [i](int label) {
    return [i, label](Cloud&, Data& d) { change_table(d.shape_of, [&](Labels& l) { l[i] = label; }); };
  };
  c.check_rejected("label too large", "partition", set_label(4));
  c.check_rejected("label below -1", "partition", set_label(-2));
  int other = 1;
  while(c.shapes().are_coplanar(0, std::size_t(other)))
    ++other;
  c.check_rejected("another shape", "fidelity", set_label(other));
  c.check_rejected("freed behind the statistics", "statistics", set_label(-1));
  c.check_rejected("indices of another order", "fidelity", [](Cloud& cloud, Data&) { shuffle(cloud, 1); });
  c.check_rejected("indices shifted by one", "fidelity", [](Cloud&, Data& d) {
    change_table(d.shape_of, [](Labels& l) { std::rotate(l.begin(), l.begin() + 1, l.end()); });
  });
  c.check_rejected("point at infinity", "bad data",
                   [i](Cloud& cloud, Data&) { cloud[i].first = Kernel::Point_3(0, 0, HUGE_VAL); });
  c.check_rejected("point moved by the last bits", "fidelity: too far", [&](Cloud& cloud, Data& d) {
    const auto& n = d.coefficients[0];
    const double height = (1 + 1e-12) * (d.parameters.maximum_distance - c.farthest(0));
    for(std::size_t j : c.shapes().points(0))
      cloud[j].first = cloud[j].first + height * Kernel::Vector_3(n[0], n[1], n[2]);
  });
  c.check_rejected("size", "size", [&](Cloud&, Data& d) {
    d.parameters.minimum_region_size = c.shapes().points(0).size();
    change_table(d.shape_of, [&](Labels& l) { l[i] = -1; });
  });
  c.check_rejected("coplanar shapes joined", "connectivity", [&](Cloud&, Data& d) {
    const auto pair = c.coplanar_pair();
    change_table(d.shape_of, [&](Labels& l) { std::replace(l.begin(), l.end(), int(pair.second), int(pair.first)); });
  });
}

// With given normals only.
void test_corrupted_normals(const Corruptions& c)
{
  const std::size_t i = c.point_of(0);
  const auto turned = [&](double degrees) {
    return [i, degrees](Cloud& cloud, Data& d) {
      const auto& n = d.coefficients[0];
      const Kernel::Vector_3 normal(n[0], n[1], n[2]), across = CGAL::cross_product(normal, Kernel::Vector_3(1, 2, 3));
      const double angle = degrees * 3.14159265358979324 / 180;
      cloud[i].second = std::cos(angle) * normal + std::sin(angle) / std::sqrt(across.squared_length()) * across;
      d.parameters.maximum_angle = 25;
    };
  };
  c.check_rejected("normal turned by the last bits", "fidelity: too oblique", turned(25 * (1 + 1e-12)));
  c.check_rejected("normal within the plane", "fidelity: too oblique", turned(90));
  c.check_rejected("null normal", "bad data", [i](Cloud& cloud, Data&) { cloud[i].second = CGAL::NULL_VECTOR; });
}

void test_corrupted_planes(const Corruptions& c)
{
  const auto pair = c.coplanar_pair();
  const auto last_bit = [](double& x) { x = std::nextafter(x, 2.); };
  c.check_rejected("last bit of an offset", "exact relations: not coplanar",
                   [&](Cloud&, Data& d) { last_bit(d.coefficients[pair.second][3]); });
  c.check_rejected("last bit of a normal", "exact relations: not parallel",
                   [&](Cloud&, Data& d) { last_bit(d.coefficients[pair.second][0]); });
  c.check_rejected("opposite plane", "exact relations: not parallel", [&](Cloud&, Data& d) {
    for(double& x : d.coefficients[pair.second])
      x = -x;
  });
  c.check_rejected("orthogonal planes turned", "exact relations: not orthogonal", [](Cloud&, Data& d) {
    for(auto& n : d.coefficients)
      if(std::fabs(n[0]) > .5)
        n[2] += 2e-15;
  });
  c.check_rejected("normal that is not unit", "exact relations: no unit", [](Cloud&, Data& d) {
    for(double& x : d.coefficients[0])
      x *= 1 + 1e-14;
  });
  c.check_rejected("group without a number", "exact relations: parallel groups",
                   [](Cloud&, Data& d) { ++d.statistics.number_of_directions; });
  c.check_different("last bit of an offset", [&](Data& d) { last_bit(d.coefficients[0][3]); });
  c.check_different("one label", [&](Data& d) { change_table(d.shape_of, [&](Labels& l) { l[c.point_of(0)] = -1; }); });
  c.check_different("one pair", [](Data& d) { d.orthogonal_groups.pop_back(); });
  c.check_different("orientation", [](Data& d) { d.is_flipped[0] = !d.is_flipped[0]; });
  c.check_different("rounds", [](Data& d) { ++d.statistics.number_of_rounds; });
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  const std::uint64_t seed = argument(1, 1);
  const std::uint64_t count = argument(2, argument(1, 0) > 0 ? 1 : 400);
  for(Given given : {Given::normals, Given::nothing}) {
    const Corruptions corruptions(given);
    test_corrupted_points(corruptions);
    test_corrupted_planes(corruptions);
    if(given == Given::normals)
      test_corrupted_normals(corruptions);
    else
      corruptions.check_different("estimated normal", [](Data& d) {
        change_table(d.normal, [](std::vector<std::uint32_t>& normals) { normals[7] ^= 1; });
      });
  }
  test_cases(seed, count);
}

BOOST_AUTO_TEST_SUITE_END()
