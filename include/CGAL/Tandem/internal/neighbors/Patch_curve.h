// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The noise of a patch, from its residuals over growing radii. They are flat where they are noise, jump where a second
// surface comes in, and start at zero and rise to those of a tilted plane where depth is in steps.

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_PATCH_CURVE_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_PATCH_CURVE_H

#include <CGAL/Tandem/internal/base/Moments.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- The plane of a sampled point and its neighbors, and the same over growing neighborhoods: first of few and of more
// nearest neighbors, then of as many in samples that are thinned to a quarter, and so reach twice as far, each time.

// Fewer places than a plane can be judged by: `places` is 0.
struct Local_plane {
  int places = 0;            // of neighbors, and of the point itself
  double residual_steps = 0; // root mean square distance to the plane, for the degrees of freedom
  double thickness = 0;      // as a fraction of the half-width
  double radius_steps = 0;   // distance of the farthest neighbor
  Vector normal = {0, 0, 0};
};

inline std::uint64_t squared_grid_distance(const Grid_point& a, const Grid_point& b)
{
  const std::int64_t x = std::int64_t(a.x) - b.x, y = std::int64_t(a.y) - b.y, z = std::int64_t(a.z) - b.z;
  return std::uint64_t(x * x) + std::uint64_t(y * y) + std::uint64_t(z * z);
}

// Whether given normals put two points on the two sides of a wall.
inline bool are_opposite(const Grid_point& a, const Grid_point& b)
{
  const Int_vector m = decode_normal(a.normal), n = decode_normal(b.normal);
  return int_product(m, n) < 0;
}

// The plane of point i and its k nearest neighbors, of its row. Those that are close to another one are copies of it and
// count once; those of the other side of a wall do not count.
inline Local_plane make_local_plane(const Grid_point* point, std::uint32_t i, const std::uint32_t* row, int k)
{
  using namespace tuning::estimation;
  const auto neighbors = int(std::find(row, row + k, no_index) - row);
  Local_plane plane;
  if(neighbors == 0)
    return plane;
  const double squared_radius = double(squared_grid_distance(point[i], point[row[neighbors - 1]]));
  std::uint32_t place[maximum_k + 1] = {i};
  int places = 1;
  Moments moments;
  moments.add(point[i]);
  for(int j = 0; j < neighbors; ++j) {
    const Grid_point& p = point[row[j]];
    const auto is_copy = [&](std::uint32_t q) {
      return double(squared_grid_distance(p, point[q])) < copy_distance * copy_distance * squared_radius;
    };
    if(are_opposite(point[i], p) || std::any_of(place, place + places, is_copy))
      continue;
    place[places++] = row[j];
    moments.add(p);
  }
  const Eigen_system e = eigen_system(make_scatter(moments).matrix);
  if(places < minimum_places || !(e.value[1] > tuning::scan_lines::width2_of_length2 * e.value[2])) // a line
    return plane;
  const double smallest = e.value[0] > 0 ? e.value[0] : 0;
  return {places, std::sqrt(smallest / (places - 3)), std::sqrt(smallest / e.value[1]), std::sqrt(squared_radius),
          e.vector[0]};
}

// The planes of one of 4^thinnings points of the sample.
struct Plane_level {
  int thinnings;
  int neighbors; // of a point
  std::vector<Local_plane> plane;

  // Copies share a place.
  double places_per_point(std::size_t i) const
  {
    return plane[i].places / ((neighbors + 1.) * double(std::size_t(1) << (2 * thinnings)));
  }
};

// Appends the planes of the points and their k nearest neighbors, and before, if few > 0, of their few nearest ones.
template <class Backend>
void add_levels(Backend& backend, const std::vector<Grid_point>& point, int thinnings, std::pair<int, int> few_and_k,
                std::vector<Plane_level>& levels)
{
  const auto [few, k] = few_and_k;
  const std::size_t n = point.size(), row_size = std::size_t(k);
  std::vector<std::uint32_t> neighbor(n * row_size);
  find_neighbors(backend, point.data(), std::uint32_t(n), k, neighbor.data());
  for(const int neighbors : {few, k}) {
    if(neighbors == 0)
      continue;
    std::vector<Local_plane> plane(n);
    backend.for_each(n, [&](std::size_t i) {
      plane[i] = make_local_plane(point.data(), std::uint32_t(i), neighbor.data() + i * row_size, neighbors);
    });
    levels.push_back({thinnings, neighbors, std::move(plane)});
  }
}

