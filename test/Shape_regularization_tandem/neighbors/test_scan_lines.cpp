// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points on scan lines that are 30 times farther apart than they are: neighbors are on other lines of the surface, also at
// its border, where lines turn, and where noise gives lines a width. All other rows stay. Shapes are whole faces, and
// cables, poles and wires take no part of them. The estimate of the tolerance does not depend on the gaps.

#include "testing/body_fixture.h"

#include "scenes/labeled_scenes.h"
#include "scenes/sensor.h"

#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>
#include <CGAL/Tandem/internal/neighbors/cross_scan_lines.h>

#include <map>
#include <set>
#include <string>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_scan_lines)

using namespace CGAL::Tandem::internal;

constexpr std::int32_t along = 100, gap = 30 * along; // from a point to the next one, from a line to the next one

// The profiles of a floor and a wall, whose lines turn up where they meet, with a noise in steps; a cable far above.
std::vector<Grid_point> make_corner(std::int32_t noise)
{
  scenes::Random random(5);
  const auto bump = [&] { return std::int32_t((2 * random.uniform() - 1) * noise); };
  std::vector<Grid_point> lines;
  for(std::int32_t line = 0; line < 20; ++line)
    for(std::int32_t i = 0; i < 200; ++i) {
      const std::int32_t x = i < 100 ? 0 : (i - 100) * along, z = i < 100 ? (100 - i) * along : 0;
      lines.push_back({x + bump(), line * gap + bump(), z + bump(), no_normal});
    }
  for(std::int32_t i = 0; i < 300; ++i)
    lines.push_back({i * along + bump(), 10 * gap + bump(), 40 * gap + bump(), no_normal});
  return lines;
}

bool is_of_cable(const Grid_point& p) { return p.z > 30 * gap; }
int line_of(const Grid_point& p) { return is_of_cable(p) ? -1 : int((p.y + gap / 2) / gap); }

// The rows before and after, and what else there is.
struct Crossing {
  Fixture before;
  std::vector<std::uint32_t> after;
  double spacing = 0;

  Crossing(const std::vector<Grid_point>& lines, int k, std::size_t cell_size) : k_(k)
  {
    set_points(before, lines, k, cell_size);
    cross(Sequential_backend());
    const std::vector<std::uint32_t> expected = after;
    const double expected_spacing = spacing;
    on_body_backends([&](auto backend, const std::string& name) {
      cross(backend);
      CHECK_AT(after == expected && spacing == expected_spacing, name);
    });
  }

  const std::uint32_t* row(std::uint32_t i) const { return &after[i * std::size_t(k_)]; }

private:
  template <class Backend>
  void cross(Backend backend)
  {
    Sorted_cloud<Backend> cloud;
    cloud.k = k_;
    cloud.point = to_buffer(backend, before.point);
    cloud.neighbor = to_buffer(backend, before.neighbor);
    Ranks<Backend> ranks(backend);
    const auto cells = to_buffer(backend, before.cells);
    cross_scan_lines(backend, ranks, cloud, cells, make_code_frame(before.point.data(), before.point.size()));
    after = to_vector(backend, cloud.neighbor);
    spacing = cloud.line_spacing_steps;
  }

  int k_;
};

BOOST_AUTO_TEST_CASE(rows)
{
  for(const std::int32_t noise : {0, 30, 100})
    for(const int k : {8, 12, 30})
      for(const std::size_t cell_size : {std::size_t(64), std::size_t(8192)}) {
        const Crossing c(make_corner(noise), k, cell_size);
        const std::string where =
          "noise " + std::to_string(noise) + ", k = " + std::to_string(k) + ", cells of " + std::to_string(cell_size);
        const std::vector<Grid_point>& point = c.before.point;
        int alone = 0;
        for(std::uint32_t i = 0; i < point.size(); ++i) {
          const std::uint32_t* const row = c.row(i);
          const std::string at = where + ", point " + std::to_string(i);
          const int size = int(std::find(row, row + k, no_index) - row);
          const int near = (std::min)(k, 12) / 2;
          CHECK_AT(size >= near && std::equal(row, row + near, c.before.cloud.row(i)), at + ": the nearest ones");
          const std::set<std::uint32_t> distinct(row, row + size);
          CHECK_AT(distinct.size() == std::size_t(size) && distinct.count(i) == 0 && *distinct.rbegin() < point.size(),
                   at + ": one is there twice");
          const int own = line_of(point[i]);
          std::set<int> others;
          for(int j = 0; j < (std::min)(size, 12); ++j) // those from which normals are estimated
            others.insert(line_of(point[row[j]]));
          CHECK_AT(own < 0 || others.count(-1) == 0, at + ": a point of the cable");
          alone += own >= 0 && others.size() < 2;
        }
        // Noise as large as the distance of points makes few rows wide by chance.
        CHECK_AT(alone <= (noise < along ? 0 : 150), where + ": " + std::to_string(alone) +
                                                       " points have no neighbor on "
                                                       "another line");
        CHECK_AT(c.spacing > .6 * gap && c.spacing < 1.4 * gap,
                 where + ": lines " + std::to_string(c.spacing) + " apart");
      }
}

// Where points are evenly spaced, few neighborhoods are lines by chance.
BOOST_AUTO_TEST_CASE(other_clouds_keep_their_rows)
{
  for(const Fixture& fixture : fixtures()) {
    const Crossing c(fixture.point, fixture.cloud.k, 8192);
    CHECK_AT(c.after == c.before.neighbor && c.spacing == 0, fixture.name);
  }
}

// --- Shapes. A lidar of 32 beams between two walls, above the floor; before it a cable, a pole and a fence of wires.

