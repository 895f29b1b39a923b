// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A random scene with what makes it worse: outliers, duplicates, small and large units, far origins, coordinates and
// normals that are of no use; and any parameters.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PROPERTY_CASE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PROPERTY_CASE_H

#include "property_scene.h"

#include <limits>

struct Property_case {
  std::string name;
  Cloud cloud;
  Parameters parameters; // a length or size of 0 is to be estimated
  Given given;
};

class Case_maker : private Property_scene {
public:
  using Property_scene::Property_scene;

  Property_case make()
  {
    add_outliers();
    add_duplicates();
    spoil_normals();
    change_units();
    spoil_coordinates();
    const Given given = happens(.3) ? Given::nothing : Given::normals;
    name_ += given == Given::nothing ? ", estimated normals, " : ", ";
    return {name_ + std::to_string(cloud_.size()) + " points", cloud_, draw_parameters(), given};
  }

private:
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
    const double noise = happens(.5) ? 0 : between(0, .6), share = happens(.3) ? 1 : between(0, .2);
    const int kinds = 7, kind = happens(.5) ? below(kinds) : kinds;
    const bool are_spoiled = happens(.5);
    for(auto& item : cloud_) {
      const Vec e = noise * random_.direction();
      item.second = item.second + Kernel::Vector_3(e.x, e.y, e.z);
      if(are_spoiled && happens(share))
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
    p.simplicity = happens(.5) ? .04 : between(0, happens(.5) ? .2 : 1);
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
};

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_PROPERTY_CASE_H
