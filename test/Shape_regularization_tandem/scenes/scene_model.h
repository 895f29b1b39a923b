// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a generated scene is made of: planar faces, curved patches, and the convex volumes that hide parts of them; and the
// models of all scenes. The same bits on every machine: only + - * / sqrt fma are used, and turned parts are placed by
// quaternions.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_MODEL_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_MODEL_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL::Tandem::scenes {

struct Vec {
  double x, y, z;
};

inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }

// a + s b
inline Vec add_scaled(const Vec& a, double s, const Vec& b)
{
  return {std::fma(s, b.x, a.x), std::fma(s, b.y, a.y), std::fma(s, b.z, a.z)};
}

inline double dot(const Vec& a, const Vec& b) { return std::fma(a.x, b.x, std::fma(a.y, b.y, a.z * b.z)); }

inline Vec cross(const Vec& a, const Vec& b)
{
  return {std::fma(a.y, b.z, -(a.z * b.y)), std::fma(a.z, b.x, -(a.x * b.z)), std::fma(a.x, b.y, -(a.y * b.x))};
}

inline double length(const Vec& a) { return std::sqrt(dot(a, a)); }
inline Vec unit(const Vec& a) { return (1 / length(a)) * a; }

// A local coordinate system. The axes are orthonormal and right-handed.
struct Frame {
  Vec origin{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec vector(const Vec& v) const { return add_scaled(add_scaled(v.x * x, v.y, y), v.z, z); }
  Vec point(const Vec& p) const { return origin + vector(p); }

  Frame at(const Vec& p) const { return {point(p), x, y, z}; }

  // The frame turned about its own axis `v` by 2 atan(t).
  Frame turned(const Vec& v, double t) const
  {
    Vec q = t * unit(v);
    auto turn = [&](const Vec& a) {
      Vec c = cross(q, a);
      return vector(add_scaled(a, 2 / std::fma(t, t, 1.0), c + cross(q, c)));
    };
    Vec new_x = unit(turn({1, 0, 0})), new_z = unit(cross(new_x, turn({0, 1, 0})));
    return {origin, new_x, cross(new_z, new_x), new_z};
  }

  // Of walls, with the third axis upwards: their normals are -y and x.
  Frame upright() const { return with_axes({1, 0, 0}, {0, 0, 1}); }
  Frame sideways() const { return with_axes({0, 1, 0}, {0, 0, 1}); }

  // Axes: u and v as given (in this frame, orthogonal), and their cross product.
  Frame with_axes(const Vec& u, const Vec& v) const { return {origin, vector(u), vector(v), vector(cross(u, v))}; }
};

// normal . p + offset is 0, and negative inside of what it bounds.
struct Plane {
  Vec normal;
  double offset;
};
using Convex = std::vector<Plane>;

// A surface that is not quite planar: a parabola along an axis in the plane of its face, which lies at its mean height.
struct Bend {
  Vec axis{0, 0, 0};          // unit
  double first = 0, last = 1; // axis . p where the surface begins and ends
  double sag = 0;             // how much higher its middle is than these ends; negative in a valley

  double height(const Vec& p) const
  {
    const double t = position(p);
    return sag * (std::fma(4 * t, 1 - t, -2. / 3));
  }

  Vec normal(const Vec& p, const Vec& face_normal) const
  {
    return unit(add_scaled(face_normal, -4 * sag * std::fma(-2, position(p), 1.) / (last - first), axis));
  }

private:
  double position(const Vec& p) const { return (dot(axis, p) - first) / (last - first); }
};

struct Face : Plane { // with a unit normal, outward
  std::vector<std::array<Vec, 3>> triangles;
  Bend bend{};
};

// A cylinder without lids, or (height 0) a sphere. Its points have the label -1.
struct Curved {
  Frame frame; // the axis is frame.z
  double radius, height;
  bool is_hole; // normals point to the axis
};

constexpr unsigned side_left = 1, side_right = 2, side_front = 4, side_back = 8, side_bottom = 16, side_top = 32;
constexpr unsigned side_walls = 15, side_visible = 47, side_all = 63;

// A rectangular hollow in a wall: its corner and size there.
struct Recess {
  double u, v, width, height, depth;
  unsigned sides = side_walls;
};

// A point on a face is kept when it lies strictly inside no void, and strictly
// inside a solid only where it lies on the boundary of a void.
struct Model {
  std::vector<Face> faces;
  std::vector<Curved> curved;
  std::vector<Convex> solids, voids;
  std::vector<Vec> scanners; // where the density is highest, if it varies

