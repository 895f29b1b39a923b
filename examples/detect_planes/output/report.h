// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run did: as JSON, and as a table for people.

#ifndef DETECT_PLANES_REPORT_H
#define DETECT_PLANES_REPORT_H

#include "../cloud_warnings.h"
#include "messages.h"
#include "output/write_results.h"

#include <CGAL/Shape_regularization_tandem/upward_direction.h>
#include <CGAL/Tandem/Statistics.h>

#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <vector>

namespace program {

using tandem_examples::Free_reason;

// The ratios of all points, and what to change. Of many free points, which nobody expects, all frequent reasons are
// told.
inline std::string free_text(const CGAL::Tandem::Statistics& s, const tandem_examples::Free_origin& origin)
{
  std::ostringstream text;
  text << std::setprecision(3);
  const auto percent = [&](std::size_t points) { return tandem_examples::percent(s, points); };
  const std::vector<Free_reason> reasons = tandem_examples::free_reasons(s, origin);
  if(reasons.empty())
    return "none";
  text << percent(s.free_points.total()) << " %: ";
  for(const Free_reason& r : reasons)
    text << (&r == reasons.data() ? "" : ", ") << percent(r.points) << " % " << r.name;
  const bool are_many = percent(s.free_points.total()) > 35;
  for(const Free_reason& r : reasons)
    if(&r == reasons.data() || (are_many && percent(r.points) > 10))
      text << (are_many ? "\n              " : "; ") << r.name << ": " << r.advice;
  return text.str();
}

// What there is to say about the tolerances of a run.
struct Tolerance_facts {
  std::string source = "given"; // or "estimated", "auto-local", "column NAME" or "noise SUM"
  bool is_of_each_point = false;
  std::string note; // where one estimated tolerance is a compromise: why
  // Of the points with finite coordinates and a positive tolerance; 0 if there are none.
  double smallest = 0, mean = 0, largest = 0;
};

// --- What a run did, as JSON.

struct Run {
  std::string input, short_input;                         // the names of all inputs, and of some
  std::vector<std::pair<std::string, std::string>> notes; // of the reading: a word, and what there is to say
  std::vector<std::string> warnings;                      // of the reading, and of the result
  std::string normals;                                    // "given", "estimated" or how else
  std::string device;                                     // "CPU", or what is known of it
  Tolerance_facts tolerance;
  bool has_outward_sides = false; // planes: normals are given, or the viewpoint is
  CGAL::Tandem::Upward_direction up;
  std::string up_source = "given"; // or "found" or "assumed"
  double up_seconds = 0;           // of the detection that found it, where there was another one
  std::size_t zeros = 0;           // points at 0 0 0 that are left out
  std::size_t no_values = 0;       // other points that are left out, as a coordinate stands for no value
  std::string mesh;                // what there is to say about it
  std::string files;               // that were written
  std::string planes_from;         // the file of known planes, or nothing
  std::string selection;           // of shapes: the options, or nothing; and what there was before
  std::size_t detected_shapes = 0, detected_points = 0;
  std::size_t veils = 0, veil_points = 0; // shapes that became free, before the selection
  int threads = 1, processes = 1;
  std::uint64_t hash = 0;
  std::size_t peak_bytes = 0; // the largest of a process, before the writing
  double read_seconds = 0;
  double normal_seconds = 0; // of normals estimated outside of the library
};

inline std::size_t peak_process_bytes()
{
  rusage usage;
  return getrusage(RUSAGE_SELF, &usage) == 0 ? std::size_t(usage.ru_maxrss) * 1024 : 0;
}

using Json = nlohmann::ordered_json; // doubles are written so that they are read as they were, or as null if not finite

// Names of files need not be UTF-8, as the texts of JSON are: other bytes become the characters of their codes.
inline std::string utf8(const std::string& text)
{
  std::string result;
  for(std::string_view rest = text; !rest.empty();) {
    const std::size_t n = utf8_length(rest);
    const unsigned char byte = (unsigned char)(rest[0]);
    if(n > 0)
      result += rest.substr(0, n);
    else
      (result += char(0xc0 | byte >> 6)) += char(0x80 | (byte & 0x3f));
    rest.remove_prefix((std::max)(n, std::size_t(1)));
  }
  return result;
}

// In ASCII, so that no text controls a terminal.
inline std::string ascii(const Json& json) { return json.dump(-1, ' ', true); }

// A line for each member.
inline void write_json(std::ostream& out, const Json& object, const std::string& indent = "")
{
  const char* before = "{\n";
  for(const auto& [name, value] : object.items()) {
    out << before << indent << "  \"" << name << "\": ";
    if(value.is_object())
      write_json(out, value, indent + "  ");
    else
      out << ascii(value);
    before = ",\n";
  }
  out << '\n' << indent << '}';
}

using Group_of_shape = std::size_t (Shapes::*)(std::size_t) const;

inline std::vector<std::vector<std::size_t>> members_of_groups(const Shapes& shapes, Group_of_shape group)
{
  std::vector<std::vector<std::size_t>> groups;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s) {
    const std::size_t g = (shapes.*group)(s);
    groups.resize((std::max)(groups.size(), g + 1));
    groups[g].push_back(s);
  }
  return groups;
}

