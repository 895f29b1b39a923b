// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scene_models.h"

namespace CGAL::Tandem::scenes {

namespace {

constexpr double street_length = 120;

void add_car(Model& model, const Frame& f)
{
  model.add_box(f, {-2.1, -0.9, -0.1}, {2.1, 0.9, 0.85});
  model.add_box(f, {-1.1, -0.8, 0.8}, {0.9, 0.8, 1.45});
}

// A trunk, and small balls for the crown.
void add_tree(Model& model, const Frame& f)
{
  model.curved.push_back({f, 0.15, 3, false});
  for(int i = 0; i < 24; ++i) {
    double x = (i * 7) % 11 / 5. - 1, y = (i * 5) % 13 / 6. - 1, z = (i * 3) % 7 / 3.;
    model.curved.push_back({f.at({1.3 * x, 1.3 * y, std::fma(0.9, z, 3.2)}), 0.3, 0, false});
  }
}

// Pavement, curb and houses on one side: the road lies at y < 0 of the frame.
void add_street_side(Model& model, const Frame& f)
{
  model.add_rectangle(f.with_axes({1, 0, 0}, {0, 0, 1}), street_length, 0.12);
  model.add_rectangle(f.at({0, 0, 0.12}), street_length, 2.5);
  for(int i = 0; i < 6; ++i) {
    double setback = std::fma(0.3, i * 2 % 5, 2.5);
    Frame house = f.at({20. * i + 1, setback, 0.12});
    model.add_box(house, {0, 0, -0.2}, {18, 9, 7. + i * 3 % 4}, side_left | side_right | side_front | side_top);
    Frame wall = house.with_axes({1, 0, 0}, {0, 0, 1});
    for(int k = 0; k < 4; ++k)
      for(double height : {1.2, 4.2})
        model.add_recess(wall, {std::fma(4.3, k, 1.5), height, 1.4, 1.7, 0.2});
    if(i % 2 == 0)
      add_tree(model, f.at({20. * i + 10, 0.8, 0.12}));
    model.curved.push_back({f.at({20. * i + 0.5, 0.4, 0.12}), 0.08, 6, false});
  }
}

} // namespace

Model make_street()
{
  Model model;
  Frame f = Frame().turned({0, 0, 1}, 0.31);
  model.add_rectangle(f.at({0, -4.5, 0}), street_length, 9);
  add_street_side(model, f.at({0, 4.5, 0}));
  add_street_side(model, f.at({street_length, -4.5, 0}).with_axes({-1, 0, 0}, {0, -1, 0}));
  for(int i = 0; i < 5; ++i) {
    add_car(model, f.at({std::fma(21, i, 12.), 3.3, 0}).turned({0, 0, 1}, 0.01 * (i - 2)));
    add_car(model, f.at({std::fma(23, i, 7.), -3.3, 0}).turned({0, 0, 1}, 0.008 * (2 - i)));
  }
  for(int i = 0; i <= 60; ++i)
    model.scanners.push_back(f.point({2. * i, -0.8, 2.2}));
  return model;
}

namespace {

// A prism of six sides about the z axis of its frame
struct Hexagon {
  double apothem, bottom, top;
  unsigned lids;
};

// The prism with the lids that are asked for, and its solid.
void add_hexagon(Model& model, const Frame& f, const Hexagon& h)
{
  const double apothem = h.apothem, bottom = h.bottom, top = h.top, half = 0.5773502691896258 * apothem;
  std::vector<Vec> upper, lower;
  // Without a lid it reaches into what it stands on.
  double root = h.lids & side_bottom ? 0 : 0.1;
  Convex solid = {Model::half_space(f, {0, 0, -1}, root - bottom), Model::half_space(f, {0, 0, 1}, top)};
  Frame side = f;
  for(int i = 0; i < 6; ++i, side = side.turned({0, 0, 1}, 0.5773502691896258)) {
    Frame wall = side.at({apothem, -half, bottom}).with_axes({0, 1, 0}, {0, 0, 1});
    model.add_rectangle(wall, 2 * half, top - bottom);
    solid.push_back(Model::half_space(side, {1, 0, 0}, apothem));
    upper.push_back(side.point({apothem, half, top}));
    lower.push_back(side.point({apothem, half, bottom}));
  }
  std::reverse(lower.begin(), lower.end());
  if(h.lids & side_top)
    model.add_face(Frame(), upper);
  if(h.lids & side_bottom)
    model.add_face(Frame(), lower);
  model.solids.push_back(solid);
}

} // namespace

Model make_tower()
{
  Model model;
  Frame f = Frame().turned({0.2, -0.3, 1}, 0.4);
  add_hexagon(model, f, {3.2, 0, 1.4, side_top});
  add_hexagon(model, f, {2.4, 1.4, 12, 0});
  add_hexagon(model, f, {2.8, 6.8, 7.2, side_top | side_bottom});
  add_hexagon(model, f, {2.8, 11.6, 12, side_top | side_bottom});
  Frame side = f;
  Vec apex = f.point({0, 0, 16});
  Convex spire = {Model::half_space(f, {0, 0, -1}, -11.9)};
  for(int i = 0; i < 6; ++i, side = side.turned({0, 0, 1}, 0.5773502691896258)) {
    Frame wall = side.at({2.4, -1.3856406460551018, 0}).with_axes({0, 1, 0}, {0, 0, 1});
    model.add_recess(wall, {0.75, 3, 1.27, 2.4, 0.35});
    model.add_recess(wall, {0.55, 8.6, 1.67, 1.67, 0.2});
    double half = 0.5773502691896258 * 2.4;
    model.add_face(Frame(), {side.point({2.4, -half, 12}), side.point({2.4, half, 12}), apex});
    spire.push_back({model.faces.back().normal, model.faces.back().offset});
    model.scanners.push_back(side.point({14, 0, 3}));
  }
  model.solids.push_back(spire);
  model.add_face(f, {{-6, -6, 0}, {6, -6, 0}, {6, 6, 0}, {-6, 6, 0}});
  return model;
}

Model make_study()
{
  Model model;
  Frame f = Frame().turned({1, 0.3, 0.2}, 0.9);
  model.add_box_faces(f, {0, 0, 0}, {5, 4, 2.6}, side_all, true);
  model.add_recess(f.with_axes({0, 1, 0}, {0, 0, 1}), {1.2, 0.9, 1.6, 1.3, 0.2});
  add_table(model, f.at({1.8, 0.5, 0}), 1.6, 0.8, 0.74);
  add_table(model, f.at({3.6, 2.2, 0}).turned({0, 0, 1}, 0.1), 1.1, 0.7, 0.5);
  add_shelf(model, f.at({0.6, 3.5, 0}), 2, 2, 4);
  model.add_box(f, {4.2, 0.2, -0.1}, {4.9, 1.1, 1.9});
  model.add_box(f.at({2.6, 2.9, 0}).turned({0, 0, 1}, -0.2), {0, 0, -0.1}, {0.45, 0.45, 0.47});
  model.add_box(f.at({2, 0.7, 0.74}).turned({0, 0, 1}, 0.15), {0, 0, -0.01}, {0.4, 0.25, 0.3});
  model.curved.push_back({f.at({3.1, 1.6, 0.4}), 0.4, 0, false});
  for(Vec p : {Vec{1.2, 1.6, 1.3}, Vec{2.5, 2.2, 1.5}, Vec{3.4, 1.5, 1.2}, Vec{2.2, 1.4, 1.6}, Vec{3, 3, 1.4}})
    model.scanners.push_back(f.point(p));
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
  Vec lid[4] = {{6.8, 1.3, 2.5}, {9.2, 1.3, 2.5}, {9.2, 3.7, 2.5}, {6.8, 3.7, 2.5}};
  model.add_face(f, {lid[0], lid[1], lid[2], lid[3]});
  for(Vec p : {Vec{-8, -8, 9}, Vec{20, -8, 9}, Vec{6, 18, 9}, Vec{6, 4, -14}})
    model.scanners.push_back(f.point(p));
  return model;
}

} // namespace CGAL::Tandem::scenes
