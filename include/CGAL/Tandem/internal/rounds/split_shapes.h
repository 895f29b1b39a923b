// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A shape whose points lie on two planes becomes two shapes where that gains: layers that one plane has swallowed,
// surfaces that bend, faces that meet at a small angle. The two planes are found in a sample of the points
// (Split_gain), and the links that a split would cut are counted; then each surfel goes to the nearer one. Changes
// labels, the table of shapes, and what the shapes note of it. See the manual, "Splits".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H

#include <CGAL/Tandem/internal/rounds/Shape_samples.h>
#include <CGAL/Tandem/internal/rounds/assign.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

namespace CGAL::Tandem::internal {

// --- What two planes in place of one gain, see score/Score.h, by a sample of the points of the shape. Changes nothing. See
// the manual, "Splits".

// Whether the point is nearer to the first plane.
CGAL_TANDEM_HD inline bool is_nearer(const Plane& a, const Plane& b, const Grid_point& p)
{
  const std::int64_t da = signed_distance(a, p), db = signed_distance(b, p);
  return (da < 0 ? -da : da) < (db < 0 ? -db : db);
}

// The planes of both parts; the first one has more points of the sample.
struct Split {
  Plane first, second;
  std::int64_t gain = 0; // in units of the score; 0: none
};

// The sampled points of a shape.
struct Point_sample {
  const Sampled_point* point;
  std::uint32_t size;

  CGAL_TANDEM_HD const Grid_point& operator[](std::uint32_t i) const { return point[i].point; }
  CGAL_TANDEM_HD std::uint8_t level(std::uint32_t i) const { return std::uint8_t(point[i].level); }
};

// A trial begins with two halves of the sample. Then a plane is fitted to each half, and points go to that of the
// nearer plane, in turn. By a group of lanes, which share the points of the sample.
class Split_gain {
public:
  static constexpr int starts = 7;
  static constexpr std::int64_t sample_size = tuning::moves::split_sample;

  explicit Split_gain(const Stage_parameters& options)
    : score_(options.score), tolerance_(options.growth.tolerance), minimum_size_(options.minimum_region_size),
      per_square_(double(Score::unit) / (options.maximum_distance_steps * options.maximum_distance_steps)),
      far_steps_(options.maximum_distance_steps / 2)
  {}

  // Whether a shape would be worth its price if it took all squared distances away.
  CGAL_TANDEM_HD bool may_split(const Shape& s) const
  {
    return s.moments.count >= minimum_size_ &&
           per_square_ / s.scatter.squared_tolerance * s.fit.smallest > -double(score_.price());
  }

  CGAL_TANDEM_HD Split trial(const Shape& s, const Point_sample& sample, int start) const
  {
    if(!may_gain(s, sample))
      return Split();
    const Eigen_system axes = eigen_system(s.scatter.matrix);
    const Moments all = sum_of<Moments>(sample, [&](std::uint32_t i, Moments& sum) { sum.add(sample[i]); });
    Halves halves(sample, all, [&](const Grid_point& p) { return is_in_second_half(s, axes, p, start); });
    Split split;
    for(int step = 0; step < tuning::moves::split_steps; ++step) {
      if(halves.first.count < 3 || halves.second.count < 3)
        return Split();
      split.first = plane_of(halves.first);
      split.second = plane_of(halves.second);
      const Halves next(sample, all, [&](const Grid_point& p) { return is_nearer(split.second, split.first, p); });
      const bool is_settled = next.second.is_equal(halves.second);
      halves = next;
      if(is_settled)
        break; // planes would be the same
    }
    if(halves.first.count < halves.second.count) {
      const Plane swapped = split.first;
      split.first = split.second;
      split.second = swapped;
    }
    split.gain = gain(s, sample, split);
    return split;
  }

private:
  // The sum of what f(i, sum) adds for the points of a sample.
  template <class Sum, class F>
  CGAL_TANDEM_HD static Sum sum_of(const Point_sample& sample, F f)
  {
    Sum sum = Sum();
    for(std::uint32_t i = Lane_group::rank(); i < sample.size; i += Lane_group::size())
      f(i, sum);
    return Lane_group::sum(sum);
  }

