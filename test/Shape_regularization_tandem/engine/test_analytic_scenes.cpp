// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes whose shapes, directions and planes are known: the result has to be exactly that.

#include "testing/test_support.h"

BOOST_AUTO_TEST_SUITE(test_analytic_scenes)

struct Expected {
  std::size_t shapes, directions, planes, orthogonal_pairs, degrees_of_freedom;
};

void check_expected(const std::string& name, const Shapes& shapes, const Expected& e)
{
  check_counts(name, shapes, e.shapes, e.directions, e.planes);
  check_equal(shapes.orthogonal_groups().size(), e.orthogonal_pairs, name + ": number of orthogonal pairs");
  check_equal(shapes.statistics().degrees_of_freedom, e.degrees_of_freedom, name + ": degrees of freedom");
  if(e.shapes > 0)
    check_equal(shapes.statistics().complexity, double(e.degrees_of_freedom) / double(3 * e.shapes),
                name + ": complexity");
}

// The face that most points of each shape come from; each point may be on the edge of another one.
std::vector<int> faces_of(const scenes::Scene& scene, const Shapes& shapes)
{
  std::vector<int> faces;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    std::vector<int> votes(scene.faces.size() + 1, 0);
    for(std::size_t i : shapes.points(s))
      ++votes[std::size_t(scene.label[i] + 1)];
    faces.push_back(int(std::max_element(votes.begin(), votes.end()) - votes.begin()) - 1);
  }
  return faces;
}

// The plane of each shape is that of its face, up to an angle and a distance at its points.
void check_planes(const std::string& name, const scenes::Scene& scene, const Shapes& shapes, double degrees,
                  double distance)
{
  const std::vector<int> faces = faces_of(scene, shapes);
  for(std::size_t s = 0; s < faces.size(); ++s) {
    const std::string at = name + ", shape " + std::to_string(s);
    CHECK_AT(faces[s] >= 0, at + " is on no face");
    if(faces[s] < 0)
      continue;
    const auto& c = shapes.coefficients(s);
    const scenes::Truth_face& face = scene.faces[std::size_t(faces[s])];
    const double sine = length(cross(face.normal, scenes::Vec{c[0], c[1], c[2]}));
    CHECK_AT(sine <= std::sin(degrees * .017453292519943295), at + " is turned, sine " + std::to_string(sine));
    double farthest = 0;
    for(std::size_t i : shapes.points(s)) {
      const scenes::Vec& p = scene.ideal[i];
      if(scene.label[i] == faces[s])
        farthest = (std::max)(farthest, std::fabs(c[0] * p.x + c[1] * p.y + c[2] * p.z + c[3]));
    }
    CHECK_AT(farthest <= distance, at + " is off by " + std::to_string(farthest));
  }
}

struct Known_scene {
  const char* name;
  scenes::Model model;
  double noise, epsilon;
  Expected expected;
  double degrees = 3; // by which planes may be off
};

// With normals that are given, and with estimated ones in many cells. Of the tilted cube, faces are 2 degrees off: one
// frame, of which all three pairs are orthogonal, and the siblings too.
BOOST_AUTO_TEST_CASE(test_known_scenes)
{
  using namespace scenes;
  for(const Known_scene& k : {Known_scene{"cube", make_cube(), 0, .01, {6, 3, 6, 3, 9}},
                              {"staircase", make_staircase(), 0, .01, {16, 2, 16, 1, 19}},
                              {"squares with a gap", make_squares(.5), 0, .01, {2, 1, 1, 0, 3}},
                              {"squares that touch", make_squares(0), 0, .01, {1, 1, 1, 0, 3}},
                              {"slope", make_slope(), 0, .02, {3, 2, 2, 0, 6}},
                              {"chained", make_chained(), 0, .01, {3, 3, 3, 0, 9}},
                              {"two followers", make_two_followers(), 0, .02, {3, 3, 3, 2, 7}},
                              {"pair of a tenth of epsilon", make_offset_pair(.001), 0, .01, {2, 1, 1, 0, 3}},
                              {"pair of half epsilon", make_offset_pair(.005), 0, .01, {2, 1, 2, 0, 4}},
                              {"pair of three epsilon", make_offset_pair(.03), 0, .01, {2, 1, 2, 0, 4}},
                              {"noisy cube", make_cube(Frame().turned({1, 2, 3}, .3)), .001, .007, {6, 3, 6, 3, 9}},
                              {"noisy staircase", make_staircase(), .001, .015, {16, 2, 16, 1, 19}},
                              {"tilted cube", make_tilted_cube(.5), .002, .04, {6, 3, 6, 3, 9}, 4.1}}) {
    const scenes::Scene scene = make_scene(k.model, scene_options(12000, k.noise));
    for(Given given : {Given::normals, Given::nothing}) {
      const std::string name = k.name + std::string(given == Given::normals ? ", given normals" : ", no normals");
      Parameters parameters = make_parameters(k.epsilon, 100);
      parameters.cell_size = given == Given::normals ? 8192 : 500;
      const Shapes shapes = detect_valid(name, to_cloud(scene), parameters, given);
      check_expected(name, shapes, k.expected);
      check_planes(name, scene, shapes, k.degrees, k.degrees / 3 * k.epsilon);
      check(shapes.statistics().coverage > .9, name + ": coverage", shapes.statistics().coverage);
    }
  }
}

