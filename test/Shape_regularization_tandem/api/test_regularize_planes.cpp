// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// regularize_planes() on planes that were found elsewhere: a noisy, turned box,
// with the interface of CGAL's function of the same name.

#include "api_support.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Shape_regularization_tandem/regularize_planes.h>

BOOST_AUTO_TEST_SUITE(test_regularize_planes)

using CGAL::Tandem::Plane_relations;
using Coefficients = CGAL::Tandem::Coefficients;
using scenes::Vec;

template <class K>
struct Scene {
  std::vector<typename K::Point_3> points;
  std::vector<typename K::Plane_3> planes;
  std::vector<int> index;

  auto index_map() const { return CGAL::make_property_map(index.data()); }
};

using V = std::array<double, 3>;

double dot(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The faces of a box of extent 10, moved by `far`, and two halves of a seventh face
// parallel to the last one. Points have noise; given planes are off by up to two degrees.
template <class K>
Scene<K> make_box(int seed, double noise, double far = 0)
{
  using RT = typename K::RT;
  scenes::Random random(std::uint64_t(seed) + 1);
  const auto uniform = [&] { return 2 * random.uniform() - 1; };
  const auto frame = scenes::Frame().turned(random.direction(), .7);
  const Vec axis[] = {frame.x, frame.y, frame.z, frame.x, frame.y}, shift = {far, far, far};
  Scene<K> s;
  for(int f = 0; f < 8; ++f) {
    const Vec* const axes = axis + (std::min)(f / 2, 2); // the normal first
    const double offset = f < 6 ? (f % 2 ? 5 : -5) : 8 + (f == 6 ? .004 : -.004);
    const int n = 500 + 20 * f;
    Vec mean = {0, 0, 0};
    for(int i = 0; i < n; ++i) {
      const double b = f < 6 ? 5 * uniform() : (f == 6 ? 3 : -3) + 2 * uniform();
      const Vec in_plane = add_scaled(5 * uniform() * axes[1], b, axes[2]);
      const Vec p = shift + add_scaled(in_plane, offset + noise * random.gaussian(), axes[0]);
      mean = add_scaled(mean, 1. / n, p);
      s.points.push_back(typename K::Point_3(p.x, p.y, p.z));
      s.index.push_back(f);
    }
    const double u = .02 * uniform(), v = .02 * uniform();
    const Vec tilted = (f % 3 ? 1. : -1.) * add_scaled(add_scaled(axes[0], u, axes[1]), v, axes[2]);
    s.planes.push_back(typename K::Plane_3(RT(tilted.x), RT(tilted.y), RT(tilted.z), RT(-dot(tilted, mean))));
  }
  for(int i = 0; i < 50; ++i) { // clutter
    s.points.push_back({far + 9 * uniform(), far + 9 * uniform(), far + 9 * uniform()});
    s.index.push_back(-1);
  }
  return s;
}

using Box_scene = Scene<Kernel>;

struct Options {
  double maximum_angle = 8, maximum_offset = .05;
  bool parallelism = true, orthogonality = true, coplanarity = true;
};

struct Result : Plane_relations {
  std::vector<Coefficients> planes;
};

template <class Plane_3>
std::vector<Coefficients> coefficients_of(const std::vector<Plane_3>& planes)
{
  std::vector<Coefficients> result;
  for(const Plane_3& p : planes)
    result.push_back({CGAL::to_double(p.a()), CGAL::to_double(p.b()), CGAL::to_double(p.c()), CGAL::to_double(p.d())});
  return result;
}

template <class K, class List>
Result result_of(Scene<K> s, const List& list)
{
  const Plane_relations r = CGAL::Tandem::regularize_planes(s.planes, s.points, list);
  return {r, coefficients_of(s.planes)};
}

// By the names that CGAL has.
template <class K>
Result regularized(const Scene<K>& s, const Options& o = Options())
{
  const auto angle = CGAL::parameters::plane_index_map(s.index_map()).maximum_angle(o.maximum_angle);
  const auto parallel = angle.maximum_offset(o.maximum_offset).regularize_parallelism(o.parallelism);
  return result_of(s, parallel.regularize_orthogonality(o.orthogonality).regularize_coplanarity(o.coplanarity));
}

Result regularized_within(const Box_scene& s, double distance, const Options& o = Options(), double regularity = .1)
{
  const auto list = np::plane_index_map(s.index_map()).maximum_distance(distance).regularity(regularity);
  return result_of(s, list.maximum_angle(o.maximum_angle).maximum_offset(o.maximum_offset));
}

V normal_of(const Coefficients& c) { return {c[0], c[1], c[2]}; }

void check_groups(const Plane_relations& r, std::size_t directions, std::size_t planes, const std::string& what)
{
  check_equal(r.number_of_parallel_groups(), directions, what + ": directions");
  check_equal(r.number_of_coplanar_groups(), planes, what + ": planes");
}

template <class K>
void check_box(const std::string& kernel, int seeds, double exactness, double far = 0)
{
  const double noise = .01;
  for(int seed = 0; seed < seeds; ++seed) {
    const Scene<K> s = make_box<K>(seed, noise, far);
    const std::vector<Coefficients> old = coefficients_of(s.planes);
    const Result r = regularized(s);
    const std::string what = kernel + ", box " + std::to_string(seed);
    check_groups(r, 3, 7, what);
    CHECK_AT(r.maximum_distance > noise && r.maximum_distance < .2, what + ": estimate");
    CHECK_AT(r.orthogonal_groups.size() == 3 && r.coplanar_group[6] == r.coplanar_group[7], what);
    CHECK_AT(std::fabs(r.planes[6][3]) == std::fabs(r.planes[7][3]), what);
    for(std::size_t i = 0; i < 8; ++i) {
      const std::string plane = what + ", plane " + std::to_string(i);
      const V a = normal_of(r.planes[i]);
      CHECK_AT(std::fabs(dot(a, a) - 1) <= exactness, plane);
      CHECK_AT(dot(a, normal_of(old[i])) > 0, plane + ": keeps its orientation");
      CHECK_AT(r.angle[i] < 3 && r.largest_distance[i] < 6 * noise + .02, plane + ": motion");
      CHECK_AT(r.is_changed[i] && !r.is_rolled_back[i], plane);
      for(std::size_t j = 0; j < i; ++j) {
        const V b = normal_of(r.planes[j]), minus = {-b[0], -b[1], -b[2]};
        const bool is_parallel = r.parallel_group[i] == r.parallel_group[j];
        CHECK_AT(is_parallel ? a == b || a == minus : std::fabs(dot(a, b)) <= exactness,
                 plane + " and " + std::to_string(j));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(test_kernels)
{
  check_box<Kernel>("double", 10, 1e-15);
  check_box<Kernel>("double, far away", 3, 1e-15, 4.5e5);
  check_box<CGAL::Exact_predicates_exact_constructions_kernel>("exact", 1, 1e-15);
  check_box<CGAL::Simple_cartesian<float>>("float", 3, 2e-7);
}

BOOST_AUTO_TEST_CASE(test_switches)
{
  const Box_scene s = make_box<Kernel>(1, .005);
  CHECK(regularized(s, {8, .05, true, false, true}).orthogonal_groups.empty());
  CHECK(regularized(s, {8, .05, true, true, false}).number_of_coplanar_groups() == 8);
  CHECK(regularized(s, {8, .05, false, false, true}).number_of_parallel_groups() == 8);
  for(bool is_changed : regularized(s, {8, .05, false, false, false}).is_changed)
    CHECK(!is_changed);
  CHECK(regularized(s, {8, .05, false, true, true}).orthogonal_groups.size() >= 3);
  check_groups(regularized_within(s, .1, {}, 0), 8, 8, "relations are worth nothing");
  Box_scene far = s; // with a point of no plane
  far.points.push_back({1e9, 0, 0});
  far.index.push_back(-1);
  const Result within = regularized_within(far, .1);
  check_groups(within, 3, 7, "a point far away");
  check_equal(within.maximum_distance, .1, "given maximum_distance");
}

// The points of a plane decide, in any order, wherever the plane was said to be.
BOOST_AUTO_TEST_CASE(test_order_of_points)
{
  Box_scene s = make_box<Kernel>(4, .01), t = s;
  std::shuffle(t.points.begin(), t.points.end(), std::mt19937(1));
  std::shuffle(t.index.begin(), t.index.end(), std::mt19937(1)); // in the same way
  CHECK(regularized(t).planes == regularized(s).planes);
  for(double far : {1e8, 1e30, 1e308}) {
    s.planes[7] = Kernel::Plane_3(s.planes[7].a(), s.planes[7].b(), s.planes[7].c(), far);
    check_groups(regularized(s), 3, 7, "a plane at " + std::to_string(far));
  }
}

BOOST_AUTO_TEST_CASE(test_bad_input)
{
  Box_scene s = make_box<Kernel>(3, .01);
  s.planes.push_back({0, 0, 1, -20}); // no points
  s.planes.push_back({0, 0, 0, 1});   // no normal
  s.planes.push_back({0, 1, 0, 0});   // collinear points
  for(int i = 0; i < 9; ++i) {
    s.points.push_back({double(i), 0, 0});
    s.index.push_back(10);
  }
  s.points.push_back({not_a_number, 0, 0});
  s.index.push_back(0);
  const Result r = regularized(s, {25, .05});
  for(std::size_t i = 8; i < 11; ++i)
    CHECK_AT(r.planes[i] == coefficients_of(s.planes)[i] && !r.is_changed[i], std::to_string(i));
  check_equal(r.number_of_parallel_groups(), 6u, "directions with bad planes");
  Box_scene no_points;
  CHECK(regularized(no_points).parallel_group.empty());
  no_points.planes = s.planes;
  CHECK(regularized(no_points).parallel_group.size() == 11);

  const auto refuse = [&](const char* name, const Options& o, double distance = .1, double regularity = .1) {
    CHECK_REFUSED(regularized_within(s, distance, o, regularity), name);
  };
  refuse("maximum_angle", {45, .05});
  refuse("maximum_angle", {-1, .05});
  refuse("maximum_offset", {8, -1});
  refuse("maximum_distance", {}, not_a_number);
  for(const double wrong : {-1., not_a_number, 1e9})
    refuse("regularity is ", {}, .1, wrong);
  s.index[7] = 11;
  refuse("plane_index_map", {});
}

// A tolerance beyond the extent of the points is as good as one of that extent.
BOOST_AUTO_TEST_CASE(test_large_tolerances)
{
  const Box_scene s = make_box<Kernel>(3, .01);
  const Result expected = regularized(s, {8, 100}); // the box has a diameter of 20
  check_groups(expected, 3, 3, "offset 100");
  for(double large : {1e3, 1e100, 1e270}) {
    const Result offset = regularized(s, {8, large}), distance = regularized_within(s, large, {8, 100});
    CHECK_AT(offset.planes == expected.planes && distance.planes == expected.planes, std::to_string(large));
    CHECK_AT(offset.coplanar_group == expected.coplanar_group, std::to_string(large));
    // Opposite faces stay apart where their points are to be close to their planes.
    check_groups(regularized_within(s, .05, {8, large}), 3, 7, "points nearby");
  }
}

// Planes and points inside of other types, and all defaults.
BOOST_AUTO_TEST_CASE(test_maps)
{
  const Box_scene s = make_box<Kernel>(6, .01);
  std::vector<std::pair<int, Kernel::Plane_3>> planes;
  Cloud points;
  for(const auto& p : s.planes)
    planes.push_back({0, p});
  for(const auto& p : s.points)
    points.push_back({p, {0, 0, 0}});
  CGAL::Tandem::regularize_planes(planes, points,
                                  positions.plane_index_map(s.index_map())
                                    .plane_map(CGAL::Second_of_pair_property_map<std::pair<int, Kernel::Plane_3>>()));
  const Result expected = regularized(s, {25, .01});
  for(std::size_t i = 0; i < planes.size(); ++i)
    CHECK_AT(coefficients_of<Kernel::Plane_3>({planes[i].second})[0] == expected.planes[i], std::to_string(i));
}

// Planes that are orthogonal before get unit normals, too, of any length; one that is related to nothing stays.
BOOST_AUTO_TEST_CASE(test_unit_normals)
{
  Box_scene s;
  s.planes = {{0, 0, 2, 0}, {-3e-200, 0, 0, 0}, {1, 2, 4, 0}};
  for(int i = 0; i < 300; ++i) {
    const double u = i % 10, v = i / 10 % 10;
    const Kernel::Point_3 points[3] = {{u, v, 0}, {0, u, v}, {2 * u, v, -u / 2 - v / 2}};
    s.points.push_back(points[i / 100]);
    s.index.push_back(i / 100);
  }
  const Result r = regularized(s, {1, .01});
  CHECK(r.planes == (std::vector<Coefficients>{{0, 0, 1, 0}, {-1, 0, 0, 0}, {1, 2, 4, 0}}));
  CHECK(r.orthogonal_groups.size() == 1 && r.is_changed[0] && r.is_changed[1] && !r.is_changed[2]);
}

BOOST_AUTO_TEST_SUITE_END()
