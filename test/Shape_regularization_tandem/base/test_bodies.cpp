// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arithmetic below all decisions, against long double and brute force: packed
// normals, the predicate fits(), levels of tolerances, moments, fits, eigenvectors.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/engine/make_stage_parameters.h>

#include <Eigen/Dense>

BOOST_AUTO_TEST_SUITE(test_bodies)

using namespace CGAL::Tandem::internal;
using scenes::Random;

Plane random_plane(Random& random, const Grid_point& through)
{
  const scenes::Vec n = random.direction();
  return make_plane({n.x, n.y, n.z}, {double(through.x), double(through.y), double(through.z)});
}

std::string text(const Vector& v)
{
  return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z);
}

void check_packing(const Vector& n)
{
  const std::uint32_t code = encode_normal(n);
  const Int_vector m = decode_normal(code), o = decode_normal(encode_normal(-n));
  const Vector d = unit({double(m.x), double(m.y), double(m.z)});
  // 16 bits in an octahedron: half a step of 2^-15 an axis, stretched by up to 3.
  CHECK_AT(length(cross(d, unit(n))) < tuning::exactness::packing_margin_deg * .0174 && dot(d, n) > 0,
           text(n) + " becomes " + text(d));
  CHECK_AT(o.x == -m.x && o.y == -m.y && o.z == -m.z, "the opposite of " + text(n));
  CHECK_AT(code != no_normal, text(n));
}

BOOST_AUTO_TEST_CASE(packed_normals)
{
  Random random(1);
  for(int i = 0; i < 20000; ++i) {
    const scenes::Vec n = random.direction();
    check_packing({n.x, n.y, n.z});
    check_packing({n.x * 1e-30, n.y * 1e-30, n.z * 1e-30}); // any length
    check_packing({n.x, n.y, n.z * 1e-7});                  // at the border
  }
  for(int x = -3; x <= 3; ++x)
    for(int y = -3; y <= 3; ++y)
      for(int z = -3; z <= 3; ++z)
        if(x != 0 || y != 0 || z != 0)
          check_packing({double(x), double(y), double(z)});
  check_packing({-0., -1, -0.});
  check_packing({1, -0., -1e-300});
  CHECK(encode_normal({0, 0, 0}) == no_normal);
  CHECK(encode_normal({0, std::nan(""), 1}) == no_normal);
  CHECK(decode_normal(no_normal).x == 0 && decode_normal(no_normal).y == 0 && decode_normal(no_normal).z == 0);
}

// Where long double says clearly yes or no, the integers have to agree.
BOOST_AUTO_TEST_CASE(predicate)
{
  Random random(2);
  int near = 0, aligned = 0;
  for(int i = 0; i < 50000; ++i) {
    const int bits = 8 + int(random.bits() % 22);
    const Grid_point p = random_point(random, bits), q = random_point(random, bits);
    const Plane s = random_plane(random, q);
    using Exact = Eigen::Matrix<long double, 3, 1>;
    const Int_vector m = decode_normal(p.normal);
    const Exact n(s.nx, s.ny, s.nz), of_point(m.x, m.y, m.z);
    const long double size = n.norm(), cosine = std::fabs(n.dot(of_point)) / size / of_point.norm();
    CHECK_AT(std::fabs(size / (long double)(normal_scale)-1) < 1e-8L, "plane " + std::to_string(i));
    const long double e = n.dot(Exact(p.x, p.y, p.z)) + (long double)(s.d);
    CHECK_AT(e == (long double)(signed_distance(s, p)), "point " + std::to_string(i));
    const double degrees = 1 + 88 * random.uniform(), distance = std::ldexp(random.uniform(), bits);
    const Tolerance t = make_tolerance(distance, cosine_deg(degrees));
    const bool is_aligned_here = cosine >= std::cos((long double)(degrees)*3.14159265358979323846L / 180);
    if(std::fabs(cosine * cosine - (long double)(t.squared_cosine) / 4294967296.L) > 1e-7L)
      CHECK_AT(is_aligned(s, p, t.squared_cosine) == is_aligned_here, "angle of point " + std::to_string(i));
    CHECK_AT(is_near(s, p, t.distance) == (std::fabs(e) <= (long double)(t.distance)),
             "distance of point " + std::to_string(i));
    near += is_near(s, p, t.distance);
    aligned += is_aligned(s, p, t.squared_cosine);
  }
  CHECK(near > 5000 && near < 45000 && aligned > 5000 && aligned < 45000); // both answers are tested
}

// Both bounds belong to the shape.
BOOST_AUTO_TEST_CASE(bounds_are_inclusive)
{
  const Plane flat = make_plane({0, 0, 1}, {0, 0, 0});
  const Tolerance t = make_tolerance(100, cosine_deg(60));
  const std::uint32_t up = encode_normal({0, 0, 1}), down = encode_normal({0, 0, -1});
  for(std::int32_t z : {100, -100, 101, -101})
    for(std::uint32_t normal : {up, down, no_normal})
      CHECK_AT(fits(flat, {5, -7, z, normal}, t) == (std::abs(z) == 100 && normal != no_normal), std::to_string(z));
}

