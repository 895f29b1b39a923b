// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The inputs of a run.

#ifndef DETECT_PLANES_READ_INPUTS_H
#define DETECT_PLANES_READ_INPUTS_H

#include "../cloud_warnings.h"
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

// --- Points that stand for no measurement.

// The two smallest numbers of all ranks.
struct Least {
  double first = std::numeric_limits<double>::infinity(), second = first;

  void add(double x)
  {
    if(x < first)
      second = std::exchange(first, x);
    else if(x > first)
      second = (std::min)(second, x);
  }
};

// The smallest coordinates, and the smallest of them with the other sign.
using Sides = std::array<Least, 6>;

inline Sides sides_of(const Point_set& points, const Processes& processes)
{
  Sides sides;
  for(Point_set::Index i : points)
    for(int c = 0; c < 6 && is_finite(points.point(i)); ++c)
      sides[std::size_t(c)].add((c < 3 ? 1 : -1) * points.point(i)[c % 3]);
  for(Least& side : sides) {
    const double own = side.first, all = -processes.largest(-own);
    side.second = -processes.largest(-(own == all ? side.second : own));
    side.first = all;
  }
  return sides;
}

// A number that is usual for no value, and twice as far from all other coordinates as these are from each other.
inline bool is_no_value(const Sides& sides, std::size_t side)
{
  double extents[3]; // without the first numbers
  for(std::size_t c = 0; c < 3; ++c)
    extents[c] = (std::max)(0., -sides[c + 3].second - sides[c].second);
  const double all = *std::max_element(extents, extents + 3), own = extents[side % 3];
  const double gap = sides[side].second - sides[side].first;
  return std::isfinite(gap) && all > 0 && is_usual_for_none(sides[side].first) && gap > 2 * (own > 0 ? own : all);
}

// Gives points that stand for no measurement no finite coordinates, so that nothing depends on them: those exactly at
// 0 0 0, if there are more than measurements explain or the option says so, and those with a number for no value. show()
// gives them back what they had.
class Hidden_points {
public:
  Hidden_points(const Options& o, Point_set& points, Processes& processes, Run& run) : points(points)
  {
    const tandem_examples::Cloud_box box = tandem_examples::box_of(points.points(), processes);
    std::vector<std::string> warnings;
    if(o.ignores_zeros || are_zeros_strange(box)) {
      run.zeros = hide(processes, [](const Kernel::Point_3& p) { return is_zero(p); });
      if(!o.ignores_zeros)
        warnings.push_back(sentence(run.zeros, " points are exactly at 0 0 0, like invalid pixels: they are left out"));
    }
    for(std::size_t side = 0; side < 6;) {
      const Sides sides = sides_of(points, processes);
      while(side < 6 && !is_no_value(sides, side))
        ++side;
      if(side == 6)
        break;
      const int axis = int(side % 3);
      const double value = (side < 3 ? 1 : -1) * sides[side].first;
      const std::size_t count = hide(processes, [=](const Kernel::Point_3& p) { return p[axis] == value; });
      run.no_values += count;
      warnings.push_back(text_of(std::setprecision(10), "points with ", "xyz"[axis], ' ', value,
                                 ", far from all others, like no measurement, are left out: ", count));
      side = 0; // there may be others behind it
    }
    add_warnings(warnings, processes.is_first(), run);
    const bool is_any = processes.largest(double(points.size() - hidden.size())) > 0;
    processes.together([&] {
      if(!is_any)
        throw std::runtime_error("all points are at 0 0 0, or have coordinates that stand for no value");
    });
  }

  void show()
  {
    if(hidden.empty())
      return;
    const auto has_none = points.add_property_map<bool>(no_value_name, false).first;
    for(const auto& [i, point] : hidden) {
      points.point(i) = point;
      has_none[i] = true;
    }
  }

private:
  // Their number on all ranks.
  template <class Is_none>
  std::size_t hide(const Processes& processes, const Is_none& is_none)
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const std::size_t before = hidden.size();
    for(Point_set::Index i : points)
      if(Kernel::Point_3& p = points.point(i); is_none(p)) {
        hidden.emplace_back(i, p);
        p = Kernel::Point_3(nan, nan, nan);
      }
    return std::size_t(processes.sums({(long long)(hidden.size() - before)})[0]);
  }

  Point_set& points;
  std::vector<std::pair<Point_set::Index, Kernel::Point_3>> hidden;
};

} // namespace program

#endif // DETECT_PLANES_READ_INPUTS_H
