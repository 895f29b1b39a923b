// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Furnished rooms, walls, and objects with curved parts.

#include "scene_model.h"

namespace CGAL::Tandem::scenes {

namespace {

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
  Frame front = f.upright();
  double step = (height - 0.05) / boards;
  for(int i = 0; i < boards; ++i)
    model.add_recess(front, {0.04, std::fma(i, step, 0.05), width - 0.08, step - 0.05, 0.36});
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
  for(const Frame& door : {f.at({6, 1, 0}).sideways(), f.at({3, 5.2, 0}).upright()}) {
    model.add_box_faces(door, {0, 0, 0}, {0.9, 2.1, 0.2}, side_left | side_right | side_back, true);
    model.voids.push_back(Model::box(door, {0, 0, -0.1}, {0.9, 2.1, 0.3}));
  }
  Frame left_wall = f.at({0, 0, 0}).sideways();
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

Model make_office()
{
  Model model;
  const Frame f = Frame().turned({0, 0, 1}, 0.17);
  model.add_box_faces(f, {0, 0, 0}, {6, 5, 2.7}, side_all, true);
  const Frame left_wall = f.sideways();
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
  model.add_scanners(f, {{2.7, 2.2, 1.6}});
  return model;
}

// Where parts cross, the one nearer to the middle of the room is seen.
Model make_tilted_room()
{
  // Tangents of half of 2, 3, 4, and 5 degrees, by which parts of the room are turned.
  const double two = 0.0174550649282176, three = 0.0261859215693187, four = 0.0349207694917477,
               five = 0.0436609429085119;
  Model model;
  const Frame f = Frame().turned({0, 0, 1}, 0.12);
  const double w = 5, d = 4, h = 2.7;
  model.add_box_faces(f, {0, 0, 0}, {w, d, h}, side_all, true);
  const Frame back = f.at({0, d, 0}).upright(), right = f.at({w, 0, 0}).sideways();
  struct Part {
    Frame frame;
    Vec place, axis;
    double turn, width, height;
  };
  const Vec x = {1, 0, 0}, y = {0, 1, 0};
  const Part parts[] = {{f, {2.8, 0, 0}, y, -three, 2.5, d},
                        {f, {2.4, 0, h}, y, four, 3, d},
                        {f.upright(), {2.2, 0, 0}, y, three, 3, 3},
                        {back, {2.5, 0, 0}, y, -five, 3, 3},
                        {f.sideways(), {0, 1.2, 0}, x, two, d, 1.6},
                        {right, {0.6, 0.1, -0.25}, x, four, 0.9, 1.9},
                        {right, {2, 0.1, -0.25}, x, three, 0.8, 1.6},
                        {f, {1, 1, 0.75}, x, two, 1, 0.7},
                        {f, {2.4, 2.6, 0.7}, x, -five, 1, 0.7},
                        {back, {0.4, 0.05, 0.1}, y, -four, 0.9, 2},
                        {f.upright(), {0.5, 0.05, -0.1}, y, five, 0.9, 2}};
  for(const Part& p : parts)
    model.add_rectangle(p.frame.at(p.place).turned(p.axis, p.turn), p.width, p.height);
  model.add_scanners(f, {{2.3, 2, 1.5}});
  return model;
}

namespace {

// A rectangle of a wall, and how high its left and its right end are.
struct Patch {
  double u, v, width, height, left, right;
};

struct Wall_kind {
  std::string name;
  bool is_layered; // each patch is a face, and hides what is below
  std::vector<Patch> patches;
};

const Wall_kind wall_kinds[] = {
  {"bend", false, {{0, 0, 2, 3, -1, 1}, {2, 0, 2, 3, 1, -1}}},
  {"offset", false, {{0, 0, 4, 3, -.5, -.5}, {0, 0, 4, 3, .5, .5}}},
  {"half-offset", false, {{0, 0, 2.7, 3, -.5, -.5}, {1.3, 0, 2.7, 3, .5, .5}}},
  {"halves", true, {{0, 0, 2, 3, 0, 0}, {2, 0, 2, 3, 1, 1}}},
  {"inset", true, {{0, 0, 4, 3, 0, 0}, {1.4, 1, 1.2, 1, 1, 1}}},
  {"strip", true, {{0, 0, 4, 3, 0, 0}, {0, .85, 3.4, .3, 1, 1}}},
  {"stairs", true, {{0, 0, 1.3, 3, 0, 0}, {1.3, 0, 1.3, 3, 1, 1}, {2.6, 0, 1.4, 3, 2, 2}}},
  {"boards", true, {{0, 0, 4, 3, 0, 0}, {.4, .4, 1.2, 1, 1, 1}, {2.2, .5, .8, .6, 1, 1}, {2.6, 1.8, .5, .5, 1, 1}}},
  {"strips",
   true,
   {{0, 0, .8, 3, 0, 0}, {.8, 0, .8, 3, 1, 1}, {1.6, 0, .8, 3, 0, 0}, {2.4, 0, .8, 3, 1, 1}, {3.2, 0, .8, 3, 0, 0}}}};

} // namespace

Model make_wall(const std::string& kind, double height, const Frame& frame)
{
  Model model;
  if(kind == "bow")
    model.add_bent_rectangle(frame, 4, 3, 2 * height);
  for(const Wall_kind& wall : wall_kinds)
    for(const Patch& p : wall.name == kind ? wall.patches : std::vector<Patch>()) {
      const double left = p.left * height, right = p.right * height, u = p.u + p.width, v = p.v + p.height;
      if(wall.is_layered || model.faces.empty())
        model.faces.push_back({Model::half_space(frame, {0, 0, 1}, wall.is_layered ? left : 0), {}, {}});
      model.extend_face(model.faces.size() - 1, frame,
                        {{p.u, p.v, left}, {u, p.v, right}, {u, v, right}, {p.u, v, left}});
      if(wall.is_layered)
        model.solids.push_back(Model::box(frame, {p.u, p.v, -1}, {u, v, left}));
    }
  return model;
}

void add_place(Model& model, Place place, const Frame& wall)
{
  if(place == Place::roof) {
    model.add_rectangle(wall.at({0, 3, 0}).turned({1, 0, 0}, -.35), 4, 1.5);
    model.add_box(wall, {3.3, 2.2, -.05}, {3.7, 2.6, .6});
    return;
  }
  model.add_box_faces(wall, {0, 0, 0}, {4, 3, 1}, side_front | (place == Place::room ? side_left : side_back), true);
  if(place == Place::hall)
    for(double u : {.8, 2.4})
      model.curved.push_back({wall.at({u, 0, .6}).with_axes({0, 0, 1}, {1, 0, 0}), .15, 3, false});
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
  model.add_scanners(f, {{-4, -4, 8}, {14, 3, 8}, {4, 12, 2}});
  return model;
}

Model make_curved()
{
  Model model;
  Frame f = Frame().turned({0.5, 0.2, 1}, 0.35);
  model.add_box(f, {0, 0, -0.5}, {12, 8, 0}, side_all);
  model.curved.push_back({f.at({2.5, 2.5, 2.3}), 2, 0, false});
  model.curved.push_back({f.at({9.5, 6, 1.4}), 1.2, 0, false});
  model.curved.push_back({f.at({5, 6.2, 1.7}).with_axes({0, 0, 1}, {0, 1, 0}), 1.4, 4, false});
  add_cylinder(model, f.at({8, 2.5, 0}), 1.8, 2.5, false);
  model.add_face(f, {{6.8, 1.3, 2.5}, {9.2, 1.3, 2.5}, {9.2, 3.7, 2.5}, {6.8, 3.7, 2.5}});
  model.add_scanners(f, {{-8, -8, 9}, {20, -8, 9}, {6, 18, 9}, {6, 4, -14}});
  return model;
}

} // namespace CGAL::Tandem::scenes
