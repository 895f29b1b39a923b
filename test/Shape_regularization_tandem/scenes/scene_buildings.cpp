// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A house and a village, a street, a tower, and roofs.

#include "scene_model.h"

namespace CGAL::Tandem::scenes {

namespace {

struct Window_row {
  double first, step;
  int count;
  double height;
};

// Windows in a wall frame (x along the wall, y up, z outward), each with a sill.
void add_windows(Model& model, const Frame& wall, const std::vector<Window_row>& rows)
{
  for(const Window_row& row : rows)
    for(int i = 0; i < row.count; ++i) {
      double u = std::fma(i, row.step, row.first), v = row.height;
      model.add_recess(wall, {u, v, 1.2, 1.4, 0.22});
      model.add_box(wall, {u - 0.15, v - 0.3, -0.1}, {u + 1.35, v - 0.05, 0.25});
    }
}

// Front, right, back and left wall of a block [0,w] x [0,d].
std::array<Frame, 4> wall_frames(const Frame& f, double w, double d)
{
  return {f.upright(), f.at({w, 0, 0}).sideways(), f.at({w, d, 0}).with_axes({-1, 0, 0}, {0, 0, 1}),
          f.at({0, d, 0}).with_axes({0, -1, 0}, {0, 0, 1})};
}

struct Gabled_block {
  double width, depth, height;
  double overhang; // of the roof; 0: two bare slopes instead of slabs
};

// Two slabs that lie half in the walls and end in each other at the ridge. Their
// narrow sides meet there, so that each gable has one face, not two.
void add_roof_slabs(Model& model, const Frame& front, const Frame& back, const Gabled_block& block)
{
  double width = std::fma(2, block.overhang, block.width), eave = 1.25 * block.overhang;
  double half = 0.15, end = std::fma(0.625, block.depth, 0.75 * half);
  Vec low{0, -eave, -half}, high{width, end, half};
  model.add_box(front, low, high, side_front | side_bottom | side_top);
  model.add_box(back, low, high, side_front | side_bottom | side_top);
  std::vector<Vec> left = {{0, -eave, -half}, {0, -eave, half}, {0, end, half}, {0, end, -half}};
  std::vector<Vec> right = {{width, -eave, -half}, {width, end, -half}, {width, end, half}, {width, -eave, half}};
  model.extend_face(model.add_face(front, left), back, right);
  model.extend_face(model.add_face(front, right), back, left);
}

// Walls and a gable roof of slope 3:4 whose ridge runs along x.
void add_gabled_block(Model& model, const Frame& f, const Gabled_block& block)
{
  double w = block.width, d = block.depth, h = block.height, overhang = block.overhang;
  double ridge = std::fma(d / 2, 0.75, h);
  Convex body = Model::box(f, {0, 0, -1}, {w, d, 2 * ridge});
  body.push_back(Model::half_space(f, {0, -0.6, 0.8}, 0.8 * h));
  body.push_back(Model::half_space(f, {0, 0.6, 0.8}, std::fma(0.6, d, 0.8 * h)));
  model.solids.push_back(body);
  auto walls = wall_frames(f, w, d);
  for(int i = 0; i < 4; ++i) {
    double width = i % 2 == 0 ? w : d;
    std::vector<Vec> corners = {{0, 0, 0}, {width, 0, 0}, {width, h, 0}};
    if(i % 2 == 1)
      corners.push_back({d / 2, ridge, 0});
    corners.push_back({0, h, 0});
    model.add_face(walls[i], corners);
  }
  Frame front = f.at({-overhang, 0, h}).with_axes({1, 0, 0}, {0, 0.8, 0.6});
  Frame back = f.at({w + overhang, d, h}).with_axes({-1, 0, 0}, {0, -0.8, 0.6});
  if(overhang > 0)
    add_roof_slabs(model, front, back, block);
  else
    for(const Frame& side : {front, back})
      model.add_rectangle(side, w, 0.625 * d);
}

void add_dormer(Model& model, const Frame& f, double x, double width)
{
  model.add_box(f, {x, 0.9, 6.5}, {x + width, 4.2, 8.9}, side_left | side_right | side_front | side_top);
  model.add_recess(f.at({x, 0.9, 0}).upright(), {0.5, 7.3, width - 1, 1.1, 0.2});
}

// Steps to a door; the sides of all steps are one face.
void add_steps(Model& model, const Frame& f, double x, double width, int count)
{
  std::size_t left = 0, right = 0;
  for(int i = 0; i < count; ++i) {
    double back = -0.35 * (count - 1 - i), front = -0.35 * (count - i), top = 0.2 * (i + 1);
    model.add_box(f, {x, front, -1}, {x + width, back + 0.1, top}, side_front | side_top);
    std::vector<Vec> l = {{x, front, 0}, {x, front, top}, {x, back, top}, {x, back, 0}};
    std::vector<Vec> r = {{x + width, front, 0}, {x + width, back, 0}, {x + width, back, top}, {x + width, front, top}};
    if(i == 0) {
      left = model.add_face(f, l);
      right = model.add_face(f, r);
    } else {
      model.extend_face(left, f, l);
      model.extend_face(right, f, r);
    }
  }
}

constexpr double width = 12, depth = 9;

// Two slopes that meet in a ridge along x, over [0, length] x [0, span]; hipped: at its ends as well.
void add_ridge(Model& model, const Frame& f, double length, double span, double slope, bool is_hipped = false)
{
  const double in = is_hipped ? span / 2 : 0, top = slope * span / 2;
  const Vec a{in, span / 2, top}, b{length - in, span / 2, top};
  model.add_face(f, {{0, 0, 0}, {length, 0, 0}, b, a});
  if(is_hipped)
    model.add_face(f, {{length, 0, 0}, {length, span, 0}, b});
  model.add_face(f, {{length, span, 0}, {0, span, 0}, a, b});
  if(is_hipped)
    model.add_face(f, {{0, span, 0}, {0, 0, 0}, a});
}

// Two gabled ones and a flat one.
void add_dormers(Model& model, const Frame& f)
{
  for(double x : {2., 8.4})
    add_ridge(model, f.at({x + 2.2, 0.8, 1.4}).with_axes({0, 1, 0}, {-1, 0, 0}), 3.2, 2.2, 0.75);
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
  add_ridge(model, f.at(high[0]), width - 2 * in, depth - 2 * in, 0.3);
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

Model make_house()
{
  Model model;
  Frame f = Frame().turned({0, 0, 1}, 0.14);
  add_gabled_block(model, f, {12, 9, 6, 0.6});
  auto walls = wall_frames(f, 12, 9);
  add_windows(model, walls[0], {{1, 2.2, 1, 1.3}, {8, 2.2, 1, 1.3}, {1, 2.9, 4, 4.1}});
  add_windows(model, walls[2], {{1, 2.9, 4, 1.3}, {1, 2.9, 4, 4.1}});
  add_windows(model, walls[1], {{1.4, 2.6, 3, 4.1}});
  add_windows(model, walls[3], {{1.4, 2.6, 3, 1.3}, {1.4, 2.6, 3, 4.1}});
  model.add_recess(walls[0], {4.5, 0.9, 1.4, 2.2, 0.3});
  add_steps(model, f, 4.1, 2.2, 4);
  add_dormer(model, f, 1.5, 2.6);
  add_dormer(model, f, 7.2, 2.2);
  model.add_box(f, {8.6, 5.4, 5}, {9.8, 6.4, 10.8}, side_walls | side_top);
  model.add_box(f, {11.9, 1.5, -1}, {16.5, 8, 3.1}, side_front | side_right | side_back | side_top);
  model.add_recess(f.at({12, 1.5, 0}).upright(), {0.8, 0.05, 2.9, 2.4, 0.35});
  model.add_rectangle(f.at({-4, -5, 0}), 24, 18);
  model.add_scanners(f, {{-4, -5, 1.7}, {18, -4, 1.7}, {17, 12, 1.7}, {-3, 13, 1.7}, {6, -5, 14}});
  return model;
}

Model make_village()
{
  Model model;
  Frame turned;
  for(int i = 0; i < 16; ++i, turned = turned.turned({0, 0, 1}, 0.02531)) {
    Frame f = turned;
    int row = i / 4;
    f.origin = {24.0 * (i % 4), 24.0 * row, 0};
    Frame block = f.at({-5, -4, 0});
    add_gabled_block(model, block, {10, 8, 5 + 0.1875 * i, 0});
    model.add_box(block, {9.9, 1, -1}, {14, 6.5, 3 + 0.0625 * i}, side_front | side_right | side_back | side_top);
    model.add_box(block, {2, -2, -1}, {6, 0.1, 3.5 + 0.0625 * i}, side_left | side_front | side_right | side_top);
  }
  model.add_rectangle(Frame().at({-16, -16, 0}), 104, 104);
  for(double x : {12, 36, 60})
    for(double y : {12, 36, 60})
      model.scanners.push_back({x, y, 2});
  return model;
}

Model make_roof(const std::string& kind)
{
  Model model;
  const Frame f = Frame().turned({0, 0, 1}, 0.21);
  if(kind == "mansard")
    add_mansard(model, f);
  else if(kind == "hall")
    add_hall(model, f);
  else if(kind == "hip" || kind == "villa")
    add_ridge(model, f, width, depth, 0.7, true);
  else
    add_ridge(model, f, width, depth, kind == "low" ? 0.2 : 0.75);
  if(kind == "dormers" || kind == "villa")
    add_dormers(model, f);
  if(kind == "wing" || kind == "villa")
    add_ridge(model, f.at({9, -4, -0.3}).with_axes({0, 1, 0}, {-1, 0, 0}), 8.5, 6, 0.75);
  return model;
}

} // namespace CGAL::Tandem::scenes
