// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a run did: the table for people and the JSON for programs.

#ifndef DETECT_PLANES_REPORT_H
#define DETECT_PLANES_REPORT_H

#include "output/json_number.h"
#include "output/write_results.h"

#ifdef __unix__
#include <sys/resource.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <utility>
#include <vector>

namespace program {

struct Run {
  std::string input, short_input;                         // the names of all inputs, and of some
  std::vector<std::pair<std::string, std::string>> notes; // of the reading: a word, and what there is to say
  std::string normals;                                    // "given", "estimated" or how else
  std::string device = "CPU";
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

  // Bytes outside of ASCII are escaped one by one: a file name need not be UTF-8. So is '<': it may be on a page.
  static std::string quoted(const std::string& s)
  {
    std::string result = "\"";
    for(unsigned char c : s) {
      char code[8];
      if(c == '"' || c == '\\')
        result += {'\\', char(c)};
      else if(c < 32 || c > 126 || c == '<')
        std::snprintf(code, sizeof code, "\\u%04x", unsigned(c)), result += code;
      else
        result += char(c);
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

inline void print_summary(std::ostream& out, const Shapes& shapes, const Run& run)
{
  const CGAL::Tandem::Statistics& s = shapes.statistics();
  const CGAL::Tandem::Parameters& p = shapes.parameters();
  const auto row = [&out](const char* name) -> std::ostream& {
    return out << "  " << std::left << std::setw(12) << name;
  };
  out << run.short_input << '\n' << std::setprecision(4);
  row("points") << s.number_of_points << ", normals " << run.normals;
  if(s.number_of_ignored_points() > 0)
    out << "; ignored: " << s.number_of_ignored_coordinates << " not finite, " << s.number_of_ignored_normals
        << " without a normal";
  out << '\n';
  for(const auto& [word, text] : run.notes)
    row(word.c_str()) << text << '\n';
  row("parameters") << "maximum distance " << p.maximum_distance << ", angle " << p.maximum_angle
                    << ", angle tolerance " << p.angle_tolerance << ", offset " << p.maximum_offset << ", at least "
                    << p.minimum_region_size << " points\n";
  row("shapes") << s.number_of_shapes << " in " << s.number_of_planes << " planes of " << s.number_of_directions
                << " directions, " << s.number_of_orthogonal_pairs << " orthogonal pairs of directions\n";
  row("quality") << "coverage " << 100 * s.coverage << " %, mean distance " << s.mean_distance << ", complexity "
                 << s.complexity << '\n';
  row("seconds") << s.times.total + run.normal_seconds << " (normals " << s.times.normals + run.normal_seconds
                 << ", sort " << s.times.sort << ", neighbors " << s.times.neighbors << ", growth " << s.times.growth
                 << ", regularity " << s.times.regularity << ", final " << s.times.finish << "), reading "
                 << run.read_seconds << '\n';
  row("execution") << s.backend << ", " << (run.ranks == 1 ? "" : std::to_string(run.ranks) + " processes of ")
                   << run.threads << (run.threads == 1 ? " thread, " : " threads, ") << s.number_of_rounds
                   << " rounds, " << (std::max)(run.peak_bytes, peak_process_bytes()) / 1048576 << " MiB\n";
  row("hash") << hash_text(run) << '\n';
}

} // namespace program

#endif // DETECT_PLANES_REPORT_H