  // The moments of those points of a sample that are in the second half, and of the others.
  struct Halves {
    template <class Predicate>
    CGAL_TANDEM_HD Halves(const Point_sample& sample, const Moments& all, Predicate is_second) : first(all)
    {
      second = sum_of<Moments>(sample, [&](std::uint32_t i, Moments& sum) {
        if(is_second(sample[i]))
          sum.add(sample[i]);
      });
      first -= second;
    }

    Moments first, second;
  };

  // Whether a split would gain if all points of the sample were on its planes.
  CGAL_TANDEM_HD bool may_gain(const Shape& s, const Point_sample& sample) const
  {
    const Plane before = rounded(s.local);
    const auto sum = sum_of<std::int64_t>(
      sample, [&](std::uint32_t i, std::int64_t& part) { part += Score::unit - weight(before, sample, i); });
    return double(s.moments.count) / double(sample.size) * double(sum) > -double(score_.price());
  }

  CGAL_TANDEM_HD static Plane plane_of(const Moments& m)
  {
    Fitted_moments f;
    f.moments = m;
    refit(f);
    return rounded(f.local);
  }

  // Halves along both axes, of the distance, of the normal along both axes; middle and ends; near and far.
  CGAL_TANDEM_HD bool is_in_second_half(const Shape& s, const Eigen_system& axes, const Grid_point& p, int start) const
  {
    const Vector from_center = Vector{double(p.x), double(p.y), double(p.z)} - s.scatter.centroid;
    const double along = dot(from_center, axes.vector[2]), across = dot(from_center, axes.vector[1]);
    const double distance = dot(from_center, axes.vector[0]);
    if(start == 0)
      return along > 0;
    if(start == 1)
      return across > 0;
    if(start == 2)
      return distance > 0;
    if(start == 3 || start == 4) {
      const Int_vector m = decode_normal(p.normal);
      const Vector n = {double(m.x), double(m.y), double(m.z)};
      const double sign = dot(n, axes.vector[0]) < 0 ? -1 : 1;
      return sign * dot(n, axes.vector[start == 3 ? 2 : 1]) > 0;
    }
    if(start == 5)
      return along * along * s.scatter.count > axes.value[2];
    const double far = far_steps_ * std::sqrt(s.scatter.squared_tolerance);
    return distance > far || distance < -far;
  }

  CGAL_TANDEM_HD std::int64_t weight(const Plane& plane, const Point_sample& sample, std::uint32_t i) const
  {
    const Tolerance own = tolerance_.at(sample.level(i));
    return fits(plane, sample[i], own) ? Score::weight({1, own.distance}, signed_distance(plane, sample[i])) : 0;
  }

  // Of the split; 0 where it is not certain, or a part is too small.
  CGAL_TANDEM_HD std::int64_t gain(const Shape& s, const Point_sample& sample, const Split& split) const
  {
    const Plane before = rounded(s.local);
    std::int64_t sum = 0, squares = 0, count[2] = {0, 0};
    for(std::uint32_t i = Lane_group::rank(); i < sample.size; i += Lane_group::size()) {
      const bool second = is_nearer(split.second, split.first, sample[i]);
      const std::int64_t w = weight(second ? split.second : split.first, sample, i);
      const std::int64_t change = w - weight(before, sample, i);
      count[second] += w > 0;
      sum += change;
      squares += change * change;
    }
    for(std::int64_t* own : {&sum, &squares, &count[0], &count[1]})
      *own = Lane_group::sum(*own);
    const std::int64_t n = s.moments.count, size = std::int64_t(sample.size);
    const std::int64_t first = n * count[0] / size, second = n * count[1] / size;
    if(2 * first < minimum_size_ || 2 * second < minimum_size_)
      return 0;
    const double scale = double(n) / double(size);
    const double size_change = double(score_.size_bonus(first) + score_.size_bonus(second) - score_.size_bonus(n));
    const double result = std::fma(scale, double(sum), size_change + double(score_.price()));
    const double variance = size < n ? scale * scale * double(squares) : 0;
    return result > 0 && result * result > variance ? std::int64_t(result) : 0;
  }