  // Corners counter-clockwise seen from outside, convex.
  std::size_t add_face(const Frame& frame, const std::vector<Vec>& corners)
  {
    Vec normal = unit(frame.vector(cross(corners[1] - corners[0], corners[2] - corners[0])));
    faces.push_back({{normal, -dot(normal, frame.point(corners[0]))}, {}, {}});
    extend_face(faces.size() - 1, frame, corners);
    return faces.size() - 1;
  }

  // Another convex part of the same face.
  void extend_face(std::size_t face, const Frame& frame, const std::vector<Vec>& corners)
  {
    for(std::size_t i = 2; i < corners.size(); ++i)
      faces[face].triangles.push_back({frame.point(corners[0]), frame.point(corners[i - 1]), frame.point(corners[i])});
  }

  void add_rectangle(const Frame& frame, double width, double height)
  {
    add_face(frame, {{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}});
  }

  // The same, bent along its width.
  void add_bent_rectangle(const Frame& frame, double width, double height, double sag)
  {
    add_rectangle(frame, width, height);
    const double first = dot(frame.x, frame.origin);
    faces.back().bend = {frame.x, first, first + width, sag};
  }

  // The faces of an axis-parallel box of `frame`, of these sides, seen from outside or from inside.
  void add_box_faces(const Frame& frame, const Vec& a, const Vec& b, unsigned sides, bool is_inward = false)
  {
    static const int corners_of[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}; // bits: b instead of a
    for(int side = 0; side < 6; ++side)
      if(sides >> side & 1) {
        std::vector<Vec> corners;
        for(int c : corners_of[side])
          corners.push_back({c & 1 ? b.x : a.x, c & 2 ? b.y : a.y, c & 4 ? b.z : a.z});
        if(is_inward)
          std::reverse(corners.begin(), corners.end());
        add_face(frame, corners);
      }
  }

  void add_box(const Frame& frame, const Vec& a, const Vec& b, unsigned sides = side_visible)
  {
    add_box_faces(frame, a, b, sides);
    solids.push_back(box(frame, a, b));
  }

  void add_scanners(const Frame& frame, const std::vector<Vec>& places)
  {
    for(const Vec& p : places)
      scanners.push_back(frame.point(p));
  }

  // A recess in a wall: `wall` has its z axis outward and its origin in the wall.
  void add_recess(const Frame& wall, const Recess& r)
  {
    add_box_faces(wall, {r.u, r.v, -r.depth}, {r.u + r.width, r.v + r.height, 0}, r.sides | side_bottom, true);
    voids.push_back(box(wall, {r.u, r.v, -r.depth}, {r.u + r.width, r.v + r.height, 0.1 * r.height}));
  }

  static Plane half_space(const Frame& frame, const Vec& normal, double distance)
  {
    Vec n = frame.vector(normal);
    return {n, -(dot(n, frame.origin) + distance)};
  }

  static Convex box(const Frame& frame, const Vec& a, const Vec& b)
  {
    return {half_space(frame, {-1, 0, 0}, -a.x), half_space(frame, {1, 0, 0}, b.x),
            half_space(frame, {0, -1, 0}, -a.y), half_space(frame, {0, 1, 0}, b.y),
            half_space(frame, {0, 0, -1}, -a.z), half_space(frame, {0, 0, 1}, b.z)};
  }

  // Whether p lies in all half spaces, farther than `margin` from their borders.
  static bool is_inside(const Convex& convex, const Vec& p, double margin)
  {
    return std::all_of(convex.begin(), convex.end(),
                       [&](const Plane& h) { return dot(h.normal, p) + h.offset < -margin; });
  }

