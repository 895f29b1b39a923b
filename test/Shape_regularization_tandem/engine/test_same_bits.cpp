// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same bits from every compiler, with any of its options, and in any rounding mode of the caller: shapes and
// estimated normals of generated clouds have the hashes below. They change with the method only. The clouds need
// nothing but integers and exact products, so they are the same everywhere, too.

#include "testing/checks.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cfenv>
#include <cstring>
#include <random>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_same_bits)

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
namespace np = CGAL::Tandem::parameters;

// Patches of any orientation, with bumps of `noise`, in a cube of unit size. Their neighbors are near, those of stray
// points so far that distances in grid steps are rounded.
std::vector<Point> make_cloud(std::uint32_t seed, int patches, double noise, int strays)
{
  std::mt19937 random(seed);
  const auto number = [&] { return double(random() >> 8) * 0x1p-23 - 1; }; // in [-1, 1)
  std::vector<Point> points;
  for(int patch = 0; patch < patches; ++patch) {
    const double o[3] = {number(), number(), number()};
    const double u[3] = {number(), number(), number()}, v[3] = {number(), number(), number()};
    for(int i = 0; i < 1500; ++i) {
      const double s = .5 * number(), t = .5 * number();
      double p[3];
      for(int c = 0; c < 3; ++c)
        p[c] = double(float(std::fma(s, u[c], std::fma(t, v[c], std::fma(noise, number(), o[c])))));
      points.emplace_back(p[0], p[1], p[2]);
    }
  }
  for(int i = 0; i < strays; ++i) {
    const double p[3] = {number(), number(), number()}; // in this order
    points.emplace_back(1000 * p[0], 1000 * p[1], 1000 * p[2]);
  }
  return points;
}

struct Case {
  std::uint32_t seed;
  int patches;
  double noise;
  int strays;
  std::uint64_t hash;
};

const Case cases[] = {{1, 12, 0, 0, 0xf3728bf5501e9c1e},
                      {2, 12, .002, 0, 0xa8227691137d66d0},
                      {3, 20, .01, 0, 0x71a4c7b5bf1b380b},
                      {4, 6, .02, 0, 0xd0aa75b003423d7c},
                      {5, 4, .002, 20000, 0x5369665ee02fb584}};

template <class Tag>
CGAL::Tandem::Planar_shapes_3<Kernel> detect(const std::vector<Point>& cloud)
{
  return CGAL::Tandem::detect_planes<Tag>(cloud, np::maximum_distance(.01).minimum_region_size(60));
}

// Files hold normals as floats. They are unpacked in a loop that an optimizer vectorizes, as in a program that writes
// them.
void check_floats(const CGAL::Tandem::Planar_shapes_3<Kernel>& shapes)
{
  const auto& code = shapes.data().normal;
  std::vector<CGAL::Tandem::internal::Vector> normals(code.size());
  std::transform(code.begin(), code.end(), normals.begin(), CGAL::Tandem::internal::unpacked_normal);
  for(std::size_t i = 0; i < normals.size(); ++i) {
    const Kernel::Vector_3 n = shapes.estimated_normal(i);
    for(const double x : {normals[i].x, normals[i].y, normals[i].z, n.x(), n.y(), n.z()}) {
      volatile float rounded = float(x);
      CHECK_AT(double(rounded) == x, "normal of point " + std::to_string(i));
    }
  }
}

// Sets the mode of this thread only.
template <class Tag>
void check_mode(const Case& c, const std::vector<Point>& cloud, int mode)
{
  std::fesetround(mode);
  const std::uint64_t hash = detect<Tag>(cloud).hash();
  const int mode_after = std::fegetround();
  std::fesetround(FE_TONEAREST);
  const std::string where = "seed " + std::to_string(c.seed) + ", rounding mode " + std::to_string(mode);
  check_equal(mode_after, mode, where + ": the mode afterwards");
  check_equal(hash, c.hash, where + ": hash");
}

// One mode with each back end for each cloud.
BOOST_AUTO_TEST_CASE(test_hashes)
{
  const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  for(const Case& c : cases) {
    const std::vector<Point> cloud = make_cloud(c.seed, c.patches, c.noise, c.strays);
    const auto shapes = detect<CGAL::Sequential_tag>(cloud);
    check_equal(shapes.hash(), c.hash, "seed " + std::to_string(c.seed) + ": hash");
    check_floats(shapes);
    check_mode<CGAL::Sequential_tag>(c, cloud, modes[c.seed % 3]);
    check_mode<CGAL::Parallel_if_available_tag>(c, cloud, modes[(c.seed + 1) % 3]);
  }
}

BOOST_AUTO_TEST_SUITE_END()
