// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run did, as JSON.

#ifndef DETECT_PLANES_REPORT_H
#define DETECT_PLANES_REPORT_H

#include "output/json_number.h"
#include "output/write_results.h"
#include "visible_text.h"

#ifdef __unix__
#include <sys/resource.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace program {

struct Run {
  std::string input, short_input;                         // the names of all inputs, and of some
  std::vector<std::pair<std::string, std::string>> notes; // of the reading: a word, and what there is to say
  std::vector<std::string> warnings;                      // of the reading, and of the result
  std::string normals;                                    // "given", "estimated" or how else
  std::string device = "CPU";
  std::string mesh; // what there is to say about it
  int threads = 1, ranks = 1;
  std::uint64_t hash = 0;
  std::size_t peak_bytes = 0; // the largest of a process, before the writing
  double read_seconds = 0;
  double normal_seconds = 0; // of normals estimated outside of the library
};

inline std::size_t peak_process_bytes()
{
#ifdef __unix__
  rusage usage;
  if(getrusage(RUSAGE_SELF, &usage) == 0)
    return std::size_t(usage.ru_maxrss) * 1024;
#endif
  return 0;
}

// Writes the members of JSON objects in the order of the calls.
class Json_writer {
public:
  explicit Json_writer(std::ostream& out) : out(out) { out << '{'; }

  void begin(const char* name)
  {
    key(name);
    out << '{';
    is_first = true;
    ++depth;
  }
  void end()
  {
    --depth;
    out << '\n' << std::string(2 * depth, ' ') << '}';
    is_first = false;
    if(depth == 0)
      out << '\n';
  }
  void number(const char* name, double value)
  {
    key(name);
    out << json_number(value);
  }
  void count(const char* name, std::size_t value) { key(name), out << value; }
  void boolean(const char* name, bool value) { key(name), out << (value ? "true" : "false"); }
  void text(const char* name, const std::string& value) { key(name), out << quoted(value); }

  void texts(const char* name, const std::vector<std::string>& values)
  {
    key(name);
    write(values, [&](const std::string& value) { out << quoted(value); });
  }

  template <class Numbers>
  void numbers(const char* name, const Numbers& numbers)
  {
    key(name);
    write_numbers(numbers);
  }

  template <class Rows>
  void rows(const char* name, const Rows& rows)
  {
    key(name);
    write(rows, [&](const auto& row) { write_numbers(row); });
  }

private:
  template <class Numbers>
  void write_numbers(const Numbers& numbers)
  {
    write(numbers, [&](auto x) { out << json_number(double(x)); });
  }

  template <class List, class Write_item>
  void write(const List& list, Write_item write_item)
  {
    out << '[';
    const char* before = "";
    for(const auto& item : list) {
      out << before;
      write_item(item);
      before = ", ";
    }
    out << ']';
  }

  void key(const char* name)
  {
    out << (is_first ? "\n" : ",\n") << std::string(2 * depth, ' ') << '"' << name << "\": ";
    is_first = false;
  }

  // The name of a file need not be UTF-8: other bytes are escaped one by one. So is '<': it may be on a page.
  static std::string quoted(const std::string& s)
  {
    std::string result = "\"";
    for(std::string_view rest = s; !rest.empty();) {
      const std::size_t n = (std::max)(utf8_length(rest), std::size_t(1));
      const unsigned char last = (unsigned char)(rest[n - 1]); // of a control character, it is the code
      char code[8];
      if(utf8_length(rest) == 0 || begins_with_control(rest) || last == '<')
        std::snprintf(code, sizeof code, "\\u%04x", unsigned(last)), result += code;
      else
        (result += last == '"' || last == '\\' ? "\\" : "") += rest.substr(0, n);
      rest.remove_prefix(n);
    }
    return result + '"';
  }

  std::ostream& out;
  std::size_t depth = 1;
  bool is_first = true;
};

inline std::vector<std::vector<std::size_t>> members_of_groups(const Shapes& shapes, bool is_parallel)
{
  std::vector<std::vector<std::size_t>> groups(is_parallel ? shapes.number_of_parallel_groups()
                                                           : shapes.number_of_coplanar_groups());
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    groups[is_parallel ? shapes.parallel_group(s) : shapes.coplanar_group(s)].push_back(s);
  return groups;
}

