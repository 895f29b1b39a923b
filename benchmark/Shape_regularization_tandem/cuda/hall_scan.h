// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulated laser scan of any size: a turned hall with boxes, seen from twelve
// stations, with 3 mm of range noise, normals that lean by about 3 degrees, and
// outliers. Each point depends on its number alone, so all processors can work.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_HALL_SCAN_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_HALL_SCAN_H

#include "scenes/scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL::Tandem::benchmark {

class Hall_scan {
public:
  struct Sample {
    double position[3], normal[3];
  };

  explicit Hall_scan(std::uint64_t seed = 1, int boxes = 60, double outliers = 0.02) : seed_(seed), outliers_(outliers)
  {
    Dice dice(seed);
    boxes_.push_back({{0, 0, 7.5}, {30, 20, 7.5}, 1, 0, true});
    for(int i = 1; i < boxes; ++i) {
      const double size = 0.15 * std::pow(30, dice.uniform());
      const double turn = dice.uniform() < 0.6 ? 0 : 3.14159265 * dice.uniform();
      const Box box = {{dice.uniform(-28, 28), dice.uniform(-18, 18), 0},
                       {size, 0.1 + dice.uniform() * size, 0.1 + dice.uniform() * (std::min)(size, 4.)},
                       std::cos(turn),
                       std::sin(turn)};
      boxes_.push_back(box);
      boxes_.back().center[2] = dice.uniform() < 0.7 ? box.half[2] : dice.uniform(0, 13);
    }
    for(double(&s)[3] : stations_) {
      s[0] = dice.uniform(-27, 27);
      s[1] = dice.uniform(-17, 17);
      s[2] = dice.uniform(1.5, 8);
    }
  }

  Sample operator()(std::uint64_t i) const
  {
    Dice dice(seed_ * 0x1000003 + i);
    return turned(dice.uniform() < outliers_ ? outlier(dice) : hit(dice));
  }

private:
  struct Box {
    double center[3], half[3], cosine, sine;
    bool is_hall = false;
  };

  class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(mixed(seed)) {}

    double uniform()
    {
      state_ = mixed(state_);
      return double(state_ >> 11) * 0x1p-53;
    }

    double uniform(double low, double high) { return low + (high - low) * uniform(); }

    // Close to normally distributed.
    double bell() { return (uniform() + uniform() + uniform() + uniform() - 2) * 1.7320508; }

  private:
    static std::uint64_t mixed(std::uint64_t z) { return scenes::Random(z).bits(); }

    std::uint64_t state_;
  };

  static Sample outlier(Dice& dice)
  {
    return {{dice.uniform(-30, 30), dice.uniform(-20, 20), dice.uniform(0, 15)},
            {dice.bell(), dice.bell(), dice.bell() + 1e-3}};
  }

  Sample hit(Dice& dice) const
  {
    const double* from = stations_[std::size_t(dice.uniform() * 12)];
    const double up = 3.14159265 * dice.uniform(-0.35, 0.5), around = 6.2831853 * dice.uniform();
    const double ray[3] = {std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up)};
    double nearest = 1e30;
    Sample s = {{0, 0, 0}, {0, 0, 1}};
    for(const Box& box : boxes_)
      meet(box, from, ray, nearest, s.normal);
    nearest += 0.003 * dice.bell();
    for(int c = 0; c < 3; ++c) {
      s.position[c] = from[c] + nearest * ray[c];
      s.normal[c] += 0.05 * dice.bell();
    }
    return s;
  }

  // Slabs, in the frame of the box; the hall is seen from inside.
  static void meet(const Box& box, const double* from, const double* ray, double& nearest, double* normal)
  {
    const double x = from[0] - box.center[0], y = from[1] - box.center[1];
    const double o[3] = {box.cosine * x + box.sine * y, box.cosine * y - box.sine * x, from[2] - box.center[2]};
    const double d[3] = {box.cosine * ray[0] + box.sine * ray[1], box.cosine * ray[1] - box.sine * ray[0], ray[2]};
    double enter = -1e30, leave = 1e30;
    int enter_axis = 0, leave_axis = 0;
    for(int a = 0; a < 3; ++a) {
      const double t0 = (-box.half[a] - o[a]) / d[a], t1 = (box.half[a] - o[a]) / d[a];
      if((std::min)(t0, t1) > enter) {
        enter = (std::min)(t0, t1);
        enter_axis = a;
      }
      if((std::max)(t0, t1) < leave) {
        leave = (std::max)(t0, t1);
        leave_axis = a;
      }
    }
    const double t = box.is_hall ? leave : enter;
    const int axis = box.is_hall ? leave_axis : enter_axis;
    if(!(t < nearest) || (!box.is_hall && (enter > leave || enter < 0.2)))
      return;
    nearest = t;
    normal[0] = axis == 0 ? box.cosine : axis == 1 ? -box.sine : 0;
    normal[1] = axis == 0 ? box.sine : axis == 1 ? box.cosine : 0;
    normal[2] = axis == 2 ? 1 : 0;
  }

  // So that nothing is aligned with the axes.
  static Sample turned(Sample s)
  {
    const double c = 0.921060994, sine = 0.389418342, c2 = 0.980066578, s2 = 0.198669331;
    for(double* v : {s.position, s.normal}) {
      const double x = c * v[0] - sine * v[1], y = sine * v[0] + c * v[1], z = v[2];
      v[0] = x;
      v[1] = c2 * y - s2 * z;
      v[2] = s2 * y + c2 * z;
    }
    const double length = std::sqrt(s.normal[0] * s.normal[0] + s.normal[1] * s.normal[1] + s.normal[2] * s.normal[2]);
    for(double& n : s.normal)
      n /= length;
    return s;
  }

  std::uint64_t seed_;
  double outliers_;
  std::vector<Box> boxes_;
  double stations_[12][3];
};

} // namespace CGAL::Tandem::benchmark

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_HALL_SCAN_H
