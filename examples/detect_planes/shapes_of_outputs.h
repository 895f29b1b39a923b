// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes that the outputs have: those that fit the options of the selection, with their outward sides.

#ifndef DETECT_PLANES_SHAPES_OF_OUTPUTS_H
#define DETECT_PLANES_SHAPES_OF_OUTPUTS_H

#include "input/read_cloud.h"
#include "output/writers.h"
#include "ranks/Ranks.h"
#include "tolerance/Tolerances.h"

namespace program {

// --- The selection: all shapes, or one for each plane, and of those the ones that fit its options.

// The options that say which shapes the outputs have.
inline std::string selection_of(const Options& o)
{
  std::ostringstream text;
  const auto add = [&text](const char* option, const auto& value) {
    if(value)
      write_shortest(text << option << ' ', *value, ' ');
  };
  text << (o.is_by_plane ? "--by-plane " : "");
  add("--largest", o.largest);
  add("--minimum-area", o.minimum_area);
  add("--minimum-extent", o.minimum_extent);
  if(o.near_direction)
    text << "--near-direction " << o.near_direction->text << ' ';
  return text.str().substr(0, (std::max)(text.str().size(), std::size_t(1)) - 1);
}

// Notes in the run how many there were; a warning where none is left.
inline void select(const Point_set& points, const Options& o, Run& run, Shapes& shapes,
                   std::vector<std::string>& warnings)
{
  run.selection = selection_of(o);
  if(run.selection.empty())
    return;
  run.detected_shapes = shapes.number_of_shapes();
  run.detected_points = shapes.statistics().number_of_assigned_points;
  if(o.is_by_plane)
    shapes = joined_shapes(points, shapes);
  shapes = selected_shapes(shapes, points, o);
  if(shapes.number_of_shapes() == 0 && run.detected_shapes > 0)
    warnings.push_back(
      sentence("none of the ", run.detected_shapes, " shapes fits ", run.selection, ": the outputs have none"));
}

// --- The outward sides of planes and of estimated normals. Given normals have a side; estimated ones get that of the place
// from which their points were seen.

// All ranks call the same members in the same order.
class Outward_sides {
public:
  // After the normals were prepared. That given ones have no viewpoint is said before the detection, which may take long.
  Outward_sides(const Options& o, Input_cloud& cloud, Ranks& ranks, Run& run)
    : options(o), points(cloud.points), ranks(ranks), are_given(run.normals == "given")
  {
    ranks.together([&] {
      if(are_given && o.viewpoint && !o.noise)
        throw std::runtime_error("--viewpoint is for estimated normals, but the input has normals (with "
                                 "--estimate-normals they are estimated)");
    });
    for(const Input_part& part : cloud.parts)
      if(const auto viewpoint = viewpoint_of(o, part, o.is_oriented); viewpoint && !are_given)
        views.push_back({part.first, part.last, *viewpoint});
    is_seen = ranks.largest(double(views.size())) > 0;
    if(is_seen && run.normals != "none")
      run.normals += ", towards the viewpoint";
  }

  // What there is to say of --oriented, or nothing.
  const char* warning() const
  {
    return options.is_oriented && !are_given && !is_seen ? "--oriented: no normals are given, and no viewpoint is "
                                                           "known: planes have no outward side (--viewpoint gives one)"
                                                         : "";
  }

  // The shapes that the files get; the cloud gets the normals, if some file has them. The detection knows nothing of
  // sides, so its shapes, their hash and the mesh stay as they are.
  const Shapes& operator()(const Shapes& shapes)
  {
    const bool has_oriented_planes = options.is_oriented && (are_given || is_seen);
    if(!is_seen && !has_oriented_planes)
      return shapes;
    std::vector<long long> votes;
    ranks.together([&] { votes = votes_of(shapes); });
    votes = ranks.sums(votes);
    ranks.together([&] {
      Shapes::Data data = shapes.data();
      data.points = shapes.point_groups();
      for(std::size_t s = 0; s < votes.size() && is_seen; ++s)
        data.is_flipped[s] = votes[s] < 0;
      if(has_oriented_planes)
        turn_planes(data);
      turned.emplace(std::move(data));
      if(is_seen)
        turn_normals(shapes);
    });
    return *turned;
  }

private:
  struct View {
    std::size_t first, last; // the points
    Kernel::Point_3 from;
  };

  // How many more of the own points of each shape were seen from the side of its normal than from the other one. The
  // normal of the plane tells that better than those of the points, where they were seen at a small angle.
  std::vector<long long> votes_of(const Shapes& shapes) const
  {
    std::vector<long long> votes(shapes.number_of_shapes(), 0);
    for(const View& view : views)
      for(Point_set::Index i : Point_part(points, view.first, view.last))
        if(const int s = shapes.shape_index(i); s >= 0) {
          const auto& c = shapes.coefficients(std::size_t(s));
          const double height = Kernel::Vector_3(c[0], c[1], c[2]) * (view.from - points.point(i));
          votes[std::size_t(s)] += height > 0 ? 1 : height < 0 ? -1 : 0;
        }
    return votes;
  }

  static void turn_planes(Shapes::Data& data)
  {
    for(std::size_t s = 0; s < data.coefficients.size(); ++s)
      if(std::exchange(data.is_flipped[s], char(0)) != 0)
        for(double& x : data.coefficients[s])
          x = 0. - x; // no -0
  }

  void turn_normals(const Shapes& shapes)
  {
    if(options.output.empty() && options.output_directory.empty() && options.vg.empty())
      return;
    if(!points.has_normal_map() && !shapes.has_estimated_normals())
      return;
    if(!points.has_normal_map()) {
      points.add_normal_map();
      for(Point_set::Index i : points)
        points.normal(i) = shapes.estimated_normal(i);
    }
    for(const View& view : views)
      for(Point_set::Index i : Point_part(points, view.first, view.last))
        if(Kernel::Vector_3& n = points.normal(i); n * (view.from - points.point(i)) < 0)
          n = Kernel::Vector_3(0. - n.x(), 0. - n.y(), 0. - n.z());
  }

  const Options& options;
  Point_set& points;
  Ranks& ranks;
  bool are_given;          // the normals
  std::vector<View> views; // of the own inputs
  bool is_seen = false;    // some input of any rank has a viewpoint
  std::optional<Shapes> turned;
};

} // namespace program

#endif // DETECT_PLANES_SHAPES_OF_OUTPUTS_H
