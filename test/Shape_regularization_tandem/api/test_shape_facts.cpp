// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// shape_facts() of shapes whose size and place are known: in two kernels, in small, large and far clouds, and of points
// that determine little; facets of a curved surface; and the classes of the parts of buildings.

#include "api_support.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>
#include <CGAL/Shape_regularization_tandem/shape_facts.h>

BOOST_AUTO_TEST_SUITE(test_shape_facts)

using CGAL::Tandem::Shape_facts;
using scenes::Vec;
using Points = std::vector<Kernel::Point_3>;

double radians(double degrees) { return degrees * CGAL_PI / 180; }

// The normal of a plane that falls in the direction `azimuth`.
Vec normal_of(double dip, double azimuth)
{
  const double s = std::sin(radians(dip));
  return {s * std::sin(radians(azimuth)), s * std::cos(radians(azimuth)), std::cos(radians(dip))};
}

// Points, and one shape of all of them, as a detection has it.
struct Shape {
  Points points;
  Shapes::Data data;

  Shape(const Points& p, const Vec& n, double d) : points(p)
  {
    data.coefficients = {{n.x, n.y, n.z, d}};
    data.size = {points.size()};
    data.parallel_group = data.coplanar_group = {0};
    data.is_flipped = {0};
    data.uncertainty.resize(1);
    data.shape_of = std::vector<std::int32_t>(points.size(), 0);
    data.parameters.maximum_distance = .2;
  }

  Shape_facts facts(bool is_flipped = false)
  {
    data.is_flipped = {is_flipped};
    return CGAL::Tandem::shape_facts(Shapes(data), points).at(0);
  }
};

// A grid of 41 x 21 points that are `step` apart, turned by 25 degrees in a plane through `center`; every other
// one is `noise` above the plane, the others are below it.
Shape rectangle(const Vec& n, const Vec& center = {3, -2, 5}, double step = .1, double noise = 0)
{
  constexpr int columns = 41, rows = 21;
  const double level = std::hypot(n.x, n.y), c = std::cos(radians(25)), s = std::sin(radians(25));
  const Vec u = level > 0 ? Vec{n.y / level, -n.x / level, 0} : Vec{1, 0, 0}, v = cross(n, u);
  Points points;
  for(int i = 0; i < columns; ++i)
    for(int j = 0; j < rows; ++j) {
      const double x = step * (i - (columns - 1) / 2.), y = step * (j - (rows - 1) / 2.);
      const Vec p = center + (c * x - s * y) * u + (s * x + c * y) * v + ((i + j) % 2 == 0 ? noise : -noise) * n;
      points.emplace_back(p.x, p.y, p.z);
    }
  Shape shape(points, n, -dot(n, center));
  shape.data.parameters.maximum_distance = 2 * step;
  return shape;
}

void check_slope(const Shape_facts& f, double tilt, double dip, double azimuth)
{
  check_close(f.tilt_deg, tilt, 1e-9, "tilt");
  check_close(f.dip_deg, dip, 1e-9, "dip");
  check_close(f.azimuth_deg, azimuth, 1e-9, "azimuth");
}

// `tolerance` is relative to `size`, the unit of all lengths.
void check_rectangle(const Shape_facts& f, const Vec& center, double size, double tolerance)
{
  const double half = std::sin(radians(30)) * (2 * std::sin(radians(25)) + std::cos(radians(25)));
  CHECK(f.number_of_points == 41 * 21);
  check_close(f.centroid[0] / size, center.x / size, tolerance, "x");
  check_close(f.centroid[1] / size, center.y / size, tolerance, "y");
  check_close(f.centroid[2] / size, center.z / size, tolerance, "z");
  check_close(f.area / size / size, 8, 8 * tolerance, "area");
  check_close(f.length / size, 4, tolerance, "length");
  check_close(f.width / size, 2, tolerance, "width");
  check_close((f.highest - center.z) / size, half, tolerance, "highest");
  check_close((f.lowest - center.z) / size, -half, tolerance, "lowest");
  check_slope(f, 30, 30, 120);
  CHECK(f.rms_distance <= tolerance * size && f.mean_distance <= f.rms_distance && f.shifted <= tolerance * size);
  check_close(f.turned_deg, 0, 60 * tolerance, "turned");
}