// Nothing planar: no plane is made up. (Estimated
// normals of a volume whose spacing, here .04, is that of a layer of two epsilons do make planes.)
BOOST_AUTO_TEST_CASE(test_without_planes)
{
  const Cloud noise = to_cloud(scenes::make_scene("noise", scene_options(15000)));
  for(Given given : {Given::normals, Given::nothing})
    for(double epsilon : {.005, given == Given::normals ? .03 : .01}) {
      const std::string name = "noise, epsilon " + std::to_string(epsilon);
      check_counts(name, detect_valid(name, noise, make_parameters(epsilon, 50), given), 0, 0, 0);
    }
}

// Houses 2.9 degrees apart, with a tolerance of 8. (A side of 2 meters that turns by half
// of 2.9 degrees moves by .027: with a larger epsilon it would fit a common direction.)
BOOST_AUTO_TEST_CASE(test_village)
{
  const scenes::Scene scene = scenes::make_scene("village", scene_options(150000, .00003));
  const Shapes shapes = detect_valid("village", to_cloud(scene), make_parameters(.02, 45));
  check_equal(shapes.number_of_parallel_groups(), 65u, "village: number of directions");
  check_equal(shapes.number_of_shapes(), scene.faces.size(), "village: number of shapes");
  check_planes("village", scene, shapes, .5, .03);
}

// Each relation can be switched off.
BOOST_AUTO_TEST_CASE(test_switches)
{
  const Cloud cloud = to_cloud(scenes::make_scene(scenes::make_tilted_cube(.5), scene_options(8000)));
  Parameters p = make_parameters(.04, 100);
  p.regularize_parallelism = p.regularize_orthogonality = p.regularize_coplanarity = false;
  check_expected("nothing regularized", detect_valid("nothing regularized", cloud, p), {6, 6, 6, 0, 18});
  p.regularize_parallelism = true;
  check_counts("parallelism only", detect_valid("parallelism only", cloud, p), 6, 3, 6);
  p = make_parameters(.04, 100);
  p.angle_tolerance = 0;
  check_counts("tolerance of 0", detect_valid("tolerance of 0", cloud, p), 6, 6, 6);
}

// The rectangle of each side is 4 by 2.5 units.
struct Wall {
  const char* name;
  std::size_t sides;
  double gap, noise;
  double turned; // ratio of wrong normals
  double epsilon, coverage;
  std::size_t points = 2000; // of a side
};