  Score score_;
  Tolerance tolerance_;
  std::int64_t minimum_size_;
  double per_square_; // units of the score for a squared grid step
  double far_steps_;  // half of epsilon
};

// Shapes that may gain by a split.
struct May_split {
  const Shape* shape;
  Split_gain gain;

  CGAL_TANDEM_HD bool operator()(std::uint32_t id) const { return shape[id].is_live() && gain.may_split(shape[id]); }
};

// The trials of a shape follow each other. A rank makes its own items. By groups of lanes.
struct Try_splits {
  const Shape* shape;
  const std::uint32_t* id; // of the candidates
  const Sampled_point* point;
  const Range* range; // by shape
  Split_gain gain;
  Own_items own;
  Split* split; // by candidate, then by start

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = id[i / Split_gain::starts];
    const Point_sample sample = {point + range[s].first, range[s].size()};
    const Split result = own.has(i) ? gain.trial(shape[s], sample, int(i % Split_gain::starts)) : Split();
    Lane_group::single([&] { split[i] = result; });
  }
};

struct Numbered_split {
  std::uint64_t number;
  Split split;
};

struct Take_split {
  const Split* split;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return split[i].gain > 0; }
  CGAL_TANDEM_HD Numbered_split take(std::uint32_t i) const { return {i, split[i]}; }
};

struct Put_split {
  const Numbered_split* found;
  Split* split;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { split[found[i].number] = found[i].split; }
};

// The first of the best trials of each candidate goes to its first place.
struct Choose_split {
  Split* split;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    Split* const trial = split + i * Split_gain::starts;
    for(int start = 1; start < Split_gain::starts; ++start)
      if(trial[start].gain > trial[0].gain)
        trial[0] = trial[start];
  }
};

struct Links_run {
  std::uint32_t candidate = no_index;
  std::uint32_t links = 0;
};

// Counts the links between both parts of each candidate.
template <class Backend>
struct Count_cut {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const std::uint32_t* candidate_of; // by shape
  const Split* split;
  std::uint64_t* cut; // by candidate

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, No_scratch&, std::uint32_t c) const
  {
    const auto is_split = [&](std::uint32_t s) {
      return candidate_of[s] != no_index && split[candidate_of[s] * Split_gain::starts].gain > 0;
    };
    if(!cells.may_have(block, c, is_split))
      return;
    const Range cell = cells[c];
    const auto add = [&](const Links_run& run) {
      if(run.links > 0)
        Backend::atomic_add(cut[run.candidate], std::uint64_t(run.links));
    };
    block.template accumulate<Links_run>(
      cell.size(),
      [&](std::uint32_t at, Links_run& run) {
        const std::uint32_t i = cell.first + at, s = label[i];
        if(s >= first_mark || !is_split(s))
          return;
        if(candidate_of[s] != run.candidate) {
          add(run);
          run = {candidate_of[s], 0};
        }
        run.links += links(i, split[run.candidate * Split_gain::starts]);
      },
      add);
  }

private:
  // From surfel i to surfels of the other part of its shape.
  CGAL_TANDEM_HD std::uint32_t links(std::uint32_t i, const Split& parts) const
  {
    const std::uint32_t* row = cloud.row(i);
    const bool is_second = is_nearer(parts.second, parts.first, cloud.point[i]);
    std::uint32_t result = 0;
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j)
      result += label[row[j]] == label[i] && is_nearer(parts.second, parts.first, cloud.point[row[j]]) != is_second;
    return result * cloud.surfels.edge_weight(i);
  }
};

struct Is_split {
  const Split* split;
  const std::uint64_t* cut;
  Score score;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    const std::int64_t gain = split[i * Split_gain::starts].gain;
    return gain > 0 && gain + score.links(std::int64_t(cut[i])) > 0;
  }
};

// The new shapes are behind the others. They have no points yet.
struct Start_half {
  Shape* shape;
  Plane* plane;
  const std::uint32_t* id;
  const std::uint32_t* accepted; // candidates
  const Split* split;
  std::uint32_t* new_id; // by old id
  std::uint32_t first_new;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t old = id[accepted[i]], half = first_new + std::uint32_t(i);
    shape[half] = Shape();
    plane[old] = split[accepted[i] * Split_gain::starts].first;
    plane[half] = split[accepted[i] * Split_gain::starts].second;
    new_id[old] = half;
  }
};

