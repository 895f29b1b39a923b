// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes what the pictures of the manual show, as colored clouds, and their numbers as tables which the
// manual includes: so pictures, numbers and program agree.
//   draw_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE CLOUDS TABLES
// writes CLOUDS/*.ply and TABLES/*.md.

#include "clouds/read_ply.h"
#include "shape_colors.h"

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>

namespace np = CGAL::Tandem::parameters;
using namespace CGAL::Tandem::benchmark;

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Point_map = CGAL::First_of_pair_property_map<Point_with_normal>;
using Normal_map = CGAL::Second_of_pair_property_map<Point_with_normal>;
using Range = std::vector<Point_with_normal>;
using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Range, Point_map, Normal_map>;
using Shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;
using CGAL::Tandem::Parameters;

auto named(const Parameters& p)
{
  return np::settings(p).maximum_offset(p.maximum_distance).point_map(Point_map()).normal_map(Normal_map());
}

Detection detection_of(const Shapes& shapes)
{
  Detection detection;
  detection.label.assign(shapes.shape_indices().begin(), shapes.shape_indices().end());
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const auto& c = shapes.coefficients(s);
    detection.planes.push_back({{c[0], c[1], c[2]}, c[3]});
  }
  return detection;
}

// One color for each direction; the directions of most points take the earlier ones.
std::vector<Color> colors_of_directions(const Shapes& shapes)
{
  std::vector<std::size_t> weight(shapes.number_of_parallel_groups()), order(weight.size()), rank(weight.size());
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    weight[shapes.parallel_group(s)] += shapes.points(s).size();
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return weight[a] > weight[b]; });
  for(std::size_t i = 0; i < order.size(); ++i)
    rank[order[i]] = i;
  std::vector<Color> colors;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    colors.push_back(color_of_index(rank[shapes.parallel_group(s)]));
  return colors;
}

// A table of Markdown, one row for each picture.
class Table {
public:
  Table(const std::string& path, const std::string& what) : path_(path), out_(path)
  {
    out_ << "| " << what << " | shapes | directions | planes | complexity | coverage |\n|:--|--:|--:|--:|--:|--:|\n";
  }

  void add(const std::string& name, const Shapes& shapes)
  {
    const CGAL::Tandem::Statistics& s = shapes.statistics();
    char cells[160];
    std::snprintf(cells, sizeof cells, " | %zu | %zu | %zu | %.2f | %.1f %% |\n", s.number_of_shapes,
                  s.number_of_directions, s.number_of_planes, s.complexity, 100 * s.coverage);
    out_ << "| " << name << cells;
  }

  void close()
  {
    out_.close();
    if(!out_)
      throw std::runtime_error(path_ + ": cannot be written");
  }

private:
  std::string path_;
  std::ofstream out_;
};

class Figures {
public:
  Figures(const Ply_cloud& cloud, const Parameters& right, const std::string& clouds, const std::string& tables)
    : cloud_(cloud), points_(points_with_normals<Kernel>(cloud.points, cloud.normals)), clouds_(clouds + "/"),
      tables_(tables + "/"), right_(right)
  {
    final_shapes_ = detect(right_);
  }

  // What there is after the rounds 1, 2 and 3, and at the end, each shape in its final color. Shapes below the
  // minimum size are not shown, so it is small here: young ones are of interest.
  void draw_rounds()
  {
    Parameters p = right_;
    p.minimum_region_size = 20;
    final_ = detection_of(detect(p));
    Table table(tables_ + "rounds.md", "after");
    CGAL::Tandem::Planar_shape_detection_3<Traits> detection(points_, named(p));
    for(int round = 1; detection.iterate(); ++round)
      if(round <= 3) {
        draw("round_" + std::to_string(round), detection.shapes());
        table.add("round " + std::to_string(round), detection.shapes());
      }
    detection.finish();
    draw("round_last", detection.shapes());
    const std::size_t rounds = detection.shapes().statistics().number_of_rounds;
    table.add("round " + std::to_string(rounds) + ", and the end game", detection.shapes());
    table.close();
  }

  // The same with one parameter too small and too large.
  void draw_choices()
  {
    final_ = detection_of(final_shapes_);
    draw("right", final_shapes_);
    choose("maximum_distance", &Parameters::maximum_distance,
           {right_.maximum_distance / 10, right_.maximum_distance * 10});
    choose("maximum_angle", &Parameters::maximum_angle, {5., 75.});
    choose("minimum_region_size", &Parameters::minimum_region_size, {std::size_t(10), std::size_t(2000)});
    choose("angle_tolerance", &Parameters::angle_tolerance, {.5, 40.}, true);
    choose("simplicity", &Parameters::simplicity, {0., .3});
    choose("regularity", &Parameters::regularity, {0., 1.}, true);
    draw_directions("right_directions", final_shapes_);
  }

private:
  Shapes detect(const Parameters& p) const { return CGAL::Tandem::detect_planes(points_, named(p)); }

  void draw(const std::string& name, const Shapes& shapes) const
  {
    const Detection detection = detection_of(shapes);
    write(name, detection, colors_like(final_, detection));
  }

  void draw_directions(const std::string& name, const Shapes& shapes) const
  {
    write(name, detection_of(shapes), colors_of_directions(shapes));
  }

  void write(const std::string& name, const Detection& detection, const std::vector<Color>& colors) const
  {
    write_ply(clouds_ + name + ".ply", colored(cloud_, detection, colors));
  }

  template <class Number>
  void choose(const std::string& name, Number Parameters::*parameter, const std::vector<Number>& values,
              bool by_direction = false) const
  {
    Table table(tables_ + name + ".md", "`" + name + "`");
    const auto text = [](Number value) { return CGAL::Tandem::internal::to_text(value); };
    for(std::size_t i = 0; i < values.size(); ++i) {
      Parameters p = right_;
      p.*parameter = values[i];
      const Shapes shapes = detect(p);
      const std::string picture = name + (i == 0 ? "_small" : "_large");
      by_direction ? draw_directions(picture, shapes) : draw(picture, shapes);
      table.add(text(values[i]), shapes);
      if(i == 0)
        table.add(text(right_.*parameter), final_shapes_);
    }
    table.close();
  }

  const Ply_cloud& cloud_;
  Range points_;
  std::string clouds_, tables_;
  Parameters right_;
  Shapes final_shapes_;
  Detection final_; // gives the colors
};

} // namespace

int main(int argc, char** argv)
try {
  if(argc != 7) {
    std::cerr << "usage: draw_figures CLOUD.ply MAXIMUM_DISTANCE MAXIMUM_ANGLE MINIMUM_REGION_SIZE CLOUDS TABLES\n";
    return 2;
  }
  const Ply_cloud cloud = read_ply(argv[1]);
  if(!cloud.has_normals())
    throw std::runtime_error("the cloud has no normals");
  Parameters right;
  right.maximum_distance = std::atof(argv[2]);
  right.maximum_angle = std::atof(argv[3]);
  right.minimum_region_size = std::size_t(std::atol(argv[4]));
  Figures figures(cloud, right, argv[5], argv[6]);
  figures.draw_rounds();
  figures.draw_choices();
  return 0;
} catch(const std::exception& e) {
  std::cerr << "draw_figures: " << e.what() << "\n";
  return 1;
}
