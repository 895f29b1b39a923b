// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scene_models.h"

#include <stdexcept>

namespace CGAL::Tandem::scenes {

namespace {

// Tangents of half of the angles by which parts of the tilted room are turned.
constexpr double half_2_deg = 0.0174550649282176, half_3_deg = 0.0261859215693187, half_4_deg = 0.0349207694917477,
                 half_5_deg = 0.0436609429085119;

} // namespace

Model make_office()
{
  Model model;
  const Frame f = Frame().turned({0, 0, 1}, 0.17);
  model.add_box_faces(f, {0, 0, 0}, {6, 5, 2.7}, side_all, true);
  const Frame left_wall = f.with_axes({0, 1, 0}, {0, 0, 1});
  for(double u : {0.8, 2.9})
    model.add_recess(left_wall, {u, 0.9, 1.3, 1.3, 0.2});
  add_table(model, f.at({1.9, 0.5, 0}), 1.6, 0.8, 0.74);
  add_table(model, f.at({3.6, 2.9, 0}).turned({0, 0, 1}, 0.1), 1.2, 0.8, 0.5);
  add_shelf(model, f.at({0.6, 4.5, 0}), 2.2, 2, 5);
  add_shelf(model, f.at({3.4, 4.5, 0}), 1.2, 1.4, 3);
  model.add_box(f, {5.2, 0.2, -0.1}, {5.9, 1.5, 1.9});
  model.add_box(f.at({4.1, 0.6, 0}).turned({0, 0, 1}, -0.2), {0, 0, -0.1}, {0.45, 0.45, 0.47});
  model.add_box(f.at({2.1, 0.7, 0.74}).turned({0, 0, 1}, 0.15), {0, 0, -0.01}, {0.4, 0.25, 0.3});
  model.add_box(f.at({5.3, 3.2, 0}).turned({0, 0, 1}, 0.05), {0, 0, -0.1}, {0.5, 0.9, 0.8});
  model.curved.push_back({f.at({1.2, 3.5, 0}), 0.25, 0.9, false});
  model.curved.push_back({f.at({5, 2.4, 0}), 0.12, 2.7, false});
  model.curved.push_back({f.at({3, 0.9, 0.9}), 0.16, 0, false});
  model.scanners = {f.point({2.7, 2.2, 1.6})};
  return model;
}

// Where parts cross, the one nearer to the middle of the room is seen.
Model make_tilted_room()
{
  Model model;
  const Frame f = Frame().turned({0, 0, 1}, 0.12);
  const double w = 5, d = 4, h = 2.7;
  model.add_box_faces(f, {0, 0, 0}, {w, d, h}, side_all, true);
  const Frame floor = f.at({2.8, 0, 0}).turned({0, 1, 0}, -half_3_deg);
  model.add_rectangle(floor, 2.5, d);
  const Frame ceiling = f.at({2.4, 0, h}).turned({0, 1, 0}, half_4_deg);
  model.add_rectangle(ceiling, 3, d);
  const Frame front = f.with_axes({1, 0, 0}, {0, 0, 1}).at({2.2, 0, 0}).turned({0, 1, 0}, half_3_deg);
  model.add_rectangle(front, 3, 3);
  const Frame back = f.at({0, d, 0}).with_axes({1, 0, 0}, {0, 0, 1}).at({2.5, 0, 0}).turned({0, 1, 0}, -half_5_deg);
  model.add_rectangle(back, 3, 3);
  const Frame left = f.with_axes({0, 1, 0}, {0, 0, 1}).at({0, 1.2, 0}).turned({1, 0, 0}, half_2_deg);
  model.add_rectangle(left, d, 1.6);
  const Frame right = f.at({w, 0, 0}).with_axes({0, 1, 0}, {0, 0, 1});
  model.add_rectangle(right.at({0.6, 0.1, -0.25}).turned({1, 0, 0}, half_4_deg), 0.9, 1.9);
  model.add_rectangle(right.at({2, 0.1, -0.25}).turned({1, 0, 0}, half_3_deg), 0.8, 1.6);
  model.add_rectangle(f.at({1, 1, 0.75}).turned({1, 0, 0}, half_2_deg), 1, 0.7);
  model.add_rectangle(f.at({2.4, 2.6, 0.7}).turned({1, 0, 0}, -half_5_deg), 1, 0.7);
  const Frame back_wall = f.at({0, d, 0}).with_axes({1, 0, 0}, {0, 0, 1});
  model.add_rectangle(back_wall.at({0.4, 0.05, 0.1}).turned({0, 1, 0}, -half_4_deg), 0.9, 2);
  model.add_rectangle(f.with_axes({1, 0, 0}, {0, 0, 1}).at({0.5, 0.05, -0.1}).turned({0, 1, 0}, half_5_deg), 0.9, 2);
  model.scanners = {f.point({2.3, 2, 1.5})};
  return model;
}

const std::vector<std::string>& roof_kinds()
{
  static const std::vector<std::string> kinds = {"gable", "low", "hip", "dormers", "wing", "mansard", "hall", "villa"};
  return kinds;
}

namespace {

constexpr double width = 12, depth = 9;

// Two slopes that meet in a ridge along x, over [0, length] x [0, span].
void add_gable(Model& model, const Frame& f, double length, double span, double slope)
{
  const double ridge = slope * span / 2;
  model.add_face(f, {{0, 0, 0}, {length, 0, 0}, {length, span / 2, ridge}, {0, span / 2, ridge}});
  model.add_face(f, {{length, span, 0}, {0, span, 0}, {0, span / 2, ridge}, {length, span / 2, ridge}});
}

void add_hip(Model& model, const Frame& f, double slope)
{
  const double half = depth / 2, top = slope * half;
  const Vec a{half, half, top}, b{width - half, half, top};
  model.add_face(f, {{0, 0, 0}, {width, 0, 0}, b, a});
  model.add_face(f, {{width, 0, 0}, {width, depth, 0}, b});
  model.add_face(f, {{width, depth, 0}, {0, depth, 0}, a, b});
  model.add_face(f, {{0, depth, 0}, {0, 0, 0}, a});
}

// Two gabled ones and a flat one.
void add_dormers(Model& model, const Frame& f)
{
  for(double x : {2., 8.4})
    add_gable(model, f.at({x + 2.2, 0.8, 1.4}).with_axes({0, 1, 0}, {-1, 0, 0}), 3.2, 2.2, 0.75);
  model.add_rectangle(f.at({5, 1, 2.1}), 2.2, 2.5);
}

void add_mansard(Model& model, const Frame& f)
{
  const double in = 1.6, up = 2.2;
  const std::vector<Vec> low = {{0, 0, 0}, {width, 0, 0}, {width, depth, 0}, {0, depth, 0}};
  const std::vector<Vec> high = {
    {in, in, up}, {width - in, in, up}, {width - in, depth - in, up}, {in, depth - in, up}};
  for(std::size_t i = 0; i < 4; ++i)
    model.add_face(f, {low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]});
  add_gable(model, f.at(high[0]), width - 2 * in, depth - 2 * in, 0.3);
}

// Three saw teeth, steep and flat sides, and a lower flat part with a skylight.
void add_hall(Model& model, const Frame& f)
{
  for(double x : {0., 3., 6.}) {
    model.add_face(f, {{x, 0, 0}, {x + 2.2, 0, 1.1}, {x + 2.2, depth, 1.1}, {x, depth, 0}});
    model.add_face(f, {{x + 2.2, 0, 1.1}, {x + 3, 0, 0}, {x + 3, depth, 0}, {x + 2.2, depth, 1.1}});
  }
  model.add_rectangle(f.at({9, 0, -0.5}), 3, depth);
  model.add_rectangle(f.at({9.6, 3, -0.1}).turned({1, 0, 0}, 0.05), 1.8, 3);
}

} // namespace