// Never above the tolerance, nor far below it, and the smallest level.
void check_level(double tolerance, double epsilon)
{
  const std::string of = std::to_string(tolerance / epsilon) + " of " + std::to_string(epsilon);
  const std::uint8_t level = level_of(tolerance, epsilon);
  const double rounded = epsilon * level_factor(level);
  CHECK_AT(rounded <= tolerance, of);
  if(tolerance >= epsilon)
    check_equal(int(level), 0, of);
  else if(tolerance > epsilon * 1e-9)
    CHECK_AT(tolerance < rounded * std::exp2(.1251), of);
  CHECK_AT(level == 0 || epsilon * level_factor(std::uint8_t(level - 1)) > tolerance, of);
}

BOOST_AUTO_TEST_CASE(levels)
{
  Random random(5);
  for(int i = 0; i < 20000; ++i)
    check_level(std::exp2(40 * random.uniform() - 38), i % 3 == 0 ? 1 : std::exp2(30 * random.uniform() - 15));
  for(int octave = 0; octave < 32; ++octave)
    for(double factor : {1., std::nextafter(1., 0.), std::nextafter(1., 2.)})
      check_level(factor * std::ldexp(.3, -octave), .3);
  for(double tolerance : {1e-300, 1e-320, HUGE_VAL})
    check_level(tolerance, .01);
  check_equal(level_factor(no_level), 0., "below all levels");
}

// Their integer squares, and the tolerance of a test.
BOOST_AUTO_TEST_CASE(factors_of_levels)
{
  for(int level = 0; level < no_level; ++level) {
    const double factor = level_factor(std::uint8_t(level));
    CHECK_AT(std::fabs(factor - std::exp2(-level / 8.)) <= 1e-15 * factor, std::to_string(level));
    const double square = double(squared_level(std::uint8_t(level))) / double(squared_level_unit);
    CHECK_AT(square >= 1 / double(squared_level_unit) && std::fabs(square - factor * factor) < 2e-7,
             std::to_string(level));
  }
  const Tolerance most = {1000 << 20, 77, -3};
  check_equal(most.at(0).distance, most.distance, "of level 0");
  check_equal(most.at(8).distance + 3, (most.distance + 3) / 2, "of level 8");
  check_equal(most.at(no_level).distance, std::int64_t(1) - 3, "of no level");
  check_equal(most.at(8).squared_cosine, most.squared_cosine, "the angle of level 8");
}

// The same sums three ways: in grid coordinates, relative to a point, and by words
// with their carry, where points are also taken out again.
template <class Backend>
void check_moments()
{
  Random random(3);
  for(int bits : {3, 12, 23, 28, 29})
    for(int round = 0; round < 20; ++round) {
      const Grid_point base = random_point(random, bits);
      Moments whole, left;
      Shared_moments shared;
      Box box;
      const int part_bits = (std::min)(bits, 20);
      for(int part = 0; part < 6; ++part) {
        Cell_moments cell;
        Box part_box;
        for(int i = 0; i < 200; ++i) {
          Grid_point p = random_point(random, part_bits);
          p.x += base.x / 2, p.y += base.y / 2, p.z += base.z / 2;
          const int sign = part < 4 ? 1 : -1; // the last two take away more than there is
          whole.add(p, sign);
          part_box.add(p);
          cell.add(std::int64_t(p.x) - base.x / 2, std::int64_t(p.y) - base.y / 2, std::int64_t(p.z) - base.z / 2,
                   sign);
        }
        const Moments moved = shifted(cell, base.x / 2, base.y / 2, base.z / 2);
        left += moved;
        atomic_add<Backend>(shared, moved, part_box);
        box.add(part_box);
        const std::string where =
          std::string(Backend::name()) + ", " + std::to_string(bits) + " bits, part " + std::to_string(part);
        CHECK_AT(are_equal(left, whole), where + ": shifted");
        CHECK_AT(are_equal(shared.moments(), whole), where + ": shared");
        CHECK_AT(std::equal(box.low, box.low + 3, shared.box.low) &&
                   std::equal(box.high, box.high + 3, shared.box.high),
                 where);
      }
    }
}

BOOST_AUTO_TEST_CASE(moments)
{
  check_moments<Sequential_backend>();
#ifdef CGAL_LINKED_WITH_TBB
  check_moments<Tbb_backend>();
#endif
}

// The carry from the low to the high word, both ways.
BOOST_AUTO_TEST_CASE(carry)
{
  const Int128 low = Int128(1) << 63, high = Int128(1) << 64, higher = (Int128(1) << 100) + 5;
  const Int128 values[] = {0, 1, -1, high - 1, high, -high, higher, -higher, low, -low};
  for(const Int128& a : values)
    for(const Int128& b : values) {
      Shared_moments shared;
      Moments m;
      for(const Int128& v : {a, b, b, Int128(-a)}) {
        std::fill(m.product, m.product + 6, v);
        atomic_add<Sequential_backend>(shared, m, Box());
      }
      for(int i = 0; i < 6; ++i)
        CHECK_AT(shared.moments().product[i] == 2 * b, "product " + std::to_string(i));
    }
}