inline Json json_of(const CGAL::Tandem::Parameters& p)
{
  Json json = {{"maximum_distance", p.maximum_distance},
               {"maximum_angle", p.maximum_angle},
               {"angle_tolerance", p.angle_tolerance},
               {"maximum_offset", p.maximum_offset},
               {"minimum_region_size", p.minimum_region_size},
               {"simplicity", p.simplicity},
               {"regularity", p.regularity},
               {"fixed_regularity", p.fixed_regularity},
               {"surfel_size", p.surfel_size},
               {"k_neighbors", p.k_neighbors},
               {"cell_size", p.cell_size},
               {"regularize_parallelism", p.regularize_parallelism},
               {"regularize_orthogonality", p.regularize_orthogonality},
               {"regularize_coplanarity", p.regularize_coplanarity},
               {"fixed_directions", p.fixed_directions},
               {"regularize_axis_symmetry", p.regularize_axis_symmetry}};
  if(p.regularize_axis_symmetry)
    json["symmetry_direction"] = p.symmetry_direction;
  return json;
}

// Those that are left out as they stand for no measurement are counted by themselves.
inline std::size_t not_finite_points(const CGAL::Tandem::Statistics& s, const Run& run)
{
  return s.number_of_ignored_coordinates - run.zeros - run.no_values;
}

inline void add_figures(const CGAL::Tandem::Statistics& s, const Run& run, Json& json)
{
  json["counts"] = {{"points", s.number_of_points},
                    {"ignored", s.number_of_ignored_points()},
                    {"ignored_coordinates", not_finite_points(s, run)},
                    {"ignored_zeros", run.zeros},
                    {"ignored_no_values", run.no_values},
                    {"ignored_normals", s.number_of_ignored_normals},
                    {"ignored_tolerances", s.number_of_ignored_tolerances},
                    {"far", s.number_of_far_points},
                    {"assigned", s.number_of_assigned_points},
                    {"shapes", s.number_of_shapes},
                    {"directions", s.number_of_directions},
                    {"planes", s.number_of_planes},
                    {"orthogonal_pairs", s.number_of_orthogonal_pairs},
                    {"rounds", s.number_of_rounds}};
  json["free"] = {{"without_normal", s.free_points.without_normal},
                  {"misaligned", s.free_points.misaligned},
                  {"misfit", s.free_points.misfit},
                  {"without_neighbors", s.free_points.without_neighbors},
                  {"in_small_regions", s.free_points.in_small_regions},
                  {"clutter", s.free_points.clutter},
                  {"unselected", s.free_points.unselected},
                  {"total", s.free_points.total()}};
  json["criteria"] = {{"coverage", s.coverage},
                      {"mean_distance", s.mean_distance},
                      {"degrees_of_freedom", s.degrees_of_freedom},
                      {"complexity", s.complexity}};
  json["score"] = {{"fit", s.score.fit},     {"links", s.score.links},     {"size", s.score.size},
                   {"price", s.score.price}, {"freedom", s.score.freedom}, {"total", s.score.total()}};
  json["seconds"] = {{"read", run.read_seconds}, {"normals", s.times.normals + run.normal_seconds},
                     {"sort", s.times.sort},     {"neighbors", s.times.neighbors},
                     {"growth", s.times.growth}, {"regularity", s.times.regularity},
                     {"final", s.times.finish},  {"total", s.times.total + run.normal_seconds}};
  json["memory"] = {{"engine_peak_bytes", s.peak_bytes},
                    {"process_peak_bytes", (std::max)(run.peak_bytes, peak_process_bytes())}};
}