BOOST_AUTO_TEST_CASE(test_known_rectangle)
{
  const Vec n = normal_of(30, 120), center = {3, -2, 5}, far = {600000, 5400000, 300};
  check_rectangle(rectangle(n).facts(), center, 1, 1e-12);
  check_rectangle(rectangle(n, far).facts(), far, 1, 1e-7);
  for(const double size : {0x1p-300, 0x1p300})
    check_rectangle(rectangle(n, size * center, .1 * size).facts(), size * center, size, 1e-12);
  using Float = CGAL::Simple_cartesian<float>;
  std::vector<Float::Point_3> floats;
  const Shape shape = rectangle(n);
  for(const auto& p : shape.points)
    floats.emplace_back(float(p.x()), float(p.y()), float(p.z()));
  const CGAL::Tandem::Planar_shapes_3<Float> of_floats(shape.data);
  check_rectangle(CGAL::Tandem::shape_facts(of_floats, floats).at(0), center, 1, 1e-5);
}

BOOST_AUTO_TEST_CASE(test_slopes)
{
  for(const double azimuth : {0., 90., 180., 270., 359.}) {
    Shape roof = rectangle(normal_of(20, azimuth)), wall = rectangle(normal_of(90, azimuth));
    check_slope(roof.facts(), 20, 20, azimuth);
    check_slope(roof.facts(true), 160, 20, azimuth); // the lower side
    // Walls, vertical up to rounding: the side of the normal.
    check_slope(wall.facts(), 90, 90, azimuth);
    check_slope(wall.facts(true), 90, 90, azimuth < 180 ? azimuth + 180 : azimuth - 180);
  }
  check_slope(rectangle({0, 0, 1}).facts(), 0, 0, 0);
  check_slope(rectangle({0, 0, 1}).facts(true), 180, 0, 0);
}

// The axis y is upward: north is -z.
BOOST_AUTO_TEST_CASE(test_upward)
{
  Shape shape = rectangle({0, std::cos(radians(10)), -std::sin(radians(10))}, {0, 7, 0});
  const Shapes shapes(shape.data);
  const auto facts_of = [&](const Kernel::Vector_3& up) {
    return CGAL::Tandem::shape_facts(shapes, shape.points, np::symmetry_direction(up)).at(0);
  };
  shape.data.parameters.symmetry_direction = {0, 3, 0};
  for(const Shape_facts& f : {facts_of({0, 1e-200, 0}), shape.facts()}) {
    check_slope(f, 10, 10, 0);
    check_close(f.lowest + f.highest, 14, 1e-12, "heights");
  }
  for(const Kernel::Vector_3& wrong : {Kernel::Vector_3(0, 0, 0), Kernel::Vector_3(0, not_a_number, 1)})
    CHECK_REFUSED(facts_of(wrong), "");
}

// A plane that regularization has turned by a degree about the centroid, and shifted.
BOOST_AUTO_TEST_CASE(test_moved)
{
  const Vec center = {3, -2, 5}, n = normal_of(31, 120);
  Shape shape = rectangle(normal_of(30, 120), center, .1, .004);
  const Shape_facts before = shape.facts(), after = Shape(shape.points, n, -dot(n, center) - .05).facts();
  check_close(before.rms_distance, .004, 1e-12, "rms");
  check_close(before.mean_distance, .004, 1e-12, "mean");
  CHECK_AT(before.turned_deg < .01 && before.shifted < 1e-5, std::to_string(before.turned_deg));
  check_close(after.turned_deg, 1, .01, "turned");
  check_close(after.shifted, .05, 1e-5, "shifted");
  CHECK(after.rms_distance > after.mean_distance && after.mean_distance > .04);
}

// --- Several shapes

// Of a plane z = a x + b y + c, or with other axes.
struct Patch {
  Points points;
  Vec normal;
  double d;
};