Model make_roof(const std::string& kind)
{
  Model model;
  const Frame f = Frame().turned({0, 0, 1}, 0.21);
  if(kind == "hip" || kind == "villa")
    add_hip(model, f, 0.7);
  else if(kind == "mansard")
    add_mansard(model, f);
  else if(kind == "hall")
    add_hall(model, f);
  else if(kind == "gable" || kind == "dormers" || kind == "wing")
    add_gable(model, f, width, depth, 0.75);
  else if(kind == "low")
    add_gable(model, f, width, depth, 0.2);
  else
    throw std::invalid_argument("there is no roof " + kind);
  if(kind == "dormers" || kind == "villa")
    add_dormers(model, f);
  if(kind == "wing" || kind == "villa")
    add_gable(model, f.at({9, -4, -0.3}).with_axes({0, 1, 0}, {-1, 0, 0}), 8.5, 6, 0.75);
  return model;
}

Model make_boards(double gap)
{
  Model model;
  const Frame wall = Frame().with_axes({1, 0, 0}, {0, 0, 1});
  model.add_rectangle(wall, 4, 3);
  const double boards[3][4] = {{0.4, 0.4, 1.2, 1}, {2.2, 0.5, 0.8, 0.6}, {2.6, 1.8, 0.5, 0.5}};
  for(const double(&b)[4] : boards)
    model.add_box(wall, {b[0], b[1], -1}, {b[0] + b[2], b[1] + b[3], gap}, side_top);
  return model;
}

Model make_strips(double gap)
{
  Model model;
  for(int i = 0; i < 5; ++i)
    model.add_rectangle(Frame().at({0.8 * i, 0, i % 2 == 0 ? 0 : gap}), 0.8, 3);
  return model;
}

} // namespace CGAL::Tandem::scenes