  bool is_hidden(const Vec& p, double margin) const
  {
    auto strictly = [&](const Convex& c) { return is_inside(c, p, margin); };
    if(std::any_of(voids.begin(), voids.end(), strictly))
      return true;
    if(std::none_of(solids.begin(), solids.end(), strictly))
      return false;
    return std::none_of(voids.begin(), voids.end(), [&](const Convex& c) { return is_inside(c, p, -margin); });
  }

  // Whether a point of the plane of the face is on its visible part.
  bool is_on(const Face& face, const Vec& p, double margin) const
  {
    const auto holds = [&](const std::array<Vec, 3>& t) {
      for(std::size_t i = 0; i < 3; ++i)
        if(dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), face.normal) < 0)
          return false;
      return true;
    };
    return std::any_of(face.triangles.begin(), face.triangles.end(), holds) && !is_hidden(p, margin);
  }
};

// The models of scenes. Lengths in metres, or units.

// --- Small ones, whose shapes, directions and planes can be counted by hand

// 6 faces, 3 directions, 6 planes: complexity 9/18.
Model make_cube(const Frame& frame = Frame());

// The faces of a turned cube, each tilted by `degrees` about an own axis: right
// angles hold only within 2 `degrees`, opposite faces are parallel within as much.
Model make_tilted_cube(double degrees = 2);

// 2 n faces, 2 directions, 2 n planes.
Model make_staircase(int steps = 8);

// Two coplanar squares: 2 faces with a gap, otherwise 1.
Model make_squares(double gap);

// A long plane of slope `degrees` that begins at the end of a flat one, beside
// another flat one: must neither be flattened nor cut into terraces.
Model make_slope(double degrees = 2);

// Separate squares, each turned by `degrees` against the one before.
Model make_chained(double degrees = 5, int count = 3);

// A master and two followers orthogonal to it that enclose 53.13 degrees.
Model make_two_followers();

// Two parallel squares side by side, the second higher by `offset`.
Model make_offset_pair(double offset);

Model make_sphere();

// --- Floors, roads and roofs that are not quite planar, as real ones. How much they bend in units of epsilon is up to the
// epsilon they are detected with. The truth of a bent face is its mean plane.

// 8 by 5 m. Floor and ceiling sag by 2 and 4 cm, a wall is planar. A board hangs 2.2 cm before that wall, and another
// one 6 cm: layers. Columns of three radii.
Model make_bent_hall();

// 30 m of a road that is 12 cm lower in its middle, with a planar wall, and two roofs warped by 6 cm, to either side.
Model make_bent_road();

// --- A house with windows and roof, sixteen turned houses, furnished rooms, a mechanical part

Model make_house();

// Sixteen houses, each turned 2.9 degrees more than the one before: 65 directions
// (two of the walls and two of the roof for each house, and the vertical).
Model make_village();

Model make_indoor();

// A block with a slot, steps, a chamfer, a pocket, a boss and holes.
Model make_part();

// A plate with balls and drums: two thirds of the surface are curved.
Model make_curved();

// --- Those of the labeled frames

// A furnished room of 6 by 5 by 2.7 m: tables, shelves, boxes; and cylinders and a ball, which are clutter.
Model make_office();

// A room of 17 planes; floor, ceiling, walls, boards, and doors are parallel to others but for 2 to 5 degrees.
Model make_tilted_room();

// The roof of a house of 12 by 9 m without its walls: gable, low, hip, dormers, wing, mansard,
// hall (saw teeth), villa (hip, wing and dormers).
Model make_roof(const std::string& kind);

// A wall of 4 by 3 m in the xy plane of the frame. One face: bend (a V) and bow, whose points are within `height` of a
// plane; offset and half-offset, two scans `height` apart that overlap wholly or by half. A face for each layer, higher
// by `height` than the one below: halves, inset, strip, stairs (three), boards (three before a wall), strips (five).
Model make_wall(const std::string& kind, double height, const Frame& frame);

// Around such a wall: floor and side wall; floor, ceiling and columns; the other side of a roof, and a chimney.
enum class Place { room, hall, roof };
void add_place(Model& model, Place place, const Frame& wall);

} // namespace CGAL::Tandem::scenes

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_SCENE_MODEL_H
