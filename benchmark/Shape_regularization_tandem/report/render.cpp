// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Draws a cloud and the shapes that a detector found in it, side by side.

#include "Scene_view.h"
#include "criteria/detection_files.h"
#include "testing/fit_plane.h"

#include <boost/program_options.hpp>

#include <iostream>

namespace po = boost::program_options;
using namespace CGAL::Tandem::benchmark;

namespace {

struct Request {
  std::string cloud, picture, labels, like;
  View view;
  std::vector<double> vertical;
  Picture_size size;
  bool is_alone = false;
};

// False: only the help was asked for.
bool parse(int argc, char** argv, Request& r)
{
  po::options_description visible("render CLOUD.ply PICTURE.png [options]"), all;
  auto option = visible.add_options();
  option("help", "this text");
  option("labels", po::value(&r.labels),
         "shapes of the points, one little-endian int32 each; default: the property `shape` or `label` of the cloud");
  option("like", po::value(&r.like), "labels whose colors are taken for the shapes with most points in common");
  option("azimuth", po::value(&r.view.azimuth_deg), "of the viewer, in degrees; default: where most can be seen");
  option("elevation", po::value(&r.view.elevation_deg), "of the viewer, in degrees; default: 35, of rooms 52");
  option("vertical", po::value(&r.vertical)->multitoken(), "X Y Z, a vector that points up; default: 0 0 1");
  option("width", po::value(&r.size.width)->default_value(600), "of one view, pixels");
  option("height", po::value(&r.size.height)->default_value(450), "of one view, pixels");
  option("alone", po::bool_switch(&r.is_alone), "only the shapes, without the cloud beside them");
  auto hidden = all.add(visible).add_options();
  hidden("cloud", po::value(&r.cloud)->required());
  hidden("picture", po::value(&r.picture)->required());
  po::positional_options_description position;
  position.add("cloud", 1).add("picture", 1);
  po::variables_map values;
  auto style = po::command_line_style::unix_style & ~po::command_line_style::allow_short;
  po::store(po::command_line_parser(argc, argv).options(all).positional(position).style(style).run(), values);
  if(values.count("help")) {
    std::cout << visible;
    return false;
  }
  po::notify(values);
  if(!r.vertical.empty() && r.vertical.size() != 3)
    throw std::runtime_error("--vertical takes three numbers");
  if(r.vertical.size() == 3)
    r.view.vertical = {r.vertical[0], r.vertical[1], r.vertical[2]};
  if(r.size.width < 16 || r.size.height < 16)
    throw std::runtime_error("--width and --height must be at least 16");
  return true;
}

Detection detection_of(const Ply_cloud& cloud, const std::vector<std::int32_t>& label)
{
  if(label.size() != cloud.points.size())
    throw std::runtime_error(std::to_string(label.size()) + " labels for " + std::to_string(cloud.points.size()) +
                             " points; give others with --labels FILE");
  std::int32_t last = label.empty() ? -1 : *std::max_element(label.begin(), label.end());
  return {label, fit_planes(cloud.points, label, std::size_t(last + 1))};
}

void run(const Request& request)
{
  Ply_cloud cloud = read_ply(request.cloud);
  Detection detection = detection_of(cloud, request.labels.empty() ? cloud.label : read_labels(request.labels));
  std::vector<Color> colors = request.like.empty()
                                ? colors_of(detection)
                                : colors_like(detection_of(cloud, read_labels(request.like)), detection);
  Scene_view view(cloud, request.view, request.size);
  Picture shapes = view.draw(detection, colors, std::vector<bool>(cloud.points.size()));
  (request.is_alone ? shapes : view.draw_input().beside(shapes)).write_png(request.picture);
}

} // namespace

int main(int argc, char** argv)
try {
  Request request;
  if(parse(argc, argv, request))
    run(request);
  return 0;
} catch(const po::error& e) {
  std::cerr << "render: " << e.what() << "; see render --help\n";
  return 2;
} catch(const std::exception& e) {
  std::cerr << "render: " << e.what() << "\n";
  return 1;
}
