// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random scenes in which a guarantee is hard to keep: layers as far apart as the tolerance, ties, small faces, points
// that span no plane. With what makes it worse: outliers, duplicates, small and large units, far origins, coordinates and
// normals that are of no use; and any parameters. All of a case follows from its seed.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PROPERTY_CASE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PROPERTY_CASE_H

#include "test_support.h"

#include <cmath>
#include <limits>
#include <string>

struct Property_case {
  std::string name;
  Cloud cloud;
  Parameters parameters; // a length or size of 0 is to be estimated
  Given given;
};

class Case_maker {
public:
  explicit Case_maker(std::uint64_t seed) : random_(seed), epsilon_(log_between(.01, .3))
  {
    name_ = "seed " + std::to_string(seed);
  }

  Property_case make()
  {
    if(happens(.5))
      frame_ = turned_frame();
    make_family();
    add_outliers();
    add_duplicates();
    spoil_normals();
    change_units();
    spoil_coordinates();
    const Given given = happens(.3) ? Given::nothing : Given::normals;
    name_ += given == Given::nothing ? ", estimated normals, " : ", ";
    return {name_ + std::to_string(cloud_.size()) + " points", cloud_, draw_parameters(), given};
  }

  // A generated scene of 500 points or more, but less than 500 + more_points. Many have no shape: the tolerances are any.
  Property_case make_scene(std::size_t more_points)
  {
    const double noise = between(0, .003), outliers = between(0, .4);
    scenes::Options options = scene_options(500 + random_.bits() % more_points, noise, outliers);
    options.normals = happens(.5) ? scenes::Normals::exact : scenes::Normals::perturbed;
    options.seed = random_.bits();
    const std::vector<std::string> names = scenes::scene_names();
    const std::string& scene_name = names[random_.bits() % names.size()];
    const scenes::Scene scene = scenes::make_scene(scene_name, options);
    epsilon_ = scene.diagonal * std::ldexp(1, -3 - below(12));
    const Given given = happens(.5) ? Given::normals : Given::nothing;
    return {name_ + ": " + scene_name, to_cloud(scene), draw_parameters(), given};
  }

private:
  using Vec = scenes::Vec;

  double between(double low, double high) { return low + (high - low) * random_.uniform(); }
  // Any order of magnitude is as likely as another one.
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  bool happens(double probability) { return random_.uniform() < probability; }
  int below(int n) { return int(random_.bits() % std::uint64_t(n)); }

  // Coordinates of the frame of the scene.
  void add(const Vec& p, const Vec& n)
  {
    const Vec q = frame_.point(p), m = frame_.vector(n);
    cloud_.emplace_back(Kernel::Point_3(q.x, q.y, q.z), Kernel::Vector_3(m.x, m.y, m.z));
  }

  scenes::Frame turned_frame()
  {
    const Vec axis = random_.direction();
    return scenes::Frame().turned(axis, between(0, 2));
  }

  // A rectangle about `center` that is as wide as twice u and v, and `noise` thick.
  struct Patch {
    Vec center, u, v;
    double noise;
  };

  void add_patch(const Patch& patch, int points)
  {
    const Vec n = unit(cross(patch.u, patch.v));
    for(int i = 0; i < points; ++i) {
      const Vec r = {between(-1, 1), between(-1, 1), between(-1, 1)};
      const Vec p = add_scaled(add_scaled(patch.center, r.x, patch.u), r.y, patch.v);
      add(add_scaled(p, patch.noise * r.z, n), n);
    }
  }

  // Of width 2 a and 2 b, across n.
  Patch patch_across(const Vec& center, const Vec& n, double a, double b)
  {
    const Vec u = unit(cross(n, std::fabs(n.x) < .5 ? Vec{1, 0, 0} : Vec{0, 1, 0}));
    return {center, a * u, b * cross(n, u), epsilon_ * noise()};
  }

  // None, or less than epsilon, or more, so that points are at its bounds.
  double noise() { return happens(.3) ? 0 : happens(.5) ? between(0, .7) : between(.7, 2); }

  static Vec axis_vector(int axis) { return {double(axis == 0), double(axis == 1), double(axis == 2)}; }