// The planes of a sample, in the order of the curve. On a surface, of every fourth point the spacing is twice as wide.
template <class Backend>
std::vector<Plane_level> measure_planes(Backend& backend, std::vector<Grid_point> sample)
{
  using namespace tuning::estimation;
  std::vector<Plane_level> levels;
  for(int thinnings = 0; sample.size() >= std::size_t(thinnings == 0 ? minimum_places : noise_neighbors); ++thinnings) {
    const bool is_last = sample.size() <= 4 * std::size_t(noise_neighbors);
    const int k = is_last ? int((std::min)(sample.size() - 1, std::size_t(maximum_k))) : noise_neighbors;
    add_levels(backend, sample, thinnings, {thinnings == 0 && k > few_neighbors ? few_neighbors : 0, k}, levels);
    std::vector<Grid_point> thin;
    for(std::size_t i = 0; i < sample.size(); i += 4)
      thin.push_back(sample[i]);
    sample = std::move(thin);
  }
  return levels;
}

// The q-quantile of the values, which are reordered, in linear time; 0 if there are none.
inline double quantile(std::vector<double>& values, double q)
{
  if(values.empty())
    return 0;
  const auto nth = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// What is found of one patch.
struct Patch_measure {
  double noise_steps = -1;     // -1: no surface
  double spacing_steps = 0;    // copies count once; that of space where there is no surface
  double places_per_point = 1; // at the first level
  std::size_t first = 0;       // the level that shows the surface first
  std::size_t exact = 0;       // how many of the smallest neighborhoods have no residual against the noise, ...
  std::size_t measured = 0;    // ... and how many there are
  bool has_sheets = false, bends = false;
  int flat = 0; // levels with the first residual

  bool has_surface() const { return noise_steps >= 0; }
  // Whether the residual is the same over several radii.
  bool is_flat() const { return flat > 1; }
};

// The patches of a sample: so many points along the curve each. Evaluates one after the other, on one thread.
class Patch_curve {
public:
  explicit Patch_curve(const std::vector<Plane_level>& levels) : levels_(levels) {}

  // Follows the curve of a patch.
  Patch_measure follow(std::size_t patch);

private:
  // Medians over the planes of a patch at one level.
  struct Summary {
    double residual_steps = 0, thickness = 0;
    bool is_measured = false;

    // Thin against its width, or at least not much thicker than the neighborhood before, which is smaller.
    bool is_surface(const Summary& before) const
    {
      using namespace tuning::estimation;
      return is_measured && (thickness < surface_thickness ||
                             (thickness < flat_thickness && residual_steps < flat_step * before.residual_steps));
    }
  };

  // The planes of a patch at a level: at least one, that of the point before.
  Range planes(std::size_t level) const
  {
    const Plane_level& l = levels_[level];
    const auto at = [&](std::size_t p) {
      const std::size_t step = std::size_t(1) << (2 * l.thinnings);
      return std::uint32_t((std::min)((p * tuning::estimation::patch_size + step - 1) / step, l.plane.size()));
    };
    const Range range = {at(patch_), at(patch_ + 1)};
    return range.size() > 0 ? range : Range{range.first - 1, range.first};
  }

  template <class F>
  double median(std::size_t level, F f)
  {
    value_.clear();
    const Range range = planes(level);
    for(std::uint32_t i = range.first; i < range.last; ++i)
      if(levels_[level].plane[i].places > 0)
        value_.push_back(f(i));
    return quantile(value_, .5);
  }

  Summary summary(std::size_t level)
  {
    const std::vector<Local_plane>& plane = levels_[level].plane;
    Summary s;
    s.residual_steps = median(level, [&](std::uint32_t i) { return plane[i].residual_steps; });
    s.thickness = median(level, [&](std::uint32_t i) { return plane[i].thickness; });
    s.is_measured = 2 * value_.size() >= planes(level).size();
    return s;
  }

  // By how many of its residuals the planes of a level leave those of the first one along their radius.
  double tilt(std::size_t level, std::size_t first)
  {
    const Plane_level &coarse = levels_[level], &fine = levels_[first];
    return median(level, [&](std::uint32_t i) {
      const Local_plane& p = coarse.plane[i];
      const Local_plane& q = fine.plane[std::size_t(i) << (2 * (coarse.thinnings - fine.thinnings))];
      const double cosine = q.places > 0 ? dot(p.normal, q.normal) : 1;
      return p.radius_steps * std::sqrt((std::max)(1 - cosine * cosine, 0.)) / (std::max)(p.residual_steps, 1e-9);
    });
  }

  // The mean distance of a point to its six nearest neighbors, if there are so many in a disk.
  double spacing_steps(std::size_t level)
  {
    const std::vector<Local_plane>& plane = levels_[level].plane;
    return median(level,
                  [&](std::uint32_t i) { return 1.73 * plane[i].radius_steps / std::sqrt(plane[i].places - 1.); });
  }

  void count_exact(Patch_measure& m) const;

  const std::vector<Plane_level>& levels_;
  std::vector<double> value_;
  std::size_t patch_ = 0;
};

// Only planes along the surface count: points of one scan line may lie on a plane across it.
inline void Patch_curve::count_exact(Patch_measure& m) const
{
  using namespace tuning::estimation;
  const Plane_level& surface = levels_[m.first];
  const Range range = planes(0);
  for(std::uint32_t i = range.first; i < range.last; ++i) {
    const Local_plane& p = levels_[0].plane[i];
    const Local_plane& q = surface.plane[i >> (2 * surface.thinnings)];
    if(p.places == 0 || q.places == 0)
      continue;
    ++m.measured;
    m.exact += p.residual_steps < step_flatness * m.noise_steps && p.thickness < step_flatness &&
               std::fabs(dot(p.normal, q.normal)) > .7;
  }
}

inline Patch_measure Patch_curve::follow(std::size_t patch)
{
  using namespace tuning::estimation;
  patch_ = patch;
  Patch_measure m;
  double first_residual = 0, sum = 0, last = 0;
  int bent = 0;
  Summary before;
  bool was_thick = false, has_left = false, has_steps = false;
  for(std::size_t l = 0; l < levels_.size() && !has_steps; ++l) {
    const Summary s = summary(l);
    if(m.spacing_steps == 0)
      m.spacing_steps = spacing_steps(l);
    const bool is_surface = s.is_surface(before);
    before = s;
    if(!is_surface) {
      was_thick = has_left = m.has_surface();
      continue;
    }
    if(!m.has_surface()) {
      m.first = l;
      m.spacing_steps = spacing_steps(l);
      m.places_per_point = median(l, [&](std::uint32_t i) { return levels_[l].places_per_point(i); });
      first_residual = m.noise_steps = s.residual_steps;
    }
    if(!has_left && s.residual_steps <= flat_growth * first_residual) {
      sum += s.residual_steps;
      m.noise_steps = sum / ++m.flat;
    } else {
      has_left = true;
      has_steps = first_residual < step_flatness * s.residual_steps &&
                  levels_[l].thinnings <= levels_[m.first].thinnings + step_thinnings && tilt(l, m.first) >= step_tilt;
      if(has_steps)
        m.noise_steps = s.residual_steps;
      m.has_sheets |= was_thick && last > flat_growth * first_residual && s.residual_steps < flat_growth * last;
      bent = !was_thick && s.residual_steps > 2 * last ? bent + 1 : 0;
      m.bends |= bent == 2;
    }
    last = s.residual_steps;
  }
  if(m.has_surface())
    count_exact(m);
  if(m.measured > 0 && step_neighborhoods.is_reached(std::int64_t(m.exact), std::int64_t(m.measured)))
    m.noise_steps *= step_margin;
  return m;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_PATCH_CURVE_H
