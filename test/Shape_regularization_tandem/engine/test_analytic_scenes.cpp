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

// Chained angles: whatever is made parallel, no plane is turned by more than the tolerance.
BOOST_AUTO_TEST_CASE(test_chain_does_not_drift)
{
  const scenes::Scene scene = scenes::make_scene(scenes::make_chained(5, 6), scene_options(12000));
  for(double epsilon : {.01, .1, .3}) {
    const std::string name = "chain of six, epsilon " + std::to_string(epsilon);
    const Shapes shapes = detect_valid(name, to_cloud(scene), make_parameters(epsilon, 100));
    check_planes(name, scene, shapes, 8.1, 2 * epsilon);
  }
}

// Nothing planar: no plane is made up. (Estimated
// normals of a volume whose spacing, here .04, is that of a slab of two epsilons do make planes.)
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
  double turned; // share of wrong normals
  double epsilon, coverage;
  std::size_t points = 2000; // of a side
};

// A wall that was scanned on both sides, with normals to either side, is two shapes, also where both are closer than
// the points of one. Normals of random sides have none, and some wrong ones among them do no harm.
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
                          {"with some wrong sides", 2, .04, .004, .06, .01, .85},
                          {"one side", 1, 0, .004, 0, .015, .97},
                          {"random sides", 1, 0, .004, .5, .015, .97},
                          {"some wrong sides", 1, 0, .004, .05, .015, .97}})
    for(std::uint64_t seed = 1; seed <= 3; ++seed)
      check_wall(wall, seed);
  // Some 30 points are one surfel, beside one of those whose normals are wrong.
  check_wall({"dense, with some wrong sides", 2, .35, .02, .03, .2, .96, 60000}, 7);
}

enum class Kind { right_angle, parallel, step };

// A floor and a face of the same size, off a relation by so many degrees. One end of the face is then off the related
// plane through its other end by `turn` epsilons. Noise is in epsilons; where it is several spacings it makes a slab,
// of which the outer points are surfaces of their own: such cases are left out. A relation must not make a face fall
// into strips: each face has to be one shape. A face that turns by 3 epsilon may share a direction: each face then
// turns by half of that, and up to a fifth of the points may be lost. One that turns by 6 may not.
void check_pair(const std::string& name, Kind kind, double degrees, double turn, double noise, std::size_t size)
{
  using scenes::Frame;
  constexpr double epsilon = .02;
  const double radians = degrees * .017453292519943295, w = turn * epsilon / (std::sin(radians) * (.8 + .6));
  if(noise > 2.5 * w / epsilon / std::sqrt(double(size)))
    return;
  // It is turned about an axis through its middle. The step is so high that the floor, extended, does not meet the
  // face.
  const Frame face = kind == Kind::right_angle
                       ? Frame().at({0, w + 3 * epsilon, 10 * epsilon}).with_axes({1, 0, 0}, {0, 0, 1})
                     : kind == Kind::parallel ? Frame().at({0, 0, w + 10 * epsilon})
                                              : Frame().at({w + 3 * epsilon, 0, (2.5 + .5 * turn) * epsilon});
  scenes::Model model;
  model.add_rectangle(Frame(), w, w);
  const Frame middle = face.at({w / 2, w / 2, 0}).turned({.8, .6, 0}, std::tan(radians / 2));
  model.add_rectangle(middle.at({-w / 2, -w / 2, 0}), w, w);
  const double diagonal = scenes::make_scene(model, scene_options(1000)).diagonal;
  const scenes::Scene scene = scenes::make_scene(model, scene_options(2 * size, noise * epsilon / diagonal));
  Parameters parameters = make_parameters(epsilon, 30); // few, so that strips are shapes
  parameters.cell_size = 2000;                          // many young shapes
  const Shapes shapes = detect(to_cloud(scene), parameters);
  const std::vector<int> faces = faces_of(scene, shapes);
  for(int f = 0; f < 2; ++f) {
    const std::string at = name + ", face " + std::to_string(f);
    check_equal(std::count(faces.begin(), faces.end(), f), 1, at + ": number of shapes");
    const std::size_t s = std::size_t(std::find(faces.begin(), faces.end(), f) - faces.begin());
    if(s == faces.size())
      continue;
    const auto points = shapes.points(s);
    const auto found = std::count_if(points.begin(), points.end(), [&](std::size_t i) { return scene.label[i] == f; });
    const double share = double(found) / double(std::count(scene.label.begin(), scene.label.end(), f));
    check(share >= .8, at + ": share", share);
    const auto& p = shapes.coefficients(s);
    const double sine = length(cross(scene.faces[std::size_t(f)].normal, scenes::Vec{p[0], p[1], p[2]}));
    check(turn < 6 || sine * w <= .5 * epsilon, at + ": the plane is turned by", sine * w / epsilon);
  }
}

// Off a right angle, off a parallel, or off one plane; the angle is small for some sizes and large for others.
BOOST_AUTO_TEST_CASE(test_relations_pay)
{
  for(Kind kind : {Kind::right_angle, Kind::parallel, Kind::step})
    for(double degrees : {.5, 3., 8.})
      for(double turn : {3., 6.})
        for(std::size_t size : {1000, 8000})
          for(double noise : {0., .33})
            check_pair("kind " + std::to_string(int(kind)) + ", " + std::to_string(degrees) + " degrees, turn " +
                         std::to_string(turn) + ", noise " + std::to_string(noise) + ", " + std::to_string(size),
                       kind, degrees, turn, noise, size);
}

BOOST_AUTO_TEST_SUITE_END()