// A wall that was scanned on both sides, with normals to either one, is two shapes, also where both are closer than
// the points of one. Normals of random orientation have no wall side, and some wrong ones among them do no harm.
void check_wall(const Wall& wall, std::uint64_t seed)
{
  scenes::Random random(seed);
  const scenes::Vec n = random.direction(), u = scenes::unit(scenes::cross(n, random.direction())),
                    v = scenes::cross(n, u);
  Cloud cloud;
  for(std::size_t side = 0; side < wall.sides; ++side)
    for(std::size_t i = 0; i < wall.points; ++i) {
      const scenes::Vec p = (wall.gap * double(side) + wall.noise * random.gaussian()) * n +
                            (4 * random.uniform()) * u + (2.5 * random.uniform()) * v;
      const bool is_turned = (random.uniform() < wall.turned) != (side == 1);
      add(cloud, p, (is_turned ? -1. : 1.) * n);
    }
  const std::string name = wall.name + (", seed " + std::to_string(seed));
  const Shapes shapes = detect_valid(name, cloud, make_parameters(wall.epsilon, 50));
  check_equal(shapes.number_of_shapes(), wall.sides, name + ": shapes");
  check(shapes.statistics().coverage > wall.coverage, name + ": coverage", shapes.statistics().coverage);
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(const std::size_t i : shapes.points(s))
      CHECK_AT(i / wall.points == shapes.points(s)[0] / wall.points, name + ": points of both sides in one shape");
}

BOOST_AUTO_TEST_CASE(test_thin_walls)
{
  for(const Wall& wall : {Wall{"closer than the spacing", 2, .04, .004, 0, .01, .95},
                          {"far apart", 2, .12, .005, 0, .015, .97},
                          {"with some wrong normals", 2, .04, .004, .06, .01, .85},
                          {"one side", 1, 0, .004, 0, .015, .97},
                          {"random orientations", 1, 0, .004, .5, .015, .97},
                          {"some wrong normals", 1, 0, .004, .05, .015, .97}})
    for(std::uint64_t seed = 1; seed <= 3; ++seed)
      check_wall(wall, seed);
  // Some 30 points are one surfel, beside one of those whose normals are wrong.
  check_wall({"dense, with some wrong normals", 2, .35, .02, .03, .2, .96, 60000}, 7);
}
// The counterpart of CGAL's own test_plane_regularization, where "changed" is only printed: two unit squares of 5000
// points, `degrees` apart.
Cloud two_planes(double degrees, double offset)
{
  Cloud cloud;
  scenes::Random random(3);
  const double radians = degrees * .017453292519943295;
  const scenes::Vec u = {std::cos(radians), 0, std::sin(radians)}, n = {-u.z, 0, u.x};
  for(int i = 0; i < 5000; ++i) {
    const double a = random.uniform(), b = random.uniform();
    add(cloud, {a, b, 0}, {0, 0, 1});
    add(cloud, scenes::Vec{2.2, 0, offset} + (random.uniform() - .5) * u + scenes::Vec{0, random.uniform(), 0}, n);
  }
  return cloud;
}

// Relations that pay, and that do not. A degree of freedom is worth 70 points here: .1 of 200 and 1 % of 5000; a
// direction has two. To turn a square by 2 degrees costs 35 points, by 3 degrees 80, by 10 degrees 870; to move both by
// .0075 costs 40, by .03 it costs 630.
BOOST_AUTO_TEST_CASE(test_relations_pay)
{
  struct Case {
    double degrees, offset, tolerance, maximum_offset;
    std::size_t directions, right_angles, planes;
    double regularity = Parameters().regularity;
  };
  for(const Case& c : {Case{3, .5, 2, .1, 2, 0, 2}, Case{3, .5, 6, .1, 1, 0, 2}, Case{10, .5, 15, .1, 2, 0, 2},
                       Case{88, .7, 1, .1, 2, 0, 2}, Case{88, .7, 6, .1, 2, 1, 2}, Case{80, .7, 15, .1, 2, 0, 2},
                       Case{0, .015, 5, .01, 1, 0, 2}, Case{0, .015, 5, .1, 1, 0, 1}, Case{0, .06, 5, .1, 1, 0, 2},
                       Case{3, .5, 6, .1, 2, 0, 2, 0}, Case{10, .5, 15, .1, 1, 0, 2, 10}}) {
    Parameters p = make_parameters(.12, 200);
    p.regularity = c.regularity;
    p.angle_tolerance = c.tolerance;
    p.maximum_offset = c.maximum_offset;
    const std::string name = std::to_string(c.degrees) + " degrees within " + std::to_string(c.tolerance);
    const Shapes shapes = detect_valid(name, two_planes(c.degrees, c.offset), p);
    check_counts(name, shapes, 2, c.directions, c.planes);
    check_equal(shapes.orthogonal_groups().size(), c.right_angles, name + ": right angles");
  }
}

BOOST_AUTO_TEST_SUITE_END()