inline void write_parameters(Json_writer& json, const CGAL::Tandem::Parameters& p)
{
  json.begin("parameters");
  json.number("maximum_distance", p.maximum_distance);
  json.number("maximum_angle", p.maximum_angle);
  json.number("angle_tolerance", p.angle_tolerance);
  json.number("maximum_offset", p.maximum_offset);
  json.count("minimum_region_size", p.minimum_region_size);
  json.count("k_neighbors", p.k_neighbors);
  json.count("cell_size", p.cell_size);
  json.boolean("regularize_parallelism", p.regularize_parallelism);
  json.boolean("regularize_orthogonality", p.regularize_orthogonality);
  json.boolean("regularize_coplanarity", p.regularize_coplanarity);
  json.rows("fixed_directions", p.fixed_directions);
  json.boolean("regularize_axis_symmetry", p.regularize_axis_symmetry);
  if(p.regularize_axis_symmetry)
    json.numbers("symmetry_direction", p.symmetry_direction);
  json.end();
}

inline void write_numbers(Json_writer& json, const CGAL::Tandem::Statistics& s, const Run& run)
{
  json.begin("counts");
  json.count("points", s.number_of_points);
  json.count("ignored", s.number_of_ignored_points());
  json.count("ignored_coordinates", s.number_of_ignored_coordinates);
  json.count("ignored_normals", s.number_of_ignored_normals);
  json.count("assigned", s.number_of_assigned_points);
  json.count("shapes", s.number_of_shapes);
  json.count("directions", s.number_of_directions);
  json.count("planes", s.number_of_planes);
  json.count("orthogonal_pairs", s.number_of_orthogonal_pairs);
  json.count("rounds", s.number_of_rounds);
  json.end();
  json.begin("criteria");
  json.number("coverage", s.coverage);
  json.number("mean_distance", s.mean_distance);
  json.count("degrees_of_freedom", s.degrees_of_freedom);
  json.number("complexity", s.complexity);
  json.end();
  json.begin("score");
  json.number("fit", s.score.fit);
  json.number("links", s.score.links);
  json.number("size", s.score.size);
  json.number("price", s.score.price);
  json.number("freedom", s.score.freedom);
  json.number("total", s.score.total());
  json.end();
  json.begin("seconds");
  json.number("read", run.read_seconds);
  json.number("normals", s.times.normals + run.normal_seconds);
  json.number("sort", s.times.sort);
  json.number("neighbors", s.times.neighbors);
  json.number("growth", s.times.growth);
  json.number("regularity", s.times.regularity);
  json.number("final", s.times.finish);
  json.number("total", s.times.total + run.normal_seconds);
  json.end();
  json.begin("memory");
  json.count("engine_peak_bytes", s.peak_bytes);
  json.count("process_peak_bytes", (std::max)(run.peak_bytes, peak_process_bytes()));
  json.end();
}

inline std::string hash_text(const Run& run)
{
  std::ostringstream text;
  text << std::hex << std::setw(16) << std::setfill('0') << run.hash;
  return text.str();
}

inline void write_report(std::ostream& out, const Shapes& shapes, const Run& run)
{
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  Json_writer json(out);
  json.text("input", run.input);
  json.text("normals", run.normals);
  json.text("backend", s.backend);
  json.text("device", run.device);
  json.count("threads", std::size_t(run.threads));
  json.count("processes", std::size_t(run.ranks));
  json.text("hash", hash_text(run));
  json.number("grid_step", s.grid_step);
  json.boolean("is_grid_coarse", s.is_grid_coarse);
  json.texts("warnings", run.warnings);
  write_parameters(json, shapes.parameters());
  write_numbers(json, s, run);
  json.begin("relations");
  json.rows("parallel_groups", members_of_groups(shapes, true));
  std::vector<std::array<std::size_t, 2>> pairs;
  for(const auto& pair : shapes.orthogonal_groups())
    pairs.push_back({std::size_t(pair.first), std::size_t(pair.second)});
  json.rows("orthogonal_pairs", pairs);
  json.rows("coplanar_groups", members_of_groups(shapes, false));
  json.numbers("fixed_direction_of_parallel_groups", shapes.data().fixed_direction);
  json.numbers("symmetry_group_of_parallel_groups", shapes.data().symmetry_group);
  json.end();
  json.end();
}

} // namespace program

#endif // DETECT_PLANES_REPORT_H