// Scatter and plane of points far from the origin, against long double about the centroid.
BOOST_AUTO_TEST_CASE(fitted_plane)
{
  Random random(4);
  for(int bits : {6, 16, 24, 28}) {
    const Grid_point far = random_point(random, 28);
    std::vector<Grid_point> points;
    Moments m;
    const scenes::Vec n = random.direction(), u = unit(cross(n, scenes::Vec{n.y, n.z, -n.x})), v = cross(n, u);
    for(int i = 0; i < 500; ++i) {
      const double a = std::ldexp(random.uniform(), bits), b = std::ldexp(random.uniform(), bits),
                   c = 3 * random.gaussian();
      const scenes::Vec p = a * u + b * v + c * n;
      points.push_back({far.x + std::int32_t(p.x), far.y + std::int32_t(p.y), far.z + std::int32_t(p.z), 0});
      m.add(points.back());
    }
    using Exact = Eigen::Matrix<long double, 3, 1>;
    const auto exact = [](const Grid_point& p) { return Exact(p.x, p.y, p.z); };
    Exact mean = Exact::Zero();
    Eigen::Matrix<long double, 3, 3> expected = Eigen::Matrix<long double, 3, 3>::Zero();
    for(const Grid_point& p : points)
      mean += exact(p) / 500;
    for(const Grid_point& p : points)
      expected += (exact(p) - mean) * (exact(p) - mean).transpose();
    const Scatter scatter = make_scatter(m);
    const Symmetric_matrix& x = scatter.matrix;
    const double got[6] = {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz};
    for(int i = 0, k = 0; i < 3; ++i)
      for(int j = i; j < 3; ++j, ++k)
        CHECK_AT(std::fabs((long double)(got[k]) - expected(i, j)) <= 1e-13L * expected.trace(),
                 std::to_string(bits) + " bits, entry " + std::to_string(k));
    CHECK_AT(std::fabs((long double)(scatter.centroid.x) - mean[0]) < 1e-6L, std::to_string(bits) + " bits, centroid");
    const Vector normal = fit_plane(scatter).normal;
    CHECK_AT(bits == 6 || std::fabs(dot(normal, {n.x, n.y, n.z})) > 1 - 1e-6,
             std::to_string(bits) + " bits: " + text(normal));
  }
}

void check_eigen_system(const Symmetric_matrix& m, const std::string& name)
{
  Eigen::Matrix3d e;
  e << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  const Eigen::Vector3d expected = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(e).eigenvalues();
  const Eigen_system system = eigen_system(m);
  const double size = (std::max)(e.norm(), 1e-300);
  for(int i = 0; i < 3; ++i) {
    const Vector& v = system.vector[i];
    CHECK_AT(std::fabs(system.value[i] - expected[i]) <= 2e-15 * size, name + ", value " + std::to_string(i));
    CHECK_AT(i == 0 || system.value[i - 1] <= system.value[i], name + ": the values are not sorted");
    CHECK_AT(length(m * v - system.value[i] * v) <= 4e-15 * size,
             name + ", vector " + std::to_string(i) + " is " + text(v));
    for(int j = 0; j <= i; ++j)
      CHECK_AT(std::fabs(dot(v, system.vector[j]) - (i == j)) < 4e-15, name + ": the vectors are not orthonormal");
    if(expected[i] < 1e-6 * size || expected[i] < 1e-200)
      continue;
    CHECK_AT(!has_eigenvalues_above(m, 1.001 * expected[i]), name + ", above value " + std::to_string(i));
    CHECK_AT(i > 0 || has_eigenvalues_above(m, .999 * expected[i]), name + ", all are above");
  }
}

BOOST_AUTO_TEST_CASE(eigen_systems)
{
  Random random(5);
  for(int i = 0; i < 3000; ++i) {
    Symmetric_matrix m = {0, 0, 0, 0, 0, 0};
    const int rank = 1 + int(random.bits() % 5);
    const double flat = std::ldexp(1, -int(random.bits() % 40));
    for(int r = 0; r < rank; ++r) {
      const scenes::Vec a = random.direction();
      const Vector v = {a.x, a.y, flat * a.z};
      m = m + Symmetric_matrix{v.x * v.x, v.x * v.y, v.x * v.z, v.y * v.y, v.y * v.z, v.z * v.z};
    }
    check_eigen_system(m, "matrix " + std::to_string(i) + " of rank " + std::to_string(rank));
  }
  check_eigen_system({0, 0, 0, 0, 0, 0}, "null matrix");
  CHECK(!has_eigenvalues_above({0, 0, 0, 0, 0, 0}, 0));
  check_eigen_system({1e30, 0, 0, 1e30, 0, 1e30}, "isotropic matrix");
  check_eigen_system({2, 0, 0, 1, 0, 3}, "diagonal matrix");
  check_eigen_system({1, 1, 1, 1, 1, 1}, "matrix of ones");
  check_eigen_system({1e20, 1, 0, 1e-20, 0, 1}, "graded matrix");
}

BOOST_AUTO_TEST_SUITE_END()
