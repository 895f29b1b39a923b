// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scene_model.h"

namespace CGAL::Tandem::scenes {

namespace {

// tan(degrees / 2) for small angles, as Frame::turned() wants it.
double half_tangent(double degrees)
{
  double a = degrees * 0.008726646259971648, s = a * a;
  return std::fma(a * s, std::fma(s, 0.13333333333333333, 0.3333333333333333), a);
}

} // namespace

Model make_cube(const Frame& frame)
{
  Model model;
  model.add_box_faces(frame, {0, 0, 0}, {1, 1, 1}, side_all);
  return model;
}

Model make_tilted_cube(double degrees)
{
  Model model;
  Frame cube = Frame().turned({1, 2, 3}, 0.25);
  auto walls = std::array<Frame, 6>{cube.at({0, 0, 1}),
                                    cube.at({1, 0, 0}).with_axes({-1, 0, 0}, {0, 1, 0}),
                                    cube.with_axes({1, 0, 0}, {0, 0, 1}),
                                    cube.at({1, 1, 0}).with_axes({-1, 0, 0}, {0, 0, 1}),
                                    cube.with_axes({0, 0, 1}, {0, 1, 0}).at({0, 0, 0}),
                                    cube.at({1, 0, 0}).with_axes({0, 1, 0}, {0, 0, 1})};
  const Vec axes[6] = {{1, 0.3, 0}, {0.2, 1, 0}, {1, -1, 0}, {-0.4, 1, 0}, {1, 1, 0}, {1, 0, 0}};
  for(std::size_t i = 0; i < 6; ++i) {
    Frame face = walls[i].at({0.5, 0.5, 0}).turned(axes[i], half_tangent(degrees));
    model.add_rectangle(face.at({-0.5, -0.5, 0}), 1, 1);
  }
  return model;
}

Model make_staircase(int steps)
{
  Model model;
  for(int i = 0; i < steps; ++i) {
    Frame corner = Frame().at({0, 0.3 * i, 0.2 * i});
    model.add_rectangle(corner.with_axes({1, 0, 0}, {0, 0, 1}), 2, 0.2);
    model.add_rectangle(corner.at({0, 0, 0.2}), 2, 0.3);
  }
  return model;
}

Model make_squares(double gap)
{
  Model model;
  model.add_rectangle(Frame(), 1, 1);
  Frame second = Frame().at({1 + gap, 0, 0});
  if(gap > 0)
    model.add_rectangle(second, 1, 1);
  else
    model.extend_face(0, second, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  return model;
}

Model make_slope(double degrees)
{
  Model model;
  model.add_rectangle(Frame(), 4, 2);
  model.add_rectangle(Frame().at({4, 0, 0}).turned({0, -1, 0}, half_tangent(degrees)), 8, 2);
  model.add_rectangle(Frame().at({4, 2.3, 0}), 8, 2);
  return model;
}

Model make_chained(double degrees, int count)
{
  Model model;
  Frame turned;
  for(int i = 0; i < count; ++i, turned = turned.turned({0, 1, 0}, half_tangent(degrees))) {
    Frame f = turned;
    f.origin = {1.5 * i, 0, 0};
    model.add_rectangle(f, 1, 1);
  }
  return model;
}

Model make_two_followers()
{
  Model model;
  model.add_rectangle(Frame(), 4, 4);
  model.add_rectangle(Frame().at({0.5, 0.5, 0.2}).with_axes({1, 0, 0}, {0, 0, 1}), 1.5, 1.5);
  model.add_rectangle(Frame().at({2, 2, 0.2}).with_axes({0.6, 0.8, 0}, {0, 0, 1}), 1.5, 1.5);
  return model;
}

Model make_offset_pair(double offset)
{
  Model model;
  model.add_rectangle(Frame(), 1, 1);
  model.add_rectangle(Frame().at({1.2, 0, offset}), 1, 1);
  return model;
}

Model make_sphere()
{
  Model model;
  model.curved.push_back({Frame(), 1, 0, false});
  return model;
}

Model make_bent_hall()
{
  Model model;
  const Frame upright = Frame().with_axes({1, 0, 0}, {0, 0, 1}); // its normal is -y
  model.add_bent_rectangle(Frame(), 8, 5, -.02);
  model.add_bent_rectangle(Frame().at({0, 5, 3}).with_axes({1, 0, 0}, {0, -1, 0}), 8, 5, .04);
  model.add_rectangle(upright.at({0, 0, -5}), 8, 3);
  model.add_rectangle(upright.at({1, 1, -4.978}), 1.5, 1);
  model.add_rectangle(upright.at({5, 1, -4.94}), 1.5, 1);
  for(int i = 0; i < 3; ++i)
    model.curved.push_back({Frame().at({2. + 2 * i, 2, 0}), .1 * double(1 << i), 3, false});
  model.scanners = {{4, 1, 1.5}};
  return model;
}

Model make_bent_road()
{
  Model model;
  model.add_bent_rectangle(Frame(), 30, 6, -.12);
  const Frame upright = Frame().with_axes({1, 0, 0}, {0, 0, 1});
  model.add_rectangle(upright.at({0, .3, -8}), 30, 4);
  model.add_bent_rectangle(Frame().at({0, 8, 4.3}).turned({1, 0, 0}, .25), 12, 5, .06);
  model.add_bent_rectangle(Frame().at({14, 8, 4.3}).turned({1, 0, 0}, .25), 12, 5, -.06);
  model.scanners = {{15, 2, 2}};
  return model;
}

} // namespace CGAL::Tandem::scenes