enum Part { floor_part, left_wall, right_wall, cable, pole, fence };

struct Street {
  Cloud cloud;
  std::vector<Part> part;

  Street()
  {
    using namespace scenes;
    Model model;
    model.add_rectangle(Frame().at({-40, -6, -1.8}), 80, 14);
    for(const double y : {-6., 8.})
      model.add_rectangle(Frame().at({-40, y, -1.8}).upright(), 80, 11.8);
    const auto along_x = [](double width, double y, double z) {
      return Frame().at({-width / 2, y, z}).with_axes({0, 1, 0}, {0, 0, 1});
    };
    model.curved = {{along_x(78, 1, 3), .03, 78, false}, {Frame().at({-4, 2, -1.8}), .15, 3.6, false}};
    for(int wire = 0; wire < 8; ++wire)
      model.curved.push_back({along_x(20, 4, -1.7 + .15 * wire), .01, 20, false});
    const Scene scene = scan(model, {Sensor_kind::lidar, Frame(), 1800, 32, 6.2831853, .5235988, -.2617994, .02, 7});
    for(std::size_t i = 0; i < scene.points.size(); ++i) {
      const Vec& p = scene.ideal[i];
      if(length(p) > 40)
        continue;
      add(cloud, scene.points[i], {0, 0, 0});
      part.push_back(part_of(scene.label[i], p));
    }
  }

private:
  static Part part_of(int label, const scenes::Vec& p)
  {
    if(label < 0)
      return p.z > 2 ? cable : p.y < 3 ? pole : fence;
    return p.z < -1.7999 ? floor_part : p.y > 0 ? left_wall : right_wall;
  }
};

BOOST_AUTO_TEST_CASE(street)
{
  const Street street;
  for(const double epsilon : {.06, .08}) {
    const std::string where = "epsilon " + std::to_string(epsilon) + ": ";
    const Shapes shapes = detect_valid("street", street.cloud, make_parameters(epsilon, 100), Given::nothing);
    std::map<std::size_t, std::map<Part, int>> parts; // of each shape
    std::map<Part, std::map<std::size_t, int>> shapes_of;
    std::map<Part, int> size;
    for(std::size_t i = 0; i < street.cloud.size(); ++i) {
      ++size[street.part[i]];
      if(const auto s = shapes.shape_indices()[i]; s >= 0) {
        ++parts[std::size_t(s)][street.part[i]];
        ++shapes_of[street.part[i]][std::size_t(s)];
      }
    }
    for(const Part face : {floor_part, left_wall, right_wall}) {
      int largest = 0;
      for(const auto& [s, points] : shapes_of[face])
        largest = (std::max)(largest, points);
      CHECK_AT(largest > .8 * size[face], where + "face " + std::to_string(face) + " has " + std::to_string(largest) +
                                            " of " + std::to_string(size[face]) + " points in one shape");
    }
    CHECK_AT(size[cable] > 10 && size[pole] > 100 && size[fence] > 100, where + "too little is seen");
    CHECK_AT(shapes_of[cable].empty(), where + "the cable is in a shape");
    for(const auto& [s, of] : parts) {
      int surface = 0, other = 0;
      for(const auto& [part, points] : of)
        (part <= right_wall ? surface : other) += points;
      CHECK_AT((std::min)(surface, other) <= .05 * (surface + other),
               where + "shape " + std::to_string(s) + " has " + std::to_string(surface) + " points of faces and " +
                 std::to_string(other) + " of poles and wires");
    }
  }
}

// All points of the first and the last line of a face, and of its ends. Lines are evenly spaced, or nearly so.
// The estimate does not take the gaps between lines for noise.
BOOST_AUTO_TEST_CASE(estimate)
{
  int found = 0;
  for(const scenes::Labeled_scene& scene : scenes::labeled_scan_lines())
    if(scene.name.rfind("lidar-street-16-level", 0) == 0) {
      std::vector<Epick::Point_3> points;
      for(const scenes::Vec& p : scene.make().points)
        points.emplace_back(p.x, p.y, p.z);
      const double estimate = CGAL::Tandem::estimate_parameters(points).maximum_distance;
      CHECK_AT(estimate > .5 * scene.epsilon && estimate < 2 * scene.epsilon, std::to_string(estimate));
      ++found;
    }
  CHECK(found == 1);
}

BOOST_AUTO_TEST_CASE(border)
{
  for(const double jitter : {0., .1})
    for(const std::size_t k : {12, 13, 30})
      for(const double epsilon : {0., .0075}) { // lines are 8 epsilons apart; or estimated
        scenes::Random random(8);
        Cloud cloud;
        for(int line = 0; line < 30; ++line) {
          const double y = .06 * (line + jitter * random.gaussian());
          for(int i = 0; i < 200; ++i)
            add(cloud, {.002 * i, y, .0005 * random.gaussian()}, {0, 0, 0});
        }
        Parameters parameters;
        parameters.maximum_distance = epsilon;
        parameters.k_neighbors = k;
        const std::string where = "uneven by " + std::to_string(jitter) + ", k = " + std::to_string(k) + ", epsilon " +
                                  std::to_string(epsilon) + ": ";
        const Shapes shapes = detect_valid(where, cloud, parameters, Given::nothing);
        check_equal(shapes.number_of_shapes(), std::size_t(1), where + "shapes");
        const std::size_t free = shapes.statistics().free_points.total();
        CHECK_AT(free < 60, where + "free points: " + std::to_string(free));
        const double spacing = shapes.statistics().line_spacing;
        CHECK_AT(spacing > .03 && spacing < .08, where + "lines " + std::to_string(spacing) + " apart");
      }
}

BOOST_AUTO_TEST_SUITE_END()
