// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What detections end with. Relations must not lose faces of hardly more than the minimum size, and points that fit a
// shape around them must not be free. A bent floor is cut as the score says, and layers near each other stay apart.
// Planes lie in the middle of their points. Planes through clutter are no shapes: see
// drop_slabs() in result/extract_shapes.h.

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/result/explain_free_points.h>
#include <CGAL/Tandem/internal/rounds/regularize_shapes.h>

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_end_game)

using namespace CGAL::Tandem::internal;

constexpr double epsilon = .02;

// A floor, and small faces over it that are nearly parallel to it: it would take so many of their points that they fall
// below the minimum size.
BOOST_AUTO_TEST_CASE(small_faces)
{
  const std::size_t floor_size = 20000, face_size = 104;
  const int columns = 6;
  const double width = .6, turn = 1.8 * epsilon / width;
  scenes::Random random(1);
  Cloud cloud;
  for(std::size_t i = 0; i < floor_size; ++i)
    cloud.emplace_back(Kernel::Point_3(columns * random.uniform(), columns * random.uniform(), 0),
                       Kernel::Vector_3(0, 0, 1));
  for(int face = 0; face < columns * columns; ++face)
    for(std::size_t i = 0; i < face_size; ++i) {
      const double x = width * random.uniform(), y = width * random.uniform();
      const double z = 10 * epsilon + turn * x + .3 * epsilon * random.gaussian();
      cloud.emplace_back(Kernel::Point_3(face % columns + x, face / columns + y, z), Kernel::Vector_3(-turn, 0, 1));
    }
  const Shapes shapes = detect(cloud, make_parameters(epsilon, 100));
  check_equal(shapes.number_of_shapes(), std::size_t(1 + columns * columns), "a floor and small faces over it");
}

// Each free point is far from the planes of the shapes of its neighbors, or turned away from them. Those that the exact
// check frees, and those of slabs of clutter, may be near.
BOOST_AUTO_TEST_CASE(free_points)
{
  using Point_of = CGAL::Pointer_property_map<Kernel::Point_3>::const_type;
  using Traits = CGAL::Search_traits_adapter<std::size_t, Point_of, CGAL::Search_traits_3<Kernel>>;
  using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;
  const scenes::Scene scene = scenes::make_scene("part", scene_options(50000, .0003, .02));
  const Cloud cloud = to_cloud(scene);
  Parameters parameters = make_parameters(epsilon, 200);
  const Shapes shapes = detect(cloud, parameters);
  std::vector<Kernel::Point_3> point;
  for(const auto& p : cloud)
    point.push_back(p.first);
  std::vector<std::size_t> index(point.size());
  std::iota(index.begin(), index.end(), std::size_t(0));
  const Point_of point_of = CGAL::make_property_map(static_cast<const std::vector<Kernel::Point_3>&>(point));
  Search::Tree tree(index.begin(), index.end(), Search::Splitter(), Traits(point_of));
  const double cosine = CGAL::Tandem::internal::cosine_deg(parameters.maximum_angle);
  std::size_t free = 0, near = 0;
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    if(shapes.shape_index(i) >= 0)
      continue;
    ++free;
    bool is_near = false;
    for(const auto& found : Search(tree, point[i], 13, 0, true, Search::Distance(point_of))) {
      const int s = shapes.shape_index(found.first);
      if(s < 0)
        continue;
      const auto& c = shapes.coefficients(std::size_t(s));
      const Kernel::Vector_3 normal(c[0], c[1], c[2]);
      const double distance = normal * (point[i] - CGAL::ORIGIN) + c[3];
      is_near = is_near || (std::abs(distance) <= .999 * parameters.maximum_distance &&
                            std::abs(normal * cloud[i].second) >= cosine * 1.001);
    }
    near += is_near;
  }
  CHECK_AT(free > 0 && 300 * near <= free,
           std::to_string(near) + " of " + std::to_string(free) + " free points fit the shape of a neighbor");
}

constexpr double width = 6; // of floors

// A floor, with noise; z and the slope dz/dx are functions of x in [-1, 1]. Slopes are those of the full width.
template <class Height, class Slope>
void add_floor(Cloud& cloud, std::size_t points, double noise, Height height, Slope slope)
{
  scenes::Random random(points);
  for(std::size_t i = 0; i < points; ++i) {
    const double x = 2 * random.uniform() - 1, y = 2 * random.uniform() - 1;
    const double dz = 2 / width * slope(x), length = std::sqrt(1 + dz * dz);
    cloud.emplace_back(Kernel::Point_3(x * width / 2, y * width / 2, height(x) + noise * random.gaussian()),
                       Kernel::Vector_3(-dz / length, 0, 1 / length));
  }
}