  Vec tilted(const Vec& n, double degrees)
  {
    return unit(add_scaled(n, std::tan(degrees * 3.14159265358979 / 180), unit(cross(n, random_.direction()))));
  }

  void make_family()
  {
    using Maker = Case_maker;
    void (Maker::*const families[])() = {&Maker::make_layers,  &Maker::make_layers,     &Maker::make_lattice,
                                         &Maker::make_lattice, &Maker::make_box,        &Maker::make_box,
                                         &Maker::make_patches, &Maker::make_few_places, &Maker::make_degenerate,
                                         &Maker::make_fan,     &Maker::make_surface};
    (this->*families[below(int(std::size(families)))])();
  }

  // Parallel layers, .3 to 3 epsilon apart, some of them slanted.
  void make_layers()
  {
    name_ += ": layers";
    const int layers = 2 + below(4), points = 30 + below(250);
    const double gap = epsilon_ * between(.3, 3), width = log_between(.3, 3), slant = happens(.5) ? 0 : between(0, 4);
    for(int i = 0; i < layers; ++i) {
      const Vec center = {between(-.5, .5) * width, between(-.5, .5) * width, i * gap};
      const Vec n = tilted({0, 0, 1}, slant);
      add_patch(patch_across(center, n, width, width), points);
    }
  }

  // All distances are ties. epsilon is a multiple of a half of the spacing, so that points lie exactly on its bounds.
  void make_lattice()
  {
    name_ += ": lattice";
    if(happens(.7))
      frame_ = scenes::Frame();
    const int size[3] = {1 + below(20), 1 + below(20), 1 + below(6)};
    const bool is_hollow = happens(.5);
    epsilon_ = .5 * (1 + below(5));
    for(int i = 0; i < size[0] * size[1] * size[2]; ++i) {
      const int c[3] = {i % size[0], i / size[0] % size[1], i / size[0] / size[1]};
      int axis = 0; // of the first face that the point is on
      while(axis < 3 && c[axis] > 0 && c[axis] < size[axis] - 1)
        ++axis;
      if(!is_hollow || axis < 3)
        add({double(c[0]), double(c[1]), double(c[2])}, axis_vector(axis % 3));
    }
  }

  // Faces that are nearly parallel, orthogonal and coplanar.
  void make_box()
  {
    name_ += ": box";
    const double tilt = happens(.3) ? 0 : between(0, 9), step = happens(.3) ? 0 : epsilon_ * between(0, 3);
    for(int axis = 0; axis < 3; ++axis)
      for(int side = -1; side <= 1; side += 2)
        for(int part = 1 + below(3); part > 0; --part) {
          const Vec n = axis_vector(axis), m = tilted(n, tilt);
          const Vec center =
            add_scaled((side + step * between(-1, 1)) * n, 3 * (part - 1), axis_vector((axis + 1) % 3));
          const Patch patch = patch_across(center, m, .9, .9);
          add_patch(patch, 20 + below(120));
        }
  }

  // Many small faces in all directions, or in a few that are nearly the same.
  void make_patches()
  {
    name_ += ": patches";
    const int patches = 2 + below(30);
    const double spread = happens(.5) ? 0 : between(0, 20), room = log_between(.5, 10);
    const Vec directions[3] = {random_.direction(), random_.direction(), random_.direction()};
    for(int i = 0; i < patches; ++i) {
      const Vec n = happens(.2) ? random_.direction() : tilted(directions[below(3)], spread);
      const Vec center = room * random_.direction(), size = {between(.1, 1), between(.1, 1), 0};
      const Patch patch = patch_across(center, n, size.x, size.y);
      add_patch(patch, 8 + below(60));
    }
  }

  // Half planes around a line, at angles of a few degrees.
  void make_fan()
  {
    name_ += ": fan";
    const int blades = 2 + below(6), points = 40 + below(150);
    const double angle = between(.5, 40) * 3.14159265358979 / 180;
    for(int i = 0; i < blades; ++i) {
      const Vec out = {std::cos(i * angle), std::sin(i * angle), 0};
      add_patch({out, out, {0, 0, 1}, epsilon_ * noise()}, points);
    }
  }

