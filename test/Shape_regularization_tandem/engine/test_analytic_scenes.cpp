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

// A scene, with normals that are given, and with estimated ones in many cells.
void check_scene(const std::string& name, const scenes::Model& model, const scenes::Options& options, double epsilon,
                 const Expected& e)
{
  const scenes::Scene scene = scenes::make_scene(model, options);
  const Cloud cloud = to_cloud(scene);
  for(Given given : {Given::normals, Given::nothing}) {
    const std::string full = name + (given == Given::normals ? ", given normals" : ", no normals");
    Parameters parameters = make_parameters(epsilon, 100);
    parameters.cell_size = given == Given::normals ? 8192 : 500;
    const Shapes shapes = detect_valid(full, cloud, parameters, given);
    check_expected(full, shapes, e);
    check_planes(full, scene, shapes, 3, epsilon);
    CHECK_AT(shapes.statistics().coverage > .9, full + ": coverage " + std::to_string(shapes.statistics().coverage));
  }
}

BOOST_AUTO_TEST_CASE(test_clean_scenes)
{
  const scenes::Options clean = scene_options(12000);
  check_scene("cube", scenes::make_cube(), clean, .01, {6, 3, 6, 3, 9});
  check_scene("staircase", scenes::make_staircase(), clean, .01, {16, 2, 16, 1, 19});
  check_scene("squares with a gap", scenes::make_squares(.5), clean, .01, {2, 1, 1, 0, 3});
  check_scene("squares that touch", scenes::make_squares(0), clean, .01, {1, 1, 1, 0, 3});
  check_scene("slope", scenes::make_slope(), clean, .02, {3, 2, 2, 0, 6});
  check_scene("chained", scenes::make_chained(), clean, .01, {3, 3, 3, 0, 9});
  check_scene("two followers", scenes::make_two_followers(), clean, .02, {3, 3, 3, 2, 7});
  check_scene("pair of a tenth of epsilon", scenes::make_offset_pair(.001), clean, .01, {2, 1, 1, 0, 3});
  check_scene("pair of half epsilon", scenes::make_offset_pair(.005), clean, .01, {2, 1, 2, 0, 4});
  check_scene("pair of three epsilon", scenes::make_offset_pair(.03), clean, .01, {2, 1, 2, 0, 4});
}

BOOST_AUTO_TEST_CASE(test_noisy_scenes)
{
  const scenes::Options noisy = scene_options(12000, .001);
  check_scene("noisy cube", scenes::make_cube(scenes::Frame().turned({1, 2, 3}, .3)), noisy, .007, {6, 3, 6, 3, 9});
  check_scene("noisy staircase", scenes::make_staircase(), noisy, .015, {16, 2, 16, 1, 19});
}

// With noise a plane may end up across the edge between the flat and the slope, so here
// most of the seeds have to be right, and none may be cut into terraces.
BOOST_AUTO_TEST_CASE(test_noisy_slope)
{
  int right = 0, runs = 0;
  for(std::uint64_t seed = 1; seed <= 5; ++seed) {
    scenes::Options options = scene_options(12000, .0005);
    options.seed = seed;
    const Cloud cloud = to_cloud(scenes::make_scene("slope", options));
    for(Given given : {Given::normals, Given::nothing}) {
      const std::string name = "noisy slope, seed " + std::to_string(seed);
      const Shapes shapes = detect_valid(name, cloud, make_parameters(.02, 100), given);
      CHECK_AT(shapes.number_of_shapes() <= 4, name + ": " + std::to_string(shapes.number_of_shapes()) + " shapes");
      right += shapes.number_of_shapes() == 3 && shapes.number_of_parallel_groups() == 2;
      ++runs;
    }
  }
  CHECK_AT(4 * right >= 3 * runs, std::to_string(right) + " of " + std::to_string(runs) + " noisy slopes");
}