// n equal pieces of a parabola lose 4 / 45 (sag / n^2)^2 of a point each, in the mean, and the bonus for size
// mu log2(n). The floor has about as many shapes as the score is largest for: where it is cut first depends on the
// points.
void check_bent_floor(double sag)
{
  const double mu = Parameters().simplicity;
  const auto loss = [&](double n) { return 4. / 45 * std::pow(sag / (n * n), 2) + mu * std::log2(n); };
  double best = 1;
  while(loss(best + 1) < loss(best))
    ++best;
  const std::size_t clouds = 3;
  double share = 0, number = 0;
  for(std::size_t c = 0; c < clouds; ++c) {
    Cloud cloud;
    add_floor(
      cloud, 30000 + c, epsilon / 20, [&](double x) { return -sag * epsilon * x * x; },
      [&](double x) { return -2 * sag * epsilon * x; });
    const Shapes shapes = detect(cloud, make_parameters(epsilon, 200));
    number += double(shapes.number_of_shapes()) / clouds;
    if(shapes.number_of_shapes() > 0)
      share += double(shapes.points(0).size()) / double(cloud.size() * clouds);
  }
  const std::string name = "floor that sags by " + std::to_string(sag) + " epsilon, best cut into " +
                           std::to_string(int(best)) + ": " + std::to_string(number) +
                           " shapes, the largest one with " + std::to_string(share) + " of the points";
  CHECK_AT(number <= best + 1 && share >= .95 / (best + 1), name);
}

// Two floors stay two, and each one keeps its points.
void check_layers(double distance, double noise)
{
  Cloud cloud;
  const std::size_t points = 20000;
  for(int layer : {0, 1})
    add_floor(
      cloud, points + std::size_t(layer), noise * epsilon, [&](double) { return layer * distance * epsilon; },
      [](double) { return 0.; });
  const Shapes shapes = detect(cloud, make_parameters(epsilon, 200));
  std::map<int, std::array<std::size_t, 2>> points_of;
  for(std::size_t i = 0; i < cloud.size(); ++i)
    ++points_of[shapes.shape_index(i)][i < points ? 0 : 1];
  std::size_t right = 0;
  for(const auto& shape : points_of)
    if(shape.first >= 0)
      right += (std::max)(shape.second[0], shape.second[1]);
  CHECK_AT(right > .93 * double(cloud.size()), "layers at a distance of " + std::to_string(distance) + ": " +
                                                 std::to_string(right) + " points in shapes of their own layer");
}

BOOST_AUTO_TEST_CASE(bent_floors)
{
  for(double sag : {.5, 1., 2., 4.})
    check_bent_floor(sag);
}

BOOST_AUTO_TEST_CASE(layers)
{
  check_layers(1.3, .2);
  check_layers(2, .3);
}

// Noisy faces within epsilon of larger ones keep their points. A face is found if a shape has most of its points, and
// they are most of the shape.
BOOST_AUTO_TEST_CASE(noisy_layers)
{
  std::size_t faces = 0, found = 0;
  for(unsigned seed : {1u}) {
    scenes::Options options = scene_options(200000, .002, .2);
    options.normals = scenes::Normals::perturbed;
    options.normal_noise_deg = 8;
    options.seed = seed;
    const scenes::Scene scene = scenes::make_scene("house", options);
    Parameters parameters = make_parameters(.2, 200);
    parameters.maximum_angle = 36.87;
    const Shapes shapes = detect(to_cloud(scene), parameters);
    std::map<std::pair<int, int>, std::size_t> common; // by face and shape
    std::map<int, std::size_t> size;
    for(std::size_t i = 0; i < scene.label.size(); ++i) {
      ++common[{scene.label[i], shapes.shape_index(i)}];
      ++size[scene.label[i]];
    }
    for(const auto& face : size)
      faces += face.first >= 0 && face.second >= parameters.minimum_region_size;
    for(const auto& c : common) {
      const auto [face, shape] = c.first;
      found += face >= 0 && shape >= 0 && size[face] >= parameters.minimum_region_size &&
               2 * c.second > (std::max)(size[face], shapes.points(shape).size());
    }
  }
  CHECK_AT(double(found) > .9 * double(faces), std::to_string(found) + " of " + std::to_string(faces) + " noisy faces");
}

Shape_summary summary(double points, const Vector& centroid)
{
  Shape_summary s = {};
  s.fit.scatter.count = points;
  s.fit.scatter.centroid = centroid;
  return s;
}

