// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Judges the labels and planes that a detector wrote for a cloud, whichever
// detector it was, by the paper's criteria and, where it is known, the truth.

#include "criteria/detection_files.h"
#include "testing/evaluate_columns.h"
#include "testing/fit_plane.h"
#include "clouds/ply_cloud.h"

#include <boost/program_options.hpp>

#include <iostream>

namespace po = boost::program_options;
using namespace CGAL::Tandem::benchmark;

namespace {

struct Request {
  std::string cloud, labels, planes, normals, truth, name;
  Tolerances tolerances{0, 25};
  std::size_t minimum = 200;
  bool fits_truth = false, is_csv = false, has_header = false;
};

Request parse(int argc, char** argv)
{
  Request r;
  po::options_description visible("evaluate CLOUD.ply --labels FILE --planes FILE --maximum-distance D [options]"), all;
  visible.add_options()("help", "this text")("labels", po::value(&r.labels)->required(),
                                             "one little-endian int32 per point, -1 for none")(
    "planes", po::value(&r.planes)->required(), "one line a b c d per shape")(
    "maximum-distance", po::value(&r.tolerances.maximum_distance)->required(), "epsilon, units of the cloud")(
    "maximum-angle", po::value(&r.tolerances.maximum_angle_deg)->default_value(25), "alpha, degrees")(
    "normals", po::value(&r.normals), "take the normals from this PLY (same points in the same order)")(
    "truth", po::value(&r.truth), "planes of the true faces; default: CLOUD.ply.truth, if there is such a file")(
    "fit-truth", po::bool_switch(&r.fits_truth), "the labels of the cloud are true faces: fit their planes")(
    "minimum-region-size", po::value(&r.minimum)->default_value(200), "smaller true faces need not be found")(
    "name", po::value(&r.name), "first column of the table; default: the cloud")(
    "csv", po::bool_switch(&r.is_csv), "one line, comma separated")("header", po::bool_switch(&r.has_header),
                                                                    "with --csv: the names of the columns before it");
  all.add(visible).add_options()("cloud", po::value(&r.cloud)->required());
  po::positional_options_description position;
  position.add("cloud", 1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(all).positional(position).run(), values);
  if(values.count("help")) {
    std::cout << visible;
    std::exit(0);
  }
  po::notify(values);
  if(r.name.empty())
    r.name = r.cloud;
  if(r.truth.empty() && !r.fits_truth && std::ifstream(r.cloud + ".truth"))
    r.truth = r.cloud + ".truth";
  return r;
}

Truth make_truth(const Request& request, const Ply_cloud& cloud)
{
  if(!cloud.has_label())
    throw std::runtime_error(request.cloud + ": has no property label, so there is no truth");
  if(!request.fits_truth)
    return {cloud.label, read_planes(request.truth)};
  std::int32_t last = *std::max_element(cloud.label.begin(), cloud.label.end());
  return {cloud.label, fit_planes(cloud.points, cloud.label, std::size_t(last) + 1)};
}

void print(const Row& row, bool is_csv, bool has_header)
{
  auto print_line = [&](auto column) {
    for(std::size_t i = 0; i < row.size(); ++i)
      std::cout << (i > 0 ? "," : "") << column(row[i]);
    std::cout << "\n";
  };
  if(!is_csv)
    for(const auto& cell : row)
      std::cout << std::left << std::setw(34) << cell.first << cell.second << "\n";
  if(is_csv && has_header)
    print_line([](const auto& cell) { return cell.first; });
  if(is_csv)
    print_line([](const auto& cell) { return cell.second; });
}

void run(const Request& request)
{
  Ply_cloud cloud = read_ply(request.cloud);
  if(!request.normals.empty())
    cloud.normals = read_ply(request.normals).normals;
  if(cloud.has_normals() && cloud.normals.size() != cloud.points.size())
    throw std::runtime_error(request.normals + ": has another number of points");
  Detection detection{read_labels(request.labels), read_planes(request.planes)};
  Row row{{"cloud", request.name}};
  append_cell(row, "points", cloud.points.size());
  append_criteria(row, evaluate(cloud.points, cloud.normals, detection, request.tolerances));
  append_curves(row, evaluate_curves(cloud.points, cloud.normals, detection, request.tolerances));
  if(!request.truth.empty() || request.fits_truth)
    append_truth(row, evaluate_truth(make_truth(request, cloud), detection, extent_of(cloud.points), request.minimum));
  print(row, request.is_csv, request.has_header);
}

} // namespace

int main(int argc, char** argv)
try {
  run(parse(argc, argv));
  return 0;
} catch(const std::exception& e) {
  std::cerr << "evaluate: " << e.what() << "\n";
  return 1;
}