// Faces that are 2 degrees off: one frame, of which all three pairs are orthogonal, and the siblings too.
BOOST_AUTO_TEST_CASE(test_tilted_cube)
{
  const scenes::Scene scene = scenes::make_scene(scenes::make_tilted_cube(.5), scene_options(12000, .002));
  const Cloud cloud = to_cloud(scene);
  for(Given given : {Given::normals, Given::nothing}) {
    const std::string name = given == Given::normals ? "tilted cube" : "tilted cube without normals";
    const Shapes shapes = detect_valid(name, cloud, make_parameters(.04, 100), given);
    check_expected(name, shapes, {6, 3, 6, 3, 9});
    check_planes(name, scene, shapes, 4.1, .06);
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

// Nothing planar: no plane is made up, and curved surfaces keep all promises. (Estimated
// normals of a volume whose spacing, here .04, is that of a slab of two epsilons do make planes.)
BOOST_AUTO_TEST_CASE(test_without_planes)
{
  const Cloud noise = to_cloud(scenes::make_scene("noise", scene_options(15000)));
  for(Given given : {Given::normals, Given::nothing})
    for(double epsilon : {.005, given == Given::normals ? .03 : .01}) {
      const std::string name = "noise, epsilon " + std::to_string(epsilon);
      check_counts(name, detect_valid(name, noise, make_parameters(epsilon, 50), given), 0, 0, 0);
    }
  const Cloud sphere = to_cloud(scenes::make_scene("sphere", scene_options(10000)));
  for(double beta : {0., 44.})
    for(Given given : {Given::normals, Given::nothing}) {
      Parameters parameters = make_parameters(.01, 50);
      parameters.angle_tolerance = beta;
      detect_valid("sphere, angle tolerance " + std::to_string(beta), sphere, parameters, given);
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

// A wall that was scanned on both sides, with normals to either side, is two shapes, also where both are closer than
// the points of one. Normals of random sides have none, and some wrong ones among them do no harm.
struct Wall {
  int sides;
  double gap, noise;
  double turned;     // share of wrong normals
  int points = 2000; // of a side
};

// The rectangle of each side is 4 by 2.5 units.
Cloud make_wall(const Wall& wall, std::uint64_t seed)
{
  scenes::Random random(seed);
  const scenes::Vec n = random.direction(), u = scenes::unit(scenes::cross(n, random.direction())),
                    v = scenes::cross(n, u);
  Cloud cloud;
  for(int side = 0; side < wall.sides; ++side)
    for(int i = 0; i < wall.points; ++i) {
      const scenes::Vec p = (wall.gap * side + wall.noise * random.gaussian()) * n + (4 * random.uniform()) * u +
                            (2.5 * random.uniform()) * v;
      const bool is_turned = (random.uniform() < wall.turned) != (side == 1);
      add(cloud, p, (is_turned ? -1. : 1.) * n);
    }
  return cloud;
}

void check_wall(const std::string& name, const Cloud& cloud, double epsilon, std::size_t sides, double coverage)
{
  const Shapes shapes = detect_valid(name, cloud, make_parameters(epsilon, 50));
  check_equal(shapes.number_of_shapes(), sides, name + ": shapes");
  CHECK_AT(shapes.statistics().coverage > coverage,
           name + ": coverage " + std::to_string(shapes.statistics().coverage));
  for(std::size_t i = 0; i < cloud.size() && shapes.number_of_shapes() == sides; ++i)
    if(shapes.shape_index(i) >= 0)
      CHECK_AT(sides == 1 || (shapes.shape_index(i) == shapes.shape_index(0)) == (i < cloud.size() / 2) ||
                 shapes.shape_index(0) < 0,
               name + ": points of both sides in one shape");
}

BOOST_AUTO_TEST_CASE(test_thin_walls)
{
  for(std::uint64_t seed = 1; seed <= 3; ++seed) {
    const std::string of = ", seed " + std::to_string(seed);
    check_wall("closer than the spacing" + of, make_wall({2, .04, .004, 0}, seed), .01, 2, .95);
    check_wall("far apart" + of, make_wall({2, .12, .005, 0}, seed), .015, 2, .97);
    check_wall("with some wrong sides" + of, make_wall({2, .04, .004, .06}, seed), .01, 2, .85);
    check_wall("one side" + of, make_wall({1, 0, .004, 0}, seed), .015, 1, .97);
    check_wall("random sides" + of, make_wall({1, 0, .004, .5}, seed), .015, 1, .97);
    check_wall("some wrong sides" + of, make_wall({1, 0, .004, .05}, seed), .015, 1, .97);
  }
  // Some 30 points are one surfel, beside one of those whose normals are wrong.
  check_wall("dense, with some wrong sides", make_wall({2, .35, .02, .03, 60000}, 7), .2, 2, .96);
}

// A relation must not make a face fall into strips. Two faces are a little off a right angle, off a parallel, or off one
// plane; the angle is small for some sizes and large for others. Each face has to be one shape, with a plane of its own
// where its points do not accept the direction of the other one.
constexpr double epsilon = .02;
constexpr std::size_t minimum_size = 30; // small, so that strips are shapes

enum class Kind { right_angle, parallel, step };

struct Pair_case {
  Kind kind;
  double degrees; // off the relation
  double turn;    // how far one end of the face is then from the related plane through the other end, in epsilons
  double noise;   // sigma, in epsilons
  int size;       // points of each face

  double radians() const { return degrees * .017453292519943295; }

  double width() const { return turn * epsilon / (std::sin(radians()) * (.8 + .6)); }

  // In epsilons.
  double spacing() const { return width() / epsilon / std::sqrt(double(size)); }

  std::string name() const
  {
    static const char* const kinds[] = {"a right angle", "a parallel", "a step"};
    return std::to_string(degrees) + " degrees off " + kinds[int(kind)] + ", turned by " + std::to_string(turn) +
           " epsilon, noise " + std::to_string(noise) + ", " + std::to_string(size) + " points";
  }
};

// A floor and a face of the same size, which is turned about an axis through its middle. The step is high enough that
// the floor, extended, does not meet the face.
scenes::Model make_pair_model(const Pair_case& c)
{
  using scenes::Frame;
  const double w = c.width();
  Frame face = Frame().at({0, 0, w + 10 * epsilon});
  if(c.kind == Kind::right_angle)
    face = Frame().at({0, w + 3 * epsilon, 10 * epsilon}).with_axes({1, 0, 0}, {0, 0, 1});
  else if(c.kind == Kind::step)
    face = Frame().at({w + 3 * epsilon, 0, (2.5 + .5 * c.turn) * epsilon});
  scenes::Model model;
  model.add_rectangle(Frame(), w, w);
  const Frame middle = face.at({w / 2, w / 2, 0}).turned({.8, .6, 0}, std::tan(c.radians() / 2));
  model.add_rectangle(middle.at({-w / 2, -w / 2, 0}), w, w);
  return model;
}

scenes::Scene make_pair_scene(const Pair_case& c)
{
  const scenes::Model model = make_pair_model(c);
  scenes::Options options = scene_options(std::size_t(2 * c.size));
  const double diagonal = scenes::make_scene(model, scene_options(1000)).diagonal;
  options.noise = c.noise * epsilon / diagonal;
  return scenes::make_scene(model, options);
}

// A face that turns by 3 epsilon from end to end may share a direction: each face then turns by half of that, and up to
// a fifth of the points may be lost. One that turns by 6 may not.
void check_pair(const Pair_case& c)
{
  const scenes::Scene scene = make_pair_scene(c);
  Parameters parameters = make_parameters(epsilon, minimum_size);
  parameters.cell_size = 2000; // many young shapes
  const Shapes shapes = detect(to_cloud(scene), parameters);
  const std::vector<int> faces = faces_of(scene, shapes);
  for(int f = 0; f < 2; ++f) {
    const std::string at = c.name() + ", face " + std::to_string(f);
    check_equal(std::count(faces.begin(), faces.end(), f), 1, at + ": number of shapes");
    const std::size_t s = std::size_t(std::find(faces.begin(), faces.end(), f) - faces.begin());
    if(s == faces.size())
      continue;
    const auto points = shapes.points(s);
    const auto found = std::count_if(points.begin(), points.end(), [&](std::size_t i) { return scene.label[i] == f; });
    const double share = double(found) / double(std::count(scene.label.begin(), scene.label.end(), f));
    CHECK_AT(share >= .8, at + ": share " + std::to_string(share));
    const auto& p = shapes.coefficients(s);
    const double sine = length(cross(scene.faces[std::size_t(f)].normal, scenes::Vec{p[0], p[1], p[2]}));
    const double turn = sine * c.width() / epsilon;
    CHECK_AT(c.turn < 6 || turn <= .5, at + ": the plane is turned by " + std::to_string(turn) + " epsilon");
  }
}

// Noise of several spacings makes a slab, of which the outer points are surfaces of their own: such cases are left out.
BOOST_AUTO_TEST_CASE(test_relations_pay)
{
  for(Kind kind : {Kind::right_angle, Kind::parallel, Kind::step})
    for(double degrees : {.5, 3., 8.})
      for(double turn : {3., 6.})
        for(int size : {1000, 8000})
          for(double noise : {0., .33})
            if(const Pair_case c = {kind, degrees, turn, noise, size}; noise <= 2.5 * c.spacing())
              check_pair(c);
}

BOOST_AUTO_TEST_SUITE_END()