// Points that are `step` apart, from a corner on.
Patch patch(const Vec& corner, const Vec& u, const Vec& v, double step = .1)
{
  const Vec n = cross(u, v), normal = 1 / std::sqrt(dot(n, n)) * n;
  const int columns = int(std::sqrt(dot(u, u)) / step), rows = int(std::sqrt(dot(v, v)) / step);
  Patch result = {{}, normal, -dot(normal, corner)};
  for(int i = 0; i <= columns; ++i)
    for(int j = 0; j <= rows; ++j) {
      const Vec p = corner + double(i) / columns * u + double(j) / rows * v;
      result.points.emplace_back(p.x, p.y, p.z);
    }
  return result;
}

struct Cloud {
  Points points;
  Shapes::Data data;
};

// With points without a shape at the end.
Cloud cloud_of(const std::vector<Patch>& patches, const Points& others = {})
{
  Cloud result;
  Points& all = result.points;
  Shapes::Data& data = result.data;
  std::vector<std::int32_t> labels;
  for(const Patch& p : patches) {
    labels.resize(labels.size() + p.points.size(), std::int32_t(data.size.size()));
    data.parallel_group.push_back(int(data.size.size()));
    data.coefficients.push_back({p.normal.x, p.normal.y, p.normal.z, p.d});
    data.size.push_back(p.points.size());
    all.insert(all.end(), p.points.begin(), p.points.end());
  }
  all.insert(all.end(), others.begin(), others.end());
  labels.resize(all.size(), -1);
  data.coplanar_group = data.parallel_group;
  data.is_flipped.resize(data.size.size());
  data.uncertainty.resize(data.size.size());
  data.shape_of = std::move(labels);
  data.parameters.maximum_distance = .2;
  return result;
}

std::vector<Shape_facts> facts_of(const std::vector<Patch>& patches, const Points& others = {})
{
  const Cloud cloud = cloud_of(patches, others);
  return CGAL::Tandem::shape_facts(Shapes(cloud.data), cloud.points);
}

// Two patches on both sides of the axis y, of width 2: those of a cylinder of radius 10, or a ridge of the same angle. The
// noise is larger than the bend of a patch, and smaller than that of both.
std::vector<Patch> beside_y(bool is_curved)
{
  scenes::Random random(7);
  std::vector<Patch> patches;
  for(const double side : {-1., 1.}) {
    Patch p = patch({0, 0, 0}, {2 * side, 0, -.2}, {0, 5, 0});
    for(Kernel::Point_3& q : p.points) {
      const double bend = is_curved ? .1 * std::fabs(q.x()) - .05 * q.x() * q.x() - .1 / 3 : 0;
      q = Kernel::Point_3(q.x(), q.y(), q.z() + bend + .02 * random.gaussian());
    }
    patches.push_back(p);
  }
  return patches;
}

BOOST_AUTO_TEST_CASE(test_facets)
{
  const std::vector<Patch> facets = beside_y(true), faces = beside_y(false);
  for(const Shape_facts& f : facts_of(facets))
    CHECK_AT(f.curved > .8 && f.curved <= 1, std::to_string(f.curved));
  for(const Shape_facts& f : facts_of(faces))
    CHECK_AT(f.curved >= 0 && f.curved < .1, std::to_string(f.curved));
  // Without the neighbor, the noise is larger; a wider facet bends more.
  const double alone = facts_of({facets[0]})[0].curved;
  CHECK_AT(alone > .1 && alone < .5, std::to_string(alone));
  Patch wide = patch({-2.5, 0, 0}, {5, 0, 0}, {0, 5, 0});
  for(Kernel::Point_3& q : wide.points)
    q = Kernel::Point_3(q.x(), q.y(), .13 - .05 * q.x() * q.x());
  CHECK(facts_of({wide})[0].curved > .999 && facts_of({patch({0, 0, 0}, {1, 0, .3}, {0, 1, .1})})[0].curved == 0);
}