  // Fewer places than points.
  void make_few_places()
  {
    name_ += ": few places";
    const int places = 1 + below(60);
    for(int i = 0; i < places; ++i) {
      const Vec p = happens(.7) ? Vec{between(0, 1), between(0, 1), 0} : random_.direction();
      for(int copies = 1 + below(40); copies > 0; --copies)
        add(p, happens(.7) ? Vec{0, 0, 1} : random_.direction());
    }
  }

  // Points that span no plane, or an exact one; and a few points or none.
  void make_degenerate()
  {
    name_ += ": degenerate";
    const int kind = below(4), points = kind == 3 ? below(8) : 1 + below(400);
    for(int i = 0; i < points; ++i) {
      const Vec p = {between(0, 1), between(0, 1), between(0, 1)}; // as many of them as the kind has dimensions
      const Vec n = happens(.9) ? Vec{0, 0, 1} : random_.direction();
      add({kind > 0 ? p.x : 0, kind > 1 ? p.y : 0, kind > 2 ? p.z : 0}, n);
    }
  }

  // A curved surface, or the inside of it.
  void make_surface()
  {
    name_ += ": surface";
    const double inside = happens(.5) ? 0 : 1;
    const Vec axes = {between(.2, 2), between(.2, 2), between(.2, 2)};
    for(int points = 100 + below(900); points > 0; --points) {
      const double radius = 1 - inside * random_.uniform();
      const Vec p = radius * random_.direction();
      add({axes.x * p.x, axes.y * p.y, axes.z * p.z}, unit(Vec{p.x / axes.x, p.y / axes.y, p.z / axes.z}));
    }
  }

  void add_outliers()
  {
    if(happens(.5))
      return;
    const double reach = log_between(1, 100);
    name_ += ", outliers";
    for(std::size_t count = std::size_t(between(0, .4) * double(cloud_.size())); count > 0; --count) {
      const Vec p = random_.direction(), n = random_.direction();
      add(reach * random_.uniform() * p, n);
    }
    if(happens(.1)) // the grid becomes coarse, or too coarse
      add({epsilon_ * std::ldexp(1, 12 + below(14)), 0, 0}, {0, 0, 1});
  }

  // Copies of points, or points that are nearer than the grid resolves.
  void add_duplicates()
  {
    if(happens(.8))
      return;
    name_ += ", duplicates";
    const double distance = happens(.5) ? 0 : epsilon_ * log_between(1e-9, 1e-2);
    for(std::size_t i = cloud_.size(); i > 0; --i) {
      const Vec d = distance * random_.direction();
      if(happens(.5))
        cloud_.emplace_back(cloud_[i - 1].first + Kernel::Vector_3(d.x, d.y, d.z), cloud_[i - 1].second);
    }
  }

  void spoil_normals()
  {
    const double noise = happens(.5) ? 0 : between(0, .6), probability = happens(.3) ? 1 : between(0, .2);
    const int kinds = 7, kind = happens(.5) ? below(kinds) : kinds;
    const bool are_spoiled = happens(.5);
    for(auto& item : cloud_) {
      const Vec e = noise * random_.direction();
      item.second = item.second + Kernel::Vector_3(e.x, e.y, e.z);
      if(are_spoiled && happens(probability))
        item.second = spoiled(item.second, kind < kinds ? kind : below(kinds));
    }
    name_ += are_spoiled ? ", bad normals" : "";
  }

  Kernel::Vector_3 spoiled(const Kernel::Vector_3& n, int kind)
  {
    switch(kind) {
    case 0:
      return Kernel::Vector_3(0, happens(.5) ? 0. : -0., 0);
    case 1:
      return Kernel::Vector_3(n.x(), std::numeric_limits<double>::quiet_NaN(), n.z());
    case 2:
      return Kernel::Vector_3(n.x(), n.y(), happens(.5) ? HUGE_VAL : -HUGE_VAL);
    case 3:
      return -n;
    case 4:
      return log_between(1e-5, 1e5) * n;
    case 5:
      return (happens(.5) ? 1e-200 : 1e200) * n;
    default: {
      const Vec other = random_.direction();
      return Kernel::Vector_3(other.x, other.y, other.z);
    }
    }
  }

