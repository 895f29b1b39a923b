// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The inputs of a run.

#ifndef DETECT_PLANES_READ_INPUTS_H
#define DETECT_PLANES_READ_INPUTS_H

#include "check_options.h"
#include "input/read_cloud.h"
#include "output/report.h"
#include "ranks/Processes.h"

#include <CGAL/Real_timer.h>

namespace program {

// --- Each rank reads some of the inputs; what there is to say about them is said once.

// Prints them, unless they are empty.
inline void add_warnings(const std::vector<std::string>& warnings, bool is_first, Run& run)
{
  for(const std::string& warning : warnings) {
    if(warning.empty())
      continue;
    if(is_first)
      warn(warning);
    run.warnings.push_back(warning);
  }
}

// The first names of a list, and the number of the others.
inline std::string joined(const std::vector<std::string>& names, std::size_t most)
{
  std::string text;
  for(std::size_t i = 0; i < (std::min)(names.size(), most); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  return names.size() <= most ? text : text + " and " + std::to_string(names.size() - most) + " more";
}

// What there is to say about inputs, once for those of which it is the same.
inline void collect_notes(const Options& o, const Input_cloud& cloud, const Processes& processes, Run& run)
{
  std::vector<Placed_notes> own;
  for(const Input_part& part : cloud.parts)
    own.emplace_back(part.input, part.notes);
  std::vector<std::vector<std::string>> paths_of_note;
  for(const auto& [input, notes] : processes.gather(own)) {
    for(const auto& line : notes.lines) {
      const auto place = std::find(run.notes.begin(), run.notes.end(), line) - run.notes.begin();
      if(std::size_t(place) == run.notes.size()) {
        run.notes.push_back(line);
        paths_of_note.emplace_back();
      }
      paths_of_note[std::size_t(place)].push_back(o.inputs[input]);
    }
    add_warnings(notes.warnings, true, run);
  }
  for(std::size_t i = 0; i < run.notes.size() && o.inputs.size() > 1; ++i)
    run.notes[i].second += " (" + joined(paths_of_note[i], 4) + ")";
  const Attributes removed = ~processes.common_bits(~cloud.of_some) & ~processes.common_bits(cloud.of_all);
  if(removed != 0)
    run.notes.emplace_back("left out", names_of(removed) + ": not all inputs have them");
}

// Reads the inputs of this rank, and prints what may be wrong with those of all. Returns the ranks that read them.
inline std::vector<int> read_inputs(const Options& o, Processes& processes, Input_cloud& cloud, Run& run)
{
  std::vector<std::uint64_t> bytes;
  for(const std::string& path : o.inputs) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    bytes.push_back(processes.number_of(0, error ? 0 : size));
  }
  const std::vector<int> rank_of_input = share_files(bytes, processes.size());
  CGAL::Real_timer timer;
  timer.start();
  std::vector<std::size_t> own;
  for(std::size_t input = 0; input < o.inputs.size(); ++input)
    if(rank_of_input[input] == processes.rank())
      own.push_back(input);
  processes.together([&] { check_inputs(o.inputs, own, input_settings(o)); });
  processes.together([&] {
    const Progress_line progress(!o.is_quiet && processes.is_first(), "reading");
    read_clouds(o.inputs, own, input_settings(o), cloud);
  });
  run.read_seconds = processes.largest(timer.time());
  run.input = joined(o.inputs, o.inputs.size());
  run.short_input = joined(o.inputs, 8);
  run.planes_from = o.planes_from;
  collect_notes(o, cloud, processes, run);
  const bool is_any = processes.largest(double(cloud.points.size())) > 0;
  processes.together([&] {
    if(!is_any)
      throw std::runtime_error("none of the inputs has points");
    keep_attributes(processes.common_bits(cloud.of_all), cloud.points);
  });
  return rank_of_input;
}

// ---

// Points exactly at 0 0 0, which invalid pixels of depth cameras become, get no finite coordinates, so that nothing
// depends on them. Gives the own ones, and their number on all ranks.
inline std::vector<Point_set::Index> hide_zeros(Point_set& points, Processes& processes, std::size_t& number_of_all)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Point_set::Index> hidden;
  for(Point_set::Index i : points)
    if(is_zero(points.point(i)))
      hidden.push_back(i);
  const bool is_any = processes.largest(double(points.size() - hidden.size())) > 0;
  number_of_all = std::size_t(processes.sums({(long long)(hidden.size())})[0]);
  for(Point_set::Index i : hidden)
    points.point(i) = Kernel::Point_3(nan, nan, nan);
  processes.together([&] {
    if(!is_any)
      throw std::runtime_error("all points are at 0 0 0, which --ignore-zeros leaves out");
  });
  return hidden;
}

} // namespace program

#endif // DETECT_PLANES_READ_INPUTS_H
