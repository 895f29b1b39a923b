// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Judges the labels and planes that a detector wrote for a cloud, whichever
// detector it was, by the paper's criteria and, where it is known, the truth.

#include "detection_files.h"
#include "fit_plane.h"
#include "ply_cloud.h"

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

// A table of (name, value), printed as lines or as a row. Names have no comma.
class Table {
public:
  template <class T>
  void add(const std::string& name, const T& value)
  {
    std::ostringstream text;
    text << std::setprecision(5) << value;
    cells_.emplace_back(name, text.str());
  }

  void print(bool is_csv, bool has_header) const
  {
    if(!is_csv)
      for(const auto& cell : cells_)
        std::cout << std::left << std::setw(34) << cell.first << cell.second << "\n";
    if(is_csv && has_header)
      print_row([](const auto& cell) { return cell.first; });
    if(is_csv)
      print_row([](const auto& cell) { return cell.second; });
  }

private:
  template <class Function>
  void print_row(Function column) const
  {
    for(std::size_t i = 0; i < cells_.size(); ++i)
      std::cout << (i > 0 ? "," : "") << column(cells_[i]);
    std::cout << "\n";
  }

  std::vector<std::pair<std::string, std::string>> cells_;
};

void add_counts(Table& table, const std::string& kind, const Relation_counts& counts)
{
  table.add("directions " + kind, counts.directions);
  table.add("planes " + kind, counts.planes);
  table.add("degrees of freedom " + kind, counts.degrees_of_freedom);
  table.add("complexity " + kind, counts.complexity);
}

void add_criteria(Table& table, const Criteria& c, const Tolerances& tolerances)
{
  table.add("points", c.points);
  table.add("shapes", c.shapes);
  table.add("coverage %", 100 * c.coverage());
  table.add("mean distance", c.mean_distance);
  table.add("max distance / epsilon", c.max_distance / tolerances.maximum_distance);
  table.add("points beyond epsilon", c.beyond_epsilon);
  table.add("points beyond alpha", c.beyond_alpha);
  table.add("mean angle of normals", c.mean_normal_angle_deg);
  table.add("smallest shape", c.smallest_shape);
  table.add("normals not unit", c.not_unit);
  add_counts(table, "exact", c.exact);
  add_counts(table, "within 1e-6", c.relaxed);
}

void add_relations(Table& table, const std::string& kind, const Relation_score& score)
{
  auto add = [&](const std::string& relation, const Pair_score& pairs) {
    table.add(relation + " pairs kept " + kind, pairs.share());
    table.add(relation + " pairs false " + kind, pairs.false_pairs);
  };
  add("parallel", score.parallel);
  add("orthogonal", score.orthogonal);
  add("coplanar", score.coplanar);
}

void add_truth(Table& table, const Truth_criteria& t)
{
  table.add("true faces", t.faces);
  table.add("point precision", t.point_precision);
  table.add("point recall", t.point_recall);
  table.add("points on no face", t.false_points);
  table.add("face precision at .5", t.at_50.precision);
  table.add("face recall at .5", t.at_50.recall);
  table.add("face F1 at .5", t.at_50.f1);
  table.add("face F1 at .75", t.at_75.f1);
  table.add("shapes per face found", t.shapes_per_face);
  table.add("faces swallowed", t.swallowed_faces);
  table.add("angle error in degrees", t.angle_error_deg);
  table.add("true parallel pairs found", t.exact.parallel.true_pairs);
  table.add("true orthogonal pairs found", t.exact.orthogonal.true_pairs);
  table.add("true coplanar pairs found", t.exact.coplanar.true_pairs);
  add_relations(table, "exact", t.exact);
  add_relations(table, "within 1e-6", t.relaxed);
}

void run(const Request& request)
{
  Ply_cloud cloud = read_ply(request.cloud);
  if(!request.normals.empty())
    cloud.normals = read_ply(request.normals).normals;
  if(cloud.has_normals() && cloud.normals.size() != cloud.points.size())
    throw std::runtime_error(request.normals + ": has another number of points");
  Detection detection{read_labels(request.labels), read_planes(request.planes)};
  Table table;
  table.add("cloud", request.name);
  Criteria criteria = evaluate(cloud.points, cloud.normals, detection, request.tolerances);
  add_criteria(table, criteria, request.tolerances);
  if(!request.truth.empty() || request.fits_truth)
    add_truth(table, evaluate_truth(make_truth(request, cloud), detection, extent_of(cloud.points), request.minimum));
  table.print(request.is_csv, request.has_header);
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
