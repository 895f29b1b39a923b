// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenes.h"

namespace CGAL::Tandem::scenes {

namespace {

struct Bounds {
  Vec low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const Vec& p)
  {
    low = {(std::min)(low.x, p.x), (std::min)(low.y, p.y), (std::min)(low.z, p.z)};
    high = {(std::max)(high.x, p.x), (std::max)(high.y, p.y), (std::max)(high.z, p.z)};
  }
};

Bounds bounds(const Model& model)
{
  Bounds b;
  for(const Face& face : model.faces)
    for(const auto& triangle : face.triangles)
      for(const Vec& p : triangle)
        b.add(p);
  for(const Curved& c : model.curved) {
    Vec r{c.radius, c.radius, c.radius};
    for(const Vec& center : {c.frame.origin, c.frame.point({0, 0, c.height})}) {
      b.add(center - r);
      b.add(center + r);
    }
  }
  return b;
}

// Draws points uniformly over the area of the visible surface.
class Sampler {
public:
  struct Sample {
    Vec point, normal;
    std::int32_t label;
  };

  Sampler(const Model& model, const Options& options, double diagonal)
    : model_(model), varies_density_(options.varies_density), margin_(1e-9 * diagonal), reach_(0.15 * diagonal)
  {
    for(std::size_t f = 0; f < model.faces.size(); ++f)
      for(const auto& t : model.faces[f].triangles)
        add_patch(f, &t, length(cross(t[1] - t[0], t[2] - t[0])) / 2);
    for(std::size_t c = 0; c < model.curved.size(); ++c) {
      const Curved& curved = model.curved[c];
      double height = curved.height == 0 ? 2 * curved.radius : curved.height;
      add_patch(c, nullptr, 6.283185307179586 * curved.radius * height);
    }
  }

  Sample draw(Random& random) const
  {
    for(;;) {
      double area = random.uniform() * cumulated_.back();
      std::size_t i = std::upper_bound(cumulated_.begin(), cumulated_.end(), area) - cumulated_.begin();
      i = (std::min)(i, patches_.size() - 1);
      bool is_planar = patches_[i].triangle != nullptr;
      Sample sample = is_planar ? on_face(patches_[i], random) : on_curved(model_.curved[patches_[i].index], random);
      if(random.uniform() < visibility(sample) && !(is_planar && model_.is_hidden(sample.point, margin_)))
        return sample;
    }
  }

private:
  struct Patch {
    std::size_t index;
    const std::array<Vec, 3>* triangle; // null: a curved patch
  };

  void add_patch(std::size_t index, const std::array<Vec, 3>* triangle, double area)
  {
    patches_.push_back({index, triangle});
    cumulated_.push_back(area + (cumulated_.empty() ? 0 : cumulated_.back()));
  }

  Sample on_face(const Patch& patch, Random& random) const
  {
    const auto& t = *patch.triangle;
    double u = random.uniform(), v = random.uniform();
    if(u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    Vec p = add_scaled(add_scaled(t[0], u, t[1] - t[0]), v, t[2] - t[0]);
    const Face& face = model_.faces[patch.index];
    if(face.bend.sag == 0)
      return {p, face.normal, std::int32_t(patch.index)};
    return {add_scaled(p, face.bend.height(p), face.normal), face.bend.normal(p, face.normal),
            std::int32_t(patch.index)};
  }

  static Sample on_curved(const Curved& curved, Random& random)
  {
    Vec n = random.direction();
    double along = 0;
    if(curved.height > 0) {
      n = unit({n.x, n.y, 0});
      along = random.uniform() * curved.height;
    }
    Vec p = curved.frame.point(add_scaled({0, 0, along}, curved.radius, n));
    return {p, (curved.is_hole ? -1.0 : 1.0) * curved.frame.vector(n), -1};
  }

  double visibility(const Sample& sample) const
  {
    if(!varies_density_ || model_.scanners.empty())
      return 1;
    double best = 0.02;
    for(const Vec& scanner : model_.scanners) {
      Vec ray = scanner - sample.point;
      double distance = length(ray), cosine = dot(ray, sample.normal) / distance;
      best = (std::max)(best, cosine * (reach_ * reach_) / (distance * distance));
    }
    return best;
  }

  const Model& model_;
  bool varies_density_;
  double margin_, reach_;
  std::vector<Patch> patches_;
  std::vector<double> cumulated_; // area up to and with each patch
};

} // namespace

Vec perturbed(const Vec& normal, double degrees, Random& random)
{
  return unit(add_scaled(normal, degrees * 0.017453292519943295, random.gaussian_vector()));
}

Scene make_scene(const Model& model, const Options& options)
{
  Scene scene;
  Random random(options.seed);
  Bounds box = bounds(model);
  scene.diagonal = length(box.high - box.low);
  scene.faces.assign(model.faces.begin(), model.faces.end());
  Sampler sampler(model, options, scene.diagonal);
  Vec extent = box.high - box.low;
  for(std::size_t i = 0; i < options.points; ++i) {
    Sampler::Sample s{};
    if(random.uniform() < options.outliers) {
      Vec t{std::fma(1.1, random.uniform(), -0.05), std::fma(1.1, random.uniform(), -0.05),
            std::fma(1.1, random.uniform(), -0.05)};
      s = {{std::fma(t.x, extent.x, box.low.x), std::fma(t.y, extent.y, box.low.y), std::fma(t.z, extent.z, box.low.z)},
           random.direction(),
           -1};
    } else {
      s = sampler.draw(random);
      if(options.normals == Normals::perturbed)
        s.normal = perturbed(s.normal, options.normal_noise_deg, random);
    }
    scene.ideal.push_back(s.point);
    scene.points.push_back(add_scaled(s.point, options.noise * scene.diagonal, random.gaussian_vector()));
    scene.label.push_back(s.label);
    if(options.normals != Normals::none)
      scene.normals.push_back(s.normal);
  }
  return scene;
}

namespace {

struct Named_model {
  const char* name;
  Model (*make)();
};
constexpr Named_model models[] = {{"house", make_house},
                                  {"village", make_village},
                                  {"indoor", make_indoor},
                                  {"part", make_part},
                                  {"cube", [] { return make_cube(); }},
                                  {"tilted_cube", [] { return make_tilted_cube(); }},
                                  {"staircase", [] { return make_staircase(); }},
                                  {"squares_gap", [] { return make_squares(.5); }},
                                  {"squares_touching", [] { return make_squares(0); }},
                                  {"slope", [] { return make_slope(); }},
                                  {"chained", [] { return make_chained(); }},
                                  {"two_followers", make_two_followers},
                                  {"offset_pair", [] { return make_offset_pair(.05); }},
                                  {"sphere", make_sphere},
                                  {"noise", [] { return make_cube(); }}, // where it is
                                  {"curved", make_curved},
                                  {"bent_hall", make_bent_hall},
                                  {"bent_road", make_bent_road}};

} // namespace

std::vector<std::string> scene_names()
{
  std::vector<std::string> names;
  for(const Named_model& model : models)
    names.push_back(model.name);
  return names;
}

Model make_model(const std::string& name)
{
  for(const Named_model& model : models)
    if(model.name == name)
      return model.make();
  throw std::invalid_argument("unknown scene: " + name);
}

Scene make_scene(const std::string& name, const Options& options)
{
  if(name != "noise")
    return make_scene(make_model(name), options);
  Options all = options; // uniform noise in the unit cube, without any surface
  all.outliers = 2;
  Scene scene = make_scene(make_cube(), all);
  scene.faces.clear();
  return scene;
}

} // namespace CGAL::Tandem::scenes
