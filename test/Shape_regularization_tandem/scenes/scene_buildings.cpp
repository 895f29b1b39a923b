// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scene_models.h"

namespace CGAL::Tandem::scenes {

namespace {

struct Window_row {
  double first, step;
  int count;
  double height;
};

// Windows in a wall frame (x along the wall, y up, z outward), each with a sill.
void add_windows(Model& model, const Frame& wall, const Window_row& row)
{
  for(int i = 0; i < row.count; ++i) {
    double u = std::fma(i, row.step, row.first), v = row.height;
    model.add_recess(wall, {u, v, 1.2, 1.4, 0.22});
    model.add_box(wall, {u - 0.15, v - 0.3, -0.1}, {u + 1.35, v - 0.05, 0.25});
  }
}

// Front, right, back and left wall of a block [0,w] x [0,d].
std::array<Frame, 4> wall_frames(const Frame& f, double w, double d)
{
  return {f.with_axes({1, 0, 0}, {0, 0, 1}), f.at({w, 0, 0}).with_axes({0, 1, 0}, {0, 0, 1}),
          f.at({w, d, 0}).with_axes({-1, 0, 0}, {0, 0, 1}), f.at({0, d, 0}).with_axes({0, -1, 0}, {0, 0, 1})};
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
  model.add_recess(f.at({x, 0.9, 0}).with_axes({1, 0, 0}, {0, 0, 1}), {0.5, 7.3, width - 1, 1.1, 0.2});
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

} // namespace

Model make_house()
{
  Model model;
  Frame f = Frame().turned({0, 0, 1}, 0.14);
  add_gabled_block(model, f, {12, 9, 6, 0.6});
  auto walls = wall_frames(f, 12, 9);
  add_windows(model, walls[0], {1, 2.2, 1, 1.3});
  add_windows(model, walls[0], {8, 2.2, 1, 1.3});
  add_windows(model, walls[0], {1, 2.9, 4, 4.1});
  add_windows(model, walls[2], {1, 2.9, 4, 1.3});
  add_windows(model, walls[2], {1, 2.9, 4, 4.1});
  add_windows(model, walls[1], {1.4, 2.6, 3, 4.1});
  add_windows(model, walls[3], {1.4, 2.6, 3, 1.3});
  add_windows(model, walls[3], {1.4, 2.6, 3, 4.1});
  model.add_recess(walls[0], {4.5, 0.9, 1.4, 2.2, 0.3});
  add_steps(model, f, 4.1, 2.2, 4);
  add_dormer(model, f, 1.5, 2.6);
  add_dormer(model, f, 7.2, 2.2);
  model.add_box(f, {8.6, 5.4, 5}, {9.8, 6.4, 10.8}, side_walls | side_top);
  model.add_box(f, {11.9, 1.5, -1}, {16.5, 8, 3.1}, side_front | side_right | side_back | side_top);
  model.add_recess(f.at({12, 1.5, 0}).with_axes({1, 0, 0}, {0, 0, 1}), {0.8, 0.05, 2.9, 2.4, 0.35});
  model.add_rectangle(f.at({-4, -5, 0}), 24, 18);
  for(Vec p : {Vec{-4, -5, 1.7}, Vec{18, -4, 1.7}, Vec{17, 12, 1.7}, Vec{-3, 13, 1.7}, Vec{6, -5, 14}})
    model.scanners.push_back(f.point(p));
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

void add_table(Model& model, const Frame& f, double width, double depth, double height)
{
  model.add_box(f, {0, 0, height - 0.04}, {width, depth, height}, side_all);
  for(double x : {0.05, width - 0.13})
    for(double y : {0.05, depth - 0.13})
      model.add_box(f, {x, y, -0.1}, {x + 0.08, y + 0.08, height - 0.04}, side_walls);
}

void add_shelf(Model& model, const Frame& f, double width, double height, int boards)
{
  model.add_box(f, {0, 0, -0.1}, {width, 0.5, height}, side_left | side_right | side_front | side_top);
  Frame front = f.with_axes({1, 0, 0}, {0, 0, 1});
  double step = (height - 0.05) / boards;
  for(int i = 0; i < boards; ++i)
    model.add_recess(front, {0.04, std::fma(i, step, 0.05), width - 0.08, step - 0.05, 0.36});
}

namespace {

void add_room(Model& model, const Frame& f, double width, double depth, double height)
{
  model.add_box_faces(f, {0, 0, 0}, {width, depth, height}, side_all, true);
  for(double x : {0.3, 0.7})
    model.scanners.push_back(f.point({x * width, 0.45 * depth, 1.6}));
}

} // namespace

Model make_indoor()
{
  Model model;
  Frame f = Frame().turned({0, 0, 1}, 0.22);
  add_room(model, f, 6, 5, 2.7);
  add_room(model, f.at({6.2, 0, 0}), 4.5, 5, 2.7);
  add_room(model, f.at({0, 5.2, 0}), 10.7, 3.5, 2.9);
  // Doors go through walls of 0.2; their voids cut both faces of the wall.
  for(const Frame& door :
      {f.at({6, 1, 0}).with_axes({0, 1, 0}, {0, 0, 1}), f.at({3, 5.2, 0}).with_axes({1, 0, 0}, {0, 0, 1})}) {
    model.add_box_faces(door, {0, 0, 0}, {0.9, 2.1, 0.2}, side_left | side_right | side_back, true);
    model.voids.push_back(Model::box(door, {0, 0, -0.1}, {0.9, 2.1, 0.3}));
  }
  Frame left_wall = f.at({0, 0, 0}).with_axes({0, 1, 0}, {0, 0, 1});
  for(double u : {0.7, 2.9})
    model.add_recess(left_wall, {u, 0.9, 1.4, 1.3, 0.15});
  add_table(model, f.at({2, 1.6, 0}), 1.8, 0.9, 0.75);
  add_table(model, f.at({7.2, 2.0, 0}).turned({0, 0, 1}, 0.13), 1.6, 0.8, 0.72);
  add_table(model, f.at({6, 6.2, 0}), 2.2, 1, 0.76);
  add_shelf(model, f.at({1.2, 4.6, 0}), 2.4, 2.0, 5);
  add_shelf(model, f.at({8, 4.6, 0}), 1.8, 1.8, 4);
  add_shelf(model, f.at({0.4, 8.3, 0}), 2, 2, 4);
  model.add_box(f.at({4.4, 0.1, 0}), {0, 0, -0.1}, {1.2, 0.6, 0.9});
  model.add_box(f.at({9.1, 0.3, 0}), {0, 0, -0.1}, {1.4, 2, 0.5});
  model.add_box(f.at({9.15, 0.4, 0}), {0.1, 1.3, 0.49}, {1.1, 1.7, 0.64});
  model.add_box(f.at({2.4, 1.8, 0.75}).turned({0, 0, 1}, 0.1), {0, 0, -0.01}, {0.35, 0.25, 0.06});
  model.add_box(f.at({3.1, 2.0, 0.75}), {0, 0, -0.01}, {0.3, 0.2, 0.18});
  model.add_box(f.at({8.5, 6.5, 0}).turned({0, 0, 1}, -0.18), {0, 0, -0.1}, {0.8, 0.8, 0.45});
  return model;
}

void add_cylinder(Model& model, const Frame& f, double radius, double height, bool is_hole)
{
  double top = height + (is_hole ? 0.1 : -1e-6);
  Convex prism = {Model::half_space(f, {0, 0, -1}, 0.1), Model::half_space(f, {0, 0, 1}, top)};
  Frame turned = f;
  for(int i = 0; i < 16; ++i, turned = turned.turned({0, 0, 1}, 0.198912367379658))
    prism.push_back(Model::half_space(turned, {1, 0, 0}, radius));
  (is_hole ? model.voids : model.solids).push_back(prism);
  model.curved.push_back({f, radius, height, is_hole});
}

Model make_part()
{
  Model model;
  Frame f = Frame().turned({0.3, 0.5, 1}, 0.3);
  Convex block = Model::box(f, {0, 0, 0}, {10, 6, 3});
  block.push_back(Model::half_space(f, {0.6, 0, 0.8}, 7.2));
  model.solids.push_back(block);
  model.add_face(f, {{0, 0, 0}, {10, 0, 0}, {10, 0, 1.5}, {8, 0, 3}, {0, 0, 3}});
  model.add_face(f, {{0, 6, 0}, {0, 6, 3}, {8, 6, 3}, {10, 6, 1.5}, {10, 6, 0}});
  model.add_box_faces(f, {0, 0, 0}, {10, 6, 1.5}, side_right | side_bottom);
  model.add_box_faces(f, {0, 0, 0}, {8, 6, 3}, side_left | side_top);
  model.add_face(f, {{10, 0, 1.5}, {10, 6, 1.5}, {8, 6, 3}, {8, 0, 3}});
  Frame top = f.at({0, 0, 3});
  model.add_recess(top, {2, -0.001, 0.8, 6.002, 1, side_left | side_right});
  model.add_recess(top, {4.2, 3.4, 2.2, 1.8, 1.2});
  for(int i = 0; i < 3; ++i)
    model.add_box(f, {-0.6 * (i + 1), std::fma(0.2, i, 1), 0},
                  {std::fma(-0.6, i, 0.1), std::fma(-0.2, i, 5), std::fma(-0.6, i, 2.4)},
                  side_left | side_front | side_back | side_top);
  model.add_box(f.at({5.2, 1.6, 3}).turned({0, 0, 1}, 0.2679491924311227), {-0.8, -0.8, -0.1}, {0.8, 0.8, 0.7});
  add_cylinder(model, f.at({1, 3, 3}), 0.7, 1.5, false);
  model.add_face(f, {{0.5, 2.5, 4.5}, {1.5, 2.5, 4.5}, {1.5, 3.5, 4.5}, {0.5, 3.5, 4.5}});
  add_cylinder(model, f.at({7, 1.2, 0}), 0.6, 3, true);
  for(Vec p : {Vec{-4, -4, 8}, Vec{14, 3, 8}, Vec{4, 12, 2}})
    model.scanners.push_back(f.point(p));
  return model;
}

} // namespace CGAL::Tandem::scenes