  void change_units()
  {
    const double unit = happens(.4) ? 1 : happens(.3) ? std::ldexp(1, below(61) - 30) : log_between(1e-9, 1e9);
    const double distance = happens(.5) ? 0 : unit * log_between(1, 1e12);
    const Vec shift = distance * random_.direction();
    for(auto& item : cloud_)
      item.first = CGAL::ORIGIN + (unit * (item.first - CGAL::ORIGIN) + Kernel::Vector_3(shift.x, shift.y, shift.z));
    epsilon_ *= unit;
    name_ += unit == 1 ? "" : ", unit 10^" + std::to_string(std::log10(unit));
    name_ += distance == 0 ? "" : ", shift 10^" + std::to_string(std::log10(distance));
  }

  void spoil_coordinates()
  {
    if(happens(.8))
      return;
    name_ += ", bad coordinates";
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL};
    for(auto& item : cloud_)
      if(happens(.05))
        item.first = Kernel::Point_3(item.first.x(), bad[below(3)], item.first.z());
  }

  // Scenes are often along the axes.
  std::array<double, 3> draw_direction()
  {
    const Vec d = random_.direction();
    std::array<double, 3> direction = {0, 0, 0};
    direction[std::size_t(below(3))] = log_between(1e-200, 1e200);
    return happens(.6) ? direction : std::array<double, 3>{d.x, d.y, d.z};
  }

  Parameters draw_parameters()
  {
    Parameters p;
    p.maximum_distance = happens(.1) ? 0 : epsilon_;
    p.maximum_offset = happens(.5) ? p.maximum_distance : epsilon_ * between(0, 3);
    p.minimum_region_size = happens(.1) ? 0 : std::size_t(3 + below(happens(.5) ? 10 : 60));
    p.maximum_angle = happens(.5) ? 25 : between(1, 89.9);
    p.angle_tolerance = happens(.5) ? 8 : between(0, 44.9);
    p.simplicity = happens(.5) ? Parameters().simplicity : between(0, happens(.5) ? .2 : 1);
    p.regularity = happens(.5) ? .1 : between(0, happens(.5) ? 1 : 10);
    p.surfel_size = happens(.5) ? .55 : happens(.3) ? 0 : between(0, .55);
    p.k_neighbors = happens(.5) ? 12 : std::size_t(3 + below(40));
    p.cell_size = std::size_t(64) << below(8);
    p.regularize_parallelism = happens(.85);
    p.regularize_orthogonality = happens(.85);
    p.regularize_coplanarity = happens(.85);
    for(int count = happens(.4) ? 1 + below(3) : 0; count > 0; --count)
      p.fixed_directions.push_back(draw_direction());
    p.regularize_axis_symmetry = happens(.3);
    p.symmetry_direction = draw_direction();
    return p;
  }

  scenes::Random random_;
  double epsilon_;
  std::string name_;
  scenes::Frame frame_;
  Cloud cloud_;
};

// More than 2^24 times maximum_distance, up to rounding: then the detection throws.
inline bool is_too_wide(const Property_case& c)
{
  double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for(const auto& item : c.cloud)
    for(int k = 0; k < 3 && std::isfinite(item.first.x() + item.first.y() + item.first.z()); ++k) {
      low[k] = (std::min)(low[k], item.first[k]);
      high[k] = (std::max)(high[k], item.first[k]);
    }
  const double extent = (std::max)({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  return c.parameters.maximum_distance > 0 && extent > .999 * 0x1p24 * c.parameters.maximum_distance;
}

// f(case) for so many seeds. It throws only where the case is too wide.
template <class F>
void on_random_cases(std::uint64_t first, std::uint64_t count, F f)
{
  for(std::uint64_t seed = first; seed < first + count; ++seed) {
    const Property_case c = Case_maker(seed).make();
    try {
      f(c);
    } catch(const CGAL::Tandem::Parameter_error& e) {
      CHECK_AT(is_too_wide(c), c.name + ": " + e.what());
    } catch(const std::exception& e) {
      CHECK_AT(false, c.name + ": " + e.what());
    }
  }
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PROPERTY_CASE_H