// A surfel goes to the nearer plane, of equally near ones to the first.
struct Choose_half {
  const Grid_point* point;
  const std::uint32_t* label;
  const std::uint32_t* new_id; // by shape; no_index if it stays whole
  const Plane* plane;
  std::uint32_t* chosen;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = label[i], half = s < first_mark ? new_id[s] : no_index;
    chosen[i] = half != no_index && is_nearer(plane[half], plane[s], point[i]) ? half : s;
  }
};

// Room for so many shapes in the tables that are read after the loop.
template <class Backend>
void reserve_shapes(Backend& backend, Shape_table<Backend>& shapes, std::size_t size)
{
  if(size <= shapes.table().size())
    return;
  shapes.table() = extended<Shape>(backend, shapes.table(), size + size / 2);
  shapes.plane = extended<Plane>(backend, shapes.plane, size + size / 2);
}

// Splits by the accepted candidates.
template <class Backend>
struct Found_splits {
  Buffer_of<Backend, std::uint32_t> id, accepted;
  Buffer_of<Backend, Split> split;
};

template <class Backend>
Found_splits<Backend> find_splits(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                                  const Stage_parameters& options)
{
  Backend& backend = points.backend;
  const Split_gain gain(options);
  Found_splits<Backend> found;
  found.id = backend.compact(shapes.size, May_split{shapes.fitted(), gain});
  if(found.id.size() == 0)
    return found;
  Buffer_of<Backend, std::uint32_t>& id = found.id;
  auto bound = filled_buffer(backend, shapes.size, std::uint32_t(0));
  backend.for_each(id.size(), Bound_samples{shapes.fitted(), id.data(), Split_gain::sample_size, bound.data()});
  const Sorted_samples<Backend> sample =
    sorted_samples(backend, shapes.size,
                   collect_of_all<Keyed_point>(backend, points.ranks, points.cloud.number_of_points(),
                                               Take_sampled{points.cloud.view(), points.label(), bound.data()}));
  found.split.reset(id.size() * Split_gain::starts);
  for_each_by_group(backend, found.split.size(),
                    Try_splits{shapes.fitted(), id.data(), sample.point.data(), sample.range.data(), gain,
                               points.ranks.own_items(), found.split.data()});
  if constexpr(Ranks<Backend>::are_many) {
    const auto all =
      collect_of_all<Numbered_split>(backend, points.ranks, found.split.size(), Take_split{found.split.data()});
    backend.for_each(all.size(), Put_split{all.data(), found.split.data()});
  }
  backend.for_each(id.size(), Choose_split{found.split.data()});
  const auto candidate_of = places_of(backend, shapes.size, id);
  auto cut = filled_buffer(backend, id.size(), std::uint64_t(0));
  backend.template for_each_cell<No_scratch>(
    points.number_of_parts(), Count_cut<Backend>{points.cloud.view(), points.listed_parts(), points.label(),
                                                 candidate_of.data(), found.split.data(), cut.data()});
  points.ranks.sum(cut.data(), cut.size());
  found.accepted = backend.compact(id.size(), Is_split{found.split.data(), cut.data(), options.score});
  return found;
}

template <class Backend>
void split_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Stage_parameters& options)
{
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::fits | tables::lists);
  const Found_splits<Backend> found = find_splits(points, shapes, options);
  const std::size_t number = found.accepted.size(), first_new = shapes.size;
  if(number == 0)
    return;
  reserve_shapes(backend, shapes, first_new + number);
  auto new_id = filled_buffer(backend, first_new, no_index);
  backend.for_each(number,
                   Start_half{shapes.change_moments(), shapes.plane.data(), found.id.data(), found.accepted.data(),
                              found.split.data(), new_id.data(), std::uint32_t(first_new)});
  shapes.size = first_new + number;
  Buffer_of<Backend, std::uint32_t> chosen(points.cloud.number_of_surfels());
  backend.for_each(chosen.size(), Choose_half{points.cloud.point.data(), points.label(), new_id.data(),
                                              shapes.plane.data(), chosen.data()});
  take_chosen(points, shapes, chosen.data());
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SPLIT_SHAPES_H
