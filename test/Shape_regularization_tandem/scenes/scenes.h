// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Point clouds with ground truth, sampled from the models of scene_model.h: with noise, outliers, the density of a scanner, and
// normals that are exact, perturbed, or absent. The same options give the same
// bits on every machine. (Normals as a neighborhood fit blends them at edges: scene_normals.h.)

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENES_H

#include "scene_model.h"

#include <stdexcept>
#include <string>

namespace CGAL::Tandem::scenes {

class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  // Splitmix64.
  std::uint64_t bits()
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  // In [0, 1).
  double uniform() { return double(bits() >> 11) * 0x1p-53; }

  // The sum of twelve uniform numbers: no logarithm, so the same everywhere; within +-6.
  double gaussian()
  {
    double sum = -6;
    for(int i = 0; i < 12; ++i)
      sum += uniform();
    return sum;
  }

  Vec gaussian_vector()
  {
    double x = gaussian(), y = gaussian();
    return {x, y, gaussian()};
  }

  Vec direction()
  {
    for(;;) {
      Vec v{2 * uniform() - 1, 2 * uniform() - 1, 2 * uniform() - 1};
      double l = dot(v, v);
      if(l <= 1 && l > 1e-4)
        return unit(v);
    }
  }

private:
  std::uint64_t state_;
};

enum class Normals { none, exact, perturbed };

struct Options {
  std::size_t points = 20000;
  double noise = 0;            // sigma, as a fraction of the diagonal
  double outliers = 0;         // ratio of the points
  bool varies_density = false; // falls with the squared distance to the nearest scanner
  Normals normals = Normals::exact;
  double normal_noise_deg = 5; // sigma for Normals::perturbed
  std::uint64_t seed = 1;
};

using Truth_face = Plane;

struct Scene {
  std::vector<Vec> points;
  std::vector<Vec> ideal;          // the same points without noise
  std::vector<Vec> normals;        // empty if there are none
  std::vector<std::int32_t> label; // index of the face, -1 on curved patches and outliers
  std::vector<Truth_face> faces;
  double diagonal = 0;
};

Vec perturbed(const Vec& normal, double degrees, Random& random);

Scene make_scene(const Model& model, const Options& options);

std::vector<std::string> scene_names();

Model make_model(const std::string& name);

Scene make_scene(const std::string& name, const Options& options);

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENES_H
