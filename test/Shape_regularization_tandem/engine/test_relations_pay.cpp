// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A relation must not make a face fall into strips. Two faces are a little off a right angle, off a parallel, or off one
// plane; the angle is small for some sizes and large for others. Each face has to be one shape, with a plane of its own
// where its points do not accept the direction of the other one.

#include "testing/test_support.h"

#include <cmath>

BOOST_AUTO_TEST_SUITE(test_relations_pay)

constexpr double epsilon = .02;
constexpr std::size_t minimum_size = 30; // small, so that strips are shapes

enum class Kind { right_angle, parallel, step };

struct Case {
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
scenes::Model make_pair(const Case& c)
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

scenes::Scene make_scene(const Case& c)
{
  const scenes::Model model = make_pair(c);
  scenes::Options options = scene_options(std::size_t(2 * c.size));
  const double diagonal = scenes::make_scene(model, scene_options(1000)).diagonal;
  options.noise = c.noise * epsilon / diagonal;
  return scenes::make_scene(model, options);
}

// What was found of a face.
struct Found {
  std::size_t shapes = 0; // with most of their points on it
  std::size_t largest = 0;
  double share = 0; // of its points, in the largest one
};

std::vector<Found> find_faces(const scenes::Scene& scene, const Shapes& shapes)
{
  std::vector<Found> found(scene.faces.size());
  std::vector<double> size(scene.faces.size(), 0);
  for(int face : scene.label)
    ++size[std::size_t(face)];
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    std::vector<double> count(scene.faces.size(), 0);
    for(std::size_t i : shapes.points(s))
      ++count[std::size_t(scene.label[i])];
    const std::size_t face = std::size_t(std::max_element(count.begin(), count.end()) - count.begin());
    ++found[face].shapes;
    if(count[face] > found[face].share * size[face])
      found[face] = {found[face].shapes, s, count[face] / size[face]};
  }
  return found;
}

// A face that turns by 3 epsilon from end to end may share a direction: each face then turns by half of that, and up to
// a fifth of the points may be lost. One that turns by 6 may not.
void check_case(const Case& c)
{
  const scenes::Scene scene = make_scene(c);
  Parameters parameters = make_parameters(epsilon, minimum_size);
  parameters.cell_size = 2000; // many young shapes
  const Shapes shapes = detect(to_cloud(scene), parameters);
  const std::vector<Found> found = find_faces(scene, shapes);
  for(std::size_t f = 0; f < found.size(); ++f) {
    const std::string at = c.name() + ", face " + std::to_string(f);
    check_equal(found[f].shapes, 1u, at + ": number of shapes");
    CHECK_AT(found[f].share >= .8, at + ": share " + std::to_string(found[f].share));
    if(c.turn < 6 || found[f].shapes == 0)
      continue;
    const auto& p = shapes.coefficients(found[f].largest);
    const double turn =
      scenes::length(scenes::cross(scene.faces[f].normal, scenes::Vec{p[0], p[1], p[2]})) * c.width() / epsilon;
    CHECK_AT(turn <= .5, at + ": the plane is turned by " + std::to_string(turn) + " epsilon");
  }
}

// Large faces take long: a few of the angles will do.
std::vector<int> sizes(double degrees)
{
  if(degrees == .5 || degrees == 3 || degrees == 8)
    return {1000, 4000, 16000, 60000};
  return {1000, 4000, 16000};
}

// Noise of several spacings makes a slab, of which the outer points are surfaces of their own: such cases are left out.
BOOST_AUTO_TEST_CASE(all_cases)
{
  for(Kind kind : {Kind::right_angle, Kind::parallel, Kind::step})
    for(double degrees : {.5, 1., 2., 3., 4., 5., 6., 7., 8.})
      for(double turn : {3., 6.})
        for(int size : sizes(degrees))
          for(double noise : {0., size < 60000 ? .33 : .25})
            if(const Case c = {kind, degrees, turn, noise, size}; noise <= 2.5 * c.spacing())
              check_case(c);
}

BOOST_AUTO_TEST_SUITE_END()
