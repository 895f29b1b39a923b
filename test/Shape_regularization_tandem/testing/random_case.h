// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scene and parameters that no list of cases thinks of: all of it follows from a seed.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_CASE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_CASE_H

#include "test_support.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

struct Random_case {
  std::string name;
  Cloud cloud;
  Parameters parameters;
  Given given;
};

// Of 500 points or more, but less than 500 + more_points. Many have no shape: the tolerances are any.
inline Random_case make_random_case(std::uint64_t seed, std::size_t more_points)
{
  const std::vector<std::string>& names = scenes::scene_names();
  scenes::Random random(seed);
  const double outliers = .4 * random.uniform(), noise = .003 * random.uniform();
  scenes::Options options = scene_options(500 + random.bits() % more_points, noise, outliers);
  options.seed = seed;
  options.normals = random.bits() % 2 == 0 ? scenes::Normals::exact : scenes::Normals::perturbed;
  const scenes::Scene scene = scenes::make_scene(names[random.bits() % names.size()], options);
  const std::size_t minimum = 3 + random.bits() % 60;
  Parameters p = make_parameters(scene.diagonal * std::ldexp(1, -3 - int(random.bits() % 12)), minimum);
  p.maximum_angle = 1 + 88 * random.uniform();
  p.angle_tolerance = 44 * random.uniform();
  p.maximum_offset *= 3 * random.uniform();
  p.simplicity = .3 * random.uniform();
  p.regularity = .5 * random.uniform();
  p.surfel_size = random.bits() % 4 == 0 ? 0 : .55 * random.uniform();
  p.k_neighbors = 3 + random.bits() % 30;
  p.cell_size = 64 << random.bits() % 8;
  p.regularize_parallelism = random.bits() % 4 != 0;
  p.regularize_orthogonality = random.bits() % 4 != 0;
  p.regularize_coplanarity = random.bits() % 4 != 0;
  const Given given = random.bits() % 2 == 0 ? Given::normals : Given::nothing;
  if(random.bits() % 2 == 0)
    p.fixed_directions = {{0, 0, 1}};
  p.regularize_axis_symmetry = random.bits() % 4 == 0;
  return {"random case " + std::to_string(seed), to_cloud(scene), p, given};
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_RANDOM_CASE_H