// A list for each member, by shape.
inline Json uncertainties(const Shapes& shapes)
{
  using Uncertainty = CGAL::Tandem::Plane_uncertainty;
  const auto list = [&](auto member) {
    Json json = Json::array();
    for(const Uncertainty& u : shapes.data().uncertainty)
      json.push_back(u.*member);
    return json;
  };
  return {{"centroid", list(&Uncertainty::centroid)},
          {"noise", list(&Uncertainty::noise)},
          {"normal_covariance", list(&Uncertainty::normal_covariance)},
          {"offset_deviation", list(&Uncertainty::offset_deviation)},
          {"angle_deg", list(&Uncertainty::angle_deg)}};
}

inline std::string hash_text(const Run& run) { return text_of(std::hex, std::setw(16), std::setfill('0'), run.hash); }

// surface: of Described_shapes
inline void write_report(std::ostream& out, const Shapes& shapes, const Run& run, const Json& surface)
{
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  Json json = {{"input", utf8(run.input)},       {"normals", run.normals},   {"backend", s.backend},
               {"device", run.device},           {"threads", run.threads},   {"processes", run.processes},
               {"hash", hash_text(run)},         {"grid_step", s.grid_step}, {"is_grid_coarse", s.is_grid_coarse},
               {"line_spacing", s.line_spacing}, {"notes", Json::array()},   {"warnings", Json::array()}};
  for(const auto& [word, text] : run.notes)
    json["notes"].push_back(utf8(word + ' ' + text));
  for(const std::string& warning : run.warnings)
    json["warnings"].push_back(utf8(warning));
  json["parameters"] = json_of(shapes.parameters());
  json["tolerance"] = {{"source", utf8(run.tolerance.source)},
                       {"is_of_each_point", run.tolerance.is_of_each_point},
                       {"minimum", run.tolerance.smallest},
                       {"maximum", run.tolerance.largest},
                       {"note", run.tolerance.note}};
  json["up"] = {{"direction", run.up.direction}, {"source", run.up_source}, {"seconds", run.up_seconds}};
  json["planes_from"] = run.planes_from.empty() ? Json() : Json(utf8(run.planes_from));
  json["veils"] = {{"shapes", run.veils}, {"points", run.veil_points}};
  json["selection"] = nullptr; // the outputs have all shapes that were detected
  if(!run.selection.empty())
    json["selection"] = {{"options", utf8(run.selection)},
                         {"shapes", s.number_of_shapes},
                         {"points", s.number_of_assigned_points},
                         {"detected_shapes", run.detected_shapes},
                         {"detected_points", run.detected_points}};
  add_figures(s, run, json);
  json["surface"] = surface;
  json["relations"] = {{"parallel_groups", members_of_groups(shapes, &Shapes::parallel_group)},
                       {"orthogonal_pairs", shapes.orthogonal_groups()},
                       {"coplanar_groups", members_of_groups(shapes, &Shapes::coplanar_group)},
                       {"fixed_direction_of_parallel_groups", shapes.data().fixed_direction},
                       {"symmetry_group_of_parallel_groups", shapes.data().symmetry_group}};
  json["uncertainty"] = uncertainties(shapes);
  write_json(out, json);
  out << '\n';
}

// --- What a run did, as a table for people.

// The points that cannot be in shapes.
inline void write_left_out(std::ostream& out, const CGAL::Tandem::Statistics& s, const Run& run)
{
  const std::pair<std::size_t, const char*> causes[] = {{not_finite_points(s, run), "not finite"},
                                                        {run.zeros, "at 0 0 0"},
                                                        {run.no_values, "without a value"},
                                                        {s.number_of_ignored_normals, "without a normal"},
                                                        {s.number_of_ignored_tolerances, "without a tolerance"},
                                                        {s.number_of_far_points, "too far away"}};
  const char* before = "; ignored: ";
  for(const auto& [count, cause] : causes) {
    if(count > 0)
      out << std::exchange(before, ", ") << count << ' ' << cause;
  }
}