BOOST_AUTO_TEST_CASE(test_order_of_points)
{
  std::vector<Patch> patches = beside_y(true);
  const std::vector<Shape_facts> before = facts_of(patches);
  for(Patch& p : patches)
    std::reverse(p.points.begin(), p.points.end());
  const std::vector<Shape_facts> after = facts_of(patches);
  for(std::size_t s = 0; s < 2; ++s) {
    CHECK(before[s].curved == after[s].curved && before[s].centroid == after[s].centroid);
    CHECK(before[s].rms_distance == after[s].rms_distance && before[s].width == after[s].width);
  }
}

// --- The classes of shapes

using CGAL::Tandem::Shape_class;

void check_classes(const std::string& expected, const std::vector<Patch>& patches, const Points& others = {})
{
  std::string result;
  for(const Shape_facts& f : facts_of(patches, others))
    result += std::string(result.empty() ? "" : " ") + CGAL::Tandem::shape_class_name(f.shape_class);
  CHECK_AT(result == expected, result);
}

// 6 x 4, from a level on.
std::vector<Patch> walls(double height, double level = 0)
{
  const Vec up = {0, 0, height};
  return {patch({0, 0, level}, {6, 0, 0}, up), patch({6, 0, level}, {0, 4, 0}, up),
          patch({6, 4, level}, {-6, 0, 0}, up), patch({0, 4, level}, {0, -4, 0}, up)};
}

Patch level(double height) { return patch({0, 0, height}, {6, 0, 0}, {0, 4, 0}); }