// Two shapes of one plane, one of another, and dead ones.
BOOST_AUTO_TEST_CASE(center_of_planes)
{
  const Vector up = {0, 0, 1}, aslant = {.6, 0, .8};
  Relations r;
  r.planes = {{up, 10}, {aslant, 20}, {up, 30}, {up, 40}};
  r.plane_of = {0, 1, 0, 0, 2, 1};
  const std::vector<Shape_summary> shapes = {summary(100, {5, 6, 11}),   summary(50, {100, 7, -50}),
                                             summary(300, {-900, 2, 7}), summary(0, {0, 0, 1e6}),
                                             summary(0, {1, 2, 3}),      summary(0, {5, 5, 5})};
  center_planes(shapes, r);
  check_close(r.planes[0].offset, (100 * 11 + 300 * 7) / 400., 1e-12, "offset of the plane of two shapes");
  check_close(r.planes[1].offset, 60 - 40, 1e-12, "offset of the plane of one shape");
  check_equal(r.planes[2].offset, 30., "offset of the plane of a dead shape");
  check_equal(r.planes[3].offset, 40., "offset of a plane without shapes");
  for(std::size_t p : {0u, 2u, 3u})
    CHECK(r.planes[p].normal.x == 0 && r.planes[p].normal.y == 0 && r.planes[p].normal.z == 1);
  CHECK(r.planes[1].normal.x == .6 && r.planes[1].normal.z == .8);
}

// By coplanar group; a shape without partner is one. Points that only the last checks have freed are missing, so the
// mean is near zero only.
std::size_t check_means(const Cloud& cloud, const Shapes& shapes, double distance, const std::string& where)
{
  std::vector<double> sum(shapes.number_of_coplanar_groups(), 0), count(sum.size(), 0);
  for(std::size_t i = 0; i < cloud.size(); ++i) {
    if(shapes.shape_index(i) < 0)
      continue;
    const std::size_t s = std::size_t(shapes.shape_index(i)), group = std::size_t(shapes.data().coplanar_group[s]);
    const auto& c = shapes.coefficients(s);
    const auto& p = cloud[i].first;
    sum[group] += c[0] * p.x() + c[1] * p.y() + c[2] * p.z() + c[3];
    ++count[group];
  }
  for(std::size_t g = 0; g < sum.size(); ++g)
    check_close(sum[g] / (distance * count[g]), 0, .05,
                where + ": mean distance, in epsilons, of group " + std::to_string(g) + " of " +
                  std::to_string(int(count[g])) + " points");
  return sum.size();
}

BOOST_AUTO_TEST_CASE(centers)
{
  for(const char* name : {"house", "indoor", "part", "village", "staircase"})
    for(Given given : {Given::normals, Given::nothing}) {
      const double noise = given == Given::normals ? .001 : .0003;
      const std::string where =
        std::string(name) + (given == Given::normals ? ", normals are given" : ", normals are estimated");
      const scenes::Scene scene = scenes::make_scene(name, scene_options(20000, noise, .05));
      const Cloud cloud = to_cloud(scene);
      const double distance = 3 * noise * scene.diagonal;
      const Shapes shapes = detect_valid(where, cloud, make_parameters(distance, 60), given);
      CHECK_AT(check_means(cloud, shapes, distance, where) > 10, where + ": few planes");
    }
}

// Near neighbors and all, by shape; of the labels, and where many shapes have two slots.
BOOST_AUTO_TEST_CASE(neighbors_of_slabs)
{
  on_fixtures([](auto backend, const std::string& name, const Fixture& f) {
    for(std::uint32_t factor : {1u, Neighbor_scratch::slots / 2}) {
      std::vector<std::uint32_t> label = f.label;
      for(std::uint32_t& s : label)
        s = s < first_mark ? s * factor : s;
      std::uint32_t shapes = 0;
      for(std::uint32_t s : label)
        shapes = s < first_mark ? (std::max)(shapes, s + 1) : shapes;
      std::vector<Plane> plane;
      std::vector<std::uint8_t> is_crisp;
      for(std::uint32_t s = 0; s < shapes; ++s) {
        plane.push_back(f.plane[s % f.plane.size()]);
        is_crisp.push_back(s / 2 % 2);
      }
      std::vector<std::uint64_t> counts(std::size_t(shapes) * neighbor_counts::size, 0), expected = counts;
      for(std::uint32_t i = 0; i < f.cloud.size; ++i)
        if(label[i] < first_mark)
          f.for_each_neighbor(i, [&](std::uint32_t q) {
            if(label[q] < first_mark && label[q] != label[i] && is_crisp[label[q]])
              return;
            std::uint64_t* const c = expected.data() + std::size_t(label[i]) * neighbor_counts::size;
            ++c[neighbor_counts::all];
            c[neighbor_counts::near] +=
              label[q] == label[i] || is_near(plane[label[i]], f.point[q], f.tolerance_of(i).distance);
          });
      backend.template for_each_cell<Neighbor_scratch>(
        f.cells.size(), Count_neighbors<decltype(backend)>{f.cloud, f.cells.data(), label.data(), plane.data(),
                                                           is_crisp.data(), counts.data(), f.tolerance});
      check_lists(counts, expected, name);
    }
  });
}

// Eleven of twenty suffice.
BOOST_AUTO_TEST_CASE(bound_of_slabs)
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
BOOST_AUTO_TEST_CASE(slabs)
{
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

BOOST_AUTO_TEST_SUITE_END()