inline std::string up_text(const Run& run)
{
  const auto& [x, y, z] = run.up.direction;
  const auto percent = [](double fraction) { return std::lround(100 * fraction); };
  const std::string facts = text_of(": of the points in shapes, ", percent(run.up.level), " % are level and ",
                                    percent(run.up.upright), " % upright");
  return text_of(std::setprecision(4), x, ' ', y, ' ', z, ", ", run.up_source, run.up_source == "given" ? "" : facts,
                 run.up_source == "assumed" ? " (--up X,Y,Z gives another one)" : "",
                 run.up_seconds > 0 ? text_of(std::setprecision(3), ", by detections of ", run.up_seconds, " seconds")
                                    : "");
}

inline std::string summary(const Shapes& shapes, const Run& run)
{
  std::ostringstream out;
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  const CGAL::Tandem::Parameters& p = shapes.parameters();
  const auto row = [&out](const char* name) -> std::ostream& {
    return out << "  " << std::left << std::setw(12) << name;
  };
  out << Visible{run.short_input} << '\n' << std::setprecision(4);
  row("points") << s.number_of_points << ", normals " << run.normals;
  write_left_out(out, s, run);
  out << '\n';
  for(const auto& [word, text] : run.notes)
    row(word.c_str()) << Visible{text} << '\n';
  row("parameters") << "maximum distance " << p.maximum_distance
                    << (run.tolerance.source == "estimated" ? " (estimated)" : "") << ", angle " << p.maximum_angle;
  if(run.planes_from.empty())
    out << ", angle tolerance " << p.angle_tolerance << ", offset " << p.maximum_offset << ", at least "
        << p.minimum_region_size << " points";
  out << '\n';
  if(s.line_spacing > 0)
    row("scan lines") << "about " << text_of(std::setprecision(2), s.line_spacing) << " apart\n";
  if(!run.tolerance.note.empty())
    row("estimate") << run.tolerance.note << '\n';
  if(run.tolerance.is_of_each_point)
    row("tolerances") << run.tolerance.smallest << " to " << run.tolerance.largest << ", by "
                      << Visible{run.tolerance.source} << '\n';
  if(!run.planes_from.empty())
    row("known") << "planes of " << Visible{run.planes_from}
                 << ", not detected: points are within the tolerances, but shapes need not be connected\n";
  if(run.veils > 0)
    row("veils") << run.veils << (run.veils == 1 ? " shape" : " shapes")
                 << " edge-on to the sensor, in fewer than three rows of rays: " << run.veil_points
                 << " points are free\n";
  if(!run.selection.empty())
    row("selection") << s.number_of_shapes << " of " << run.detected_shapes << " shapes, with "
                     << s.number_of_assigned_points << " of " << run.detected_points << " points ("
                     << Visible{run.selection} << ")\n";
  row("shapes") << s.number_of_shapes << " in " << s.number_of_planes << " planes of " << s.number_of_directions
                << " directions, " << s.number_of_orthogonal_pairs << " orthogonal pairs of directions\n";
  row("up") << up_text(run) << '\n';
  row("quality") << "coverage " << 100 * s.coverage << " %, mean distance " << s.mean_distance << ", complexity "
                 << s.complexity << '\n';
  if(run.planes_from.empty())
    row("free") << free_text(s, {run.normals == "given", run.veil_points}) << '\n';
  row("seconds") << s.times.total + run.normal_seconds << " (normals " << s.times.normals + run.normal_seconds
                 << ", sort " << s.times.sort << ", neighbors " << s.times.neighbors << ", growth " << s.times.growth
                 << ", regularity " << s.times.regularity << ", final " << s.times.finish << "), reading "
                 << run.read_seconds << '\n';
  row("execution") << s.backend << ", " << (run.processes == 1 ? "" : std::to_string(run.processes) + " processes of ")
                   << run.threads << (run.threads == 1 ? " thread, " : " threads, ") << s.number_of_rounds
                   << " rounds, " << (std::max)(run.peak_bytes, peak_process_bytes()) / 1048576 << " MiB\n";
  if(!run.mesh.empty())
    row("mesh") << run.mesh << '\n';
  if(!run.files.empty())
    row("files") << Visible{run.files} << '\n';
  row("hash") << hash_text(run) << '\n';
  return out.str();
}

} // namespace program

#endif // DETECT_PLANES_REPORT_H