std::vector<Patch> joined(std::vector<Patch> first, const std::vector<Patch>& second)
{
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

BOOST_AUTO_TEST_CASE(test_rooms)
{
  check_classes("floor ceiling wall wall wall wall", joined({level(0), level(3)}, walls(3)));
  check_classes("floor wall wall wall wall", joined({level(0)}, walls(3))); // as of a scan without a ceiling
  // Two stories, with a slab between them.
  check_classes("floor ceiling floor ceiling wall wall wall wall wall wall wall wall",
                joined({level(0), level(3), level(3.4), level(6)}, joined(walls(3), walls(2.6, 3.4))));
}

// Ground around a house with a gable roof, and one with a flat roof; points without a shape are above a part of the ground.
BOOST_AUTO_TEST_CASE(test_house)
{
  Patch ground = patch({-10, -10, 0}, {26, 0, 0}, {0, 24, 0});
  ground.points.erase(
    std::remove_if(ground.points.begin(), ground.points.end(),
                   [](const Kernel::Point_3& p) { return p.x() > 0 && p.x() < 6 && p.y() > 0 && p.y() < 4; }),
    ground.points.end());
  const std::vector<Patch> gable = {patch({-.5, -.5, 2.8}, {7, 0, 0}, {0, 2.5, 1.5}),
                                    patch({-.5, 4.5, 2.8}, {7, 0, 0}, {0, -2.5, 1.5})};
  const Points tree = patch({-8, -8, 4}, {5, 0, 0}, {0, 5, 0}).points;
  check_classes("ground roof roof wall wall wall wall", joined({ground, gable[0], gable[1]}, walls(3)), tree);
  check_classes("ground roof wall wall wall wall", joined({ground, level(3)}, walls(3)));
  check_classes("ground roof roof", {ground, gable[0], gable[1]}); // as seen from the air
  // On ground that is there below the house, too.
  check_classes("ground roof", {patch({-10, -10, 0}, {26, 0, 0}, {0, 24, 2}), level(5)});
}

BOOST_AUTO_TEST_CASE(test_few_points)
{
  const Shape_facts three = Shape({{1, 1, 0}, {2, 1, 0}, {1, 3, 0}}, {0, 0, 1}, 0).facts();
  CHECK(three.length == 2 && three.width == 1 && three.area == 0 && three.turned_deg == 0 && three.shifted == 0);
  Points line;
  for(int i = 0; i < 30; ++i)
    line.emplace_back(.3 * i, .1 * i, 0);
  const Shape_facts thin = Shape(line, {0, 0, 1}, 0).facts();
  check_close(thin.length, 8.7 * std::sqrt(1 + 1 / 9.), 1e-12, "length of a line");
  CHECK_AT(thin.width < 1e-15 && thin.turned_deg < 1e-12, std::to_string(thin.turned_deg));
  const Shape_facts one = Shape(Points(50, {4, 5, 6}), {0, 0, 1}, -6).facts();
  CHECK(one.length == 0 && one.width == 0 && one.area == 0 && one.centroid == (std::array<double, 3>{4, 5, 6}));
  CHECK(one.turned_deg == 0 && one.shifted == 0 && one.lowest == 6 && one.highest == 6);
  CHECK(std::isfinite(one.rms_distance + one.mean_distance + thin.rms_distance + thin.shifted + three.mean_distance));
  // A known plane that no point is on.
  Shape empty = rectangle(normal_of(30, 120));
  empty.data.shape_of = std::vector<std::int32_t>(empty.points.size(), -1);
  empty.data.size = {0};
  const Shape_facts f = empty.facts();
  CHECK(f.number_of_points == 0 && f.area == 0 && f.length == 0 && f.rms_distance == 0 && f.curved == 0);
  CHECK(f.shape_class == Shape_class::none && three.curved == 0 && thin.curved == 0 && one.curved == 0);
  check_slope(f, 30, 30, 120);
}

BOOST_AUTO_TEST_CASE(test_arguments)
{
  Shape shape = rectangle(normal_of(30, 120));
  const Shapes shapes(shape.data);
  Points& points = shape.points;
  const auto areas = CGAL::Tandem::polygons(shapes, points);
  CHECK(CGAL::Tandem::shape_facts(shapes, points, areas)[0].area == areas.area(0));
  const auto refuses = [&](const CGAL::Tandem::Shape_polygons_3<Kernel>& of) {
    return throws<std::invalid_argument>([&] { CGAL::Tandem::shape_facts(shapes, points, of); });
  };
  CHECK(!refuses(areas) && refuses(CGAL::Tandem::Shape_polygons_3<Kernel>()));
  points[5] = {3, -2, 9};
  CHECK(refuses(areas) && throws<std::invalid_argument>([&] { shape.facts(); }));
  points.pop_back();
  CHECK(refuses(areas) && throws<std::invalid_argument>([&] { shape.facts(); }));
  CHECK(CGAL::Tandem::shape_facts(Shapes(), Points()).empty());
}

// --- What the places of sensors tell

// Of each point, by its index.
struct Places {
  using key_type = Kernel::Point_3;
  using value_type = Kernel::Point_3;
  using reference = value_type;
  using category = boost::readable_property_map_tag;

  const Points* points;
  std::vector<Kernel::Point_3> places; // in turn

  friend value_type get(const Places& map, const Kernel::Point_3& p)
  {
    return map.places[std::size_t(&p - map.points->data()) % map.places.size()];
  }
};

// The facts of shapes whose points were seen from these places in turn. Veils are not selected.
std::vector<Shape_facts> seen_facts(const Cloud& cloud, const Points& places)
{
  const auto np = CGAL::Tandem::parameters::viewpoint_map(Places{&cloud.points, places});
  const std::vector<Shape_facts> facts = CGAL::Tandem::shape_facts(Shapes(cloud.data), cloud.points, np);
  const Shapes selected = CGAL::Tandem::select_shapes(Shapes(cloud.data), cloud.points, np);
  CHECK(selected.number_of_shapes() ==
        std::size_t(std::count_if(facts.begin(), facts.end(), [](const Shape_facts& f) { return !f.is_veil; })));
  return facts;
}

const Points origin = {Kernel::Point_3(0, 0, 0)};
constexpr double ray_step = .01; // radians

// What rays from the origin see of the plane z = -height beyond x = 2: rows of one elevation each, `first` steps below the
// level and lower. The range is that of the plane, or any from 2 to 6 where there is none between a near and a far surface.
Patch rows_of_rays(int first, int rows, bool is_veil)
{
  scenes::Random random(3);
  const double height = 3 * std::tan(ray_step * (first + rows / 2.));
  Patch result = {{}, {0, 0, 1}, height};
  for(int row = 0; row < rows; ++row)
    for(int i = -40; i <= 40; ++i) {
      const double elevation = -ray_step * (first + row), azimuth = ray_step * i;
      const double range = is_veil ? 2 + 4 * random.uniform() : height / std::sin(-elevation);
      result.points.emplace_back(range * std::cos(elevation) * std::cos(azimuth),
                                 range * std::cos(elevation) * std::sin(azimuth), range * std::sin(elevation));
    }
  return result;
}

BOOST_AUTO_TEST_CASE(test_veils)
{
  const auto is_veil = [](const Patch& p, const Points& from = origin) {
    // And a wall, of which most points are.
    Cloud cloud = cloud_of({p, patch({7, -4, -4}, {0, 8, 0}, {0, 0, 8}, .07)});
    cloud.data.parameters.maximum_distance = .3;
    return seen_facts(cloud, from)[0].is_veil;
  };
  for(const int rows : {1, 2})
    CHECK_AT(is_veil(rows_of_rays(0, rows, true)), std::to_string(rows));
  // Of a floor that the rays graze, there are more rows.
  for(const int rows : {3, 8})
    CHECK_AT(!is_veil(rows_of_rays(4, rows, false)), std::to_string(rows));
  // Nor from elsewhere, from a place that is not known, or where only half of the points are edge-on.
  const Kernel::Point_3 above(0, 0, 2), nowhere(0, 0, std::numeric_limits<double>::infinity());
  const Patch veil = rows_of_rays(0, 1, true);
  CHECK(!is_veil(veil, {above}) && !is_veil(veil, {nowhere}) && !is_veil(veil, {above, origin[0]}));
  CHECK(facts_of({veil})[0].is_veil == false);
  // A place in the planes of most points is not that of a sensor.
  Cloud alone = cloud_of({veil});
  alone.data.parameters.maximum_distance = .3;
  CHECK(!seen_facts(alone, origin)[0].is_veil);
  // A row of a wall is not deep, and a post is not edge-on.
  CHECK(!is_veil(patch({3, -1, 0}, {0, 2, 0}, {0, 0, .03}, .03)));
  CHECK(!is_veil(patch({3, -.03, -1}, {0, .06, 0}, {0, 0, 2}, .03)));
}

BOOST_AUTO_TEST_CASE(test_seen_behind)
{
  // A window before a room, and a table before a wall.
  const Patch window = patch({3, -1, -1}, {0, 2, 0}, {0, 0, 2}, .05),
              room = patch({6, -1.5, -1.5}, {0, 3, 0}, {0, 0, 3});
  const Patch board = patch({3, -1, -1}, {0, 2, 0}, {0, 0, .9}, .05), wall = patch({6, -2, -.1}, {0, 4, 0}, {0, 0, 3});
  const auto behind = [](const std::vector<Patch>& patches, const Points& from = origin) {
    std::vector<int> result;
    for(const Shape_facts& f : seen_facts(cloud_of(patches), from))
      result.push_back(f.behind);
    return result;
  };
  CHECK((behind({window, room}) == std::vector<int>{-1, 0}));
  CHECK((behind({room, window}) == std::vector<int>{1, -1}));
  CHECK((behind({board, wall}) == std::vector<int>{-1, -1}));
  CHECK((behind({window, room}, {Kernel::Point_3(9, 0, 0)}) == std::vector<int>{1, -1}));
  // The nearer of two panes; but none that is as near to the room as the tolerances are.
  Patch second = window, close = window;
  for(Kernel::Point_3& p : second.points)
    p = Kernel::Point_3(p.x() + 1, p.y(), p.z());
  second.d -= second.normal.x;
  CHECK((behind({second, window, room}) == std::vector<int>{1, -1, 1}));
  close = patch({5.7, -1.5, -1.5}, {0, 3, 0}, {0, 0, 3}, .05);
  CHECK((behind({close, room}) == std::vector<int>{-1, -1}));
  CHECK(facts_of({window, room})[1].behind == -1);
}

BOOST_AUTO_TEST_SUITE_END()
