// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scenes whose shapes, directions and planes are known: the result has to be exactly that.

#include "testing/test_support.h"

#include <cmath>

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

// A scene, with normals that are given and estimated, in one cell and in many.
void test_scene(const std::string& name, const scenes::Model& model, const scenes::Options& options, double epsilon,
                const Expected& e)
{
  const scenes::Scene scene = scenes::make_scene(model, options);
  const Cloud cloud = to_cloud(scene);
  for(Given given : {Given::normals, Given::nothing})
    for(std::size_t cell_size : {std::size_t(8192), std::size_t(500)}) {
      const std::string full = name +
                               (given == Given::normals ? ", given normals, cells of " : ", no normals, cells of ") +
                               std::to_string(cell_size);
      Parameters parameters = make_parameters(epsilon, 100);
      parameters.cell_size = cell_size;
      const Shapes shapes = detect_valid(full, cloud, parameters, given);
      check_expected(full, shapes, e);
      check_planes(full, scene, shapes, 3, epsilon);
      CHECK_AT(shapes.statistics().coverage > .9, full + ": coverage " + std::to_string(shapes.statistics().coverage));
    }
}

BOOST_AUTO_TEST_CASE(test_clean_scenes)
{
  const scenes::Options clean = scene_options(12000);
  test_scene("cube", scenes::make_cube(), clean, .01, {6, 3, 6, 3, 9});
  test_scene("staircase", scenes::make_staircase(), clean, .01, {16, 2, 16, 1, 19});
  test_scene("squares with a gap", scenes::make_squares(.5), clean, .01, {2, 1, 1, 0, 3});
  test_scene("squares that touch", scenes::make_squares(0), clean, .01, {1, 1, 1, 0, 3});
  test_scene("slope", scenes::make_slope(), clean, .02, {3, 2, 2, 0, 6});
  test_scene("chained", scenes::make_chained(), clean, .01, {3, 3, 3, 0, 9});
  test_scene("two followers", scenes::make_two_followers(), clean, .02, {3, 3, 3, 2, 7});
  test_scene("pair of a tenth of epsilon", scenes::make_offset_pair(.001), clean, .01, {2, 1, 1, 0, 3});
  test_scene("pair of half epsilon", scenes::make_offset_pair(.005), clean, .01, {2, 1, 2, 0, 4});
  test_scene("pair of three epsilon", scenes::make_offset_pair(.03), clean, .01, {2, 1, 2, 0, 4});
}

BOOST_AUTO_TEST_CASE(test_noisy_scenes)
{
  const scenes::Options noisy = scene_options(12000, .001);
  test_scene("noisy cube", scenes::make_cube(scenes::Frame().turned({1, 2, 3}, .3)), noisy, .007, {6, 3, 6, 3, 9});
  test_scene("noisy staircase", scenes::make_staircase(), noisy, .015, {16, 2, 16, 1, 19});
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
    for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
      for(std::size_t t = 0; t < s; ++t) {
        const auto &a = shapes.coefficients(s), &b = shapes.coefficients(t);
        const double d = std::fabs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
        CHECK_AT(shapes.are_parallel(s, t) || d <= 1e-15, name + ": the dot product is " + std::to_string(d));
      }
  }
}

// Chained angles: whatever is made parallel, no plane is turned by more than the tolerance.
BOOST_AUTO_TEST_CASE(test_chain_does_not_drift)
{
  const scenes::Scene scene = scenes::make_scene(scenes::make_chained(5, 6), scene_options(12000));
  for(double epsilon : {.01, .04, .1, .3}) {
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
  auto check_none = [&](Given given, double epsilon) {
    const std::string name =
      (given == Given::normals ? "noise, epsilon " : "noise without normals, epsilon ") + std::to_string(epsilon);
    check_equal(detect_valid(name, noise, make_parameters(epsilon, 50), given).number_of_shapes(), 0u,
                name + ": number of shapes");
  };
  for(double epsilon : {.005, .01, .03})
    check_none(Given::normals, epsilon);
  for(double epsilon : {.002, .005, .01})
    check_none(Given::nothing, epsilon);
  const Cloud sphere = to_cloud(scenes::make_scene("sphere", scene_options(15000)));
  for(double beta : {0., 8., 44.})
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
  for(double noise : {0., .00003}) {
    const scenes::Scene scene = scenes::make_scene("village", scene_options(150000, noise));
    const std::string name = "village, noise " + std::to_string(noise);
    const Shapes shapes = detect_valid(name, to_cloud(scene), make_parameters(.02, 45));
    check_equal(shapes.number_of_parallel_groups(), 65u, name + ": number of directions");
    check_equal(shapes.number_of_shapes(), scene.faces.size(), name + ": number of shapes");
    check_planes(name, scene, shapes, .5, .03);
  }
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

BOOST_AUTO_TEST_SUITE_END()
