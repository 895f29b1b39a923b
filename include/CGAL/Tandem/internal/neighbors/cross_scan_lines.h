// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Neighbors across scan lines. Many sensors sample on lines, which are much farther apart than the points of a line.
// There the k nearest surfels of a surfel are on its own line: they tell nothing of the surface across it, and no shape
// grows from one line to the next. Such a surfel gets half of its neighbors from a thinned cloud, of one surfel in each
// octant, of the smallest octants in which neighborhoods have a width. Changes rows of the neighbor graph. See the
// manual, "Scan Lines".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_CROSS_SCAN_LINES_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_CROSS_SCAN_LINES_H

#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/sort_along_curve.h>
#include <CGAL/Tandem/internal/neighbors/find_neighbors.h>
#include <CGAL/Tandem/internal/neighbors/grow_neighborhoods.h>

namespace CGAL::Tandem::internal {

// Whether neighborhoods are lines: narrow against their length, or against the noise, which gives a line a width.
struct Line_test {
  double noise2; // squared grid steps, at epsilon
  double ratio = tuning::scan_lines::width2_of_length2;

  CGAL_TANDEM_HD bool operator()(const Neighborhood& h, double tolerance_factor) const
  {
    const covariance::Matrix c = covariance::cofactors({h.xx, h.xy, h.xz, h.yy, h.yz, h.zz});
    // With variances a >= b >= c, a + b + c, and a b + b c + c a.
    const double sum = double(h.xx) + h.yy + h.zz, product = double(c.xx) + c.yy + c.zz;
    const double narrow = ratio * sum, noise = noise2 * tolerance_factor * tolerance_factor;
    const double noisy = 4 * narrow < noise ? 4 * narrow : noise;
    return !(product > (narrow > noisy ? narrow : noisy) * sum);
  }
};

// The neighborhood of point i and the points of its row.
CGAL_TANDEM_HD inline Neighborhood neighborhood_of_row(const Grid_point* point, std::uint32_t i, const std::uint32_t* row,
                                                       int k)
{
  Neighborhood_sum sum;
  sum.add({0, 0, 0});
  for(int j = 0; j < k && row[j] != no_index; ++j)
    sum.add(difference(point[row[j]], point[i]));
  return sum.mean();
}

// Counts the lines among the rows of a sample.
struct Count_lines {
  Cloud_view cloud;
  Line_test is_line;

  CGAL_TANDEM_HD void operator()(std::size_t i, std::int64_t* sum) const
  {
    if((i + cloud.first) % tuning::scan_lines::surfels_per_sampled != 0)
      return;
    const std::uint32_t s = std::uint32_t(i);
    ++sum[0];
    sum[1] += is_line(neighborhood_of_row(cloud.point, s, cloud.row(s), cloud.k), level_factor(cloud.level_of(s)));
  }
};

// The direction of a line: the longest column of its covariance.
CGAL_TANDEM_HD inline std::uint32_t line_direction(const Neighborhood& h)
{
  if(h.xx >= h.yy && h.xx >= h.zz)
    return encode_normal({h.xx, h.xy, h.xz});
  return h.yy >= h.zz ? encode_normal({h.xy, h.yy, h.yz}) : encode_normal({h.xz, h.yz, h.zz});
}

// Whether lines run along each other, within 45 degrees.
CGAL_TANDEM_HD inline bool are_along(std::uint32_t a, std::uint32_t b)
{
  const Int_vector u = decode_normal(a), v = decode_normal(b);
  const auto product = [](const Int_vector& m, const Int_vector& n) {
    return std::int64_t(m.x) * n.x + std::int64_t(m.y) * n.y + std::int64_t(m.z) * n.z;
  };
  return 2 * product(u, v) * product(u, v) > product(u, u) * product(v, v);
}

// The surfels whose rows are lines, with the directions of these; no_normal for others.
struct Mark_lines {
  Cloud_view cloud;
  Line_test test;
  std::uint8_t* is_line;
  std::uint32_t* direction;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = std::uint32_t(i);
    const Neighborhood h = neighborhood_of_row(cloud.point, s, cloud.row(s), cloud.k);
    is_line[i] = test(h, level_factor(cloud.level_of(s)));
    direction[i] = is_line[i] ? line_direction(h) : no_normal;
  }
};

struct Count_marked {
  const std::uint8_t* is_marked;

  CGAL_TANDEM_HD void operator()(std::size_t i, std::int64_t* sum) const { sum[0] += is_marked[i]; }
};

// The first surfels of octants along the curve: the thinned cloud.
struct Begins_octant {
  const Grid_point* point;
  Code_frame frame;
  int level;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const
  {
    return i == 0 || !frame.share_octant(point[i - 1], point[i], level);
  }
};

struct Gather_thinned {
  const Grid_point* point;
  const std::uint32_t* surfel;
  Grid_point* thinned;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { thinned[i] = point[surfel[i]]; }
};

// Of a thinned cloud, with the rows of its points.
struct Thinned_view {
  const Grid_point* point;
  const std::uint32_t* surfel; // that it is
  const std::uint32_t* neighbor;
  std::uint32_t size;
  int k;

  CGAL_TANDEM_HD const std::uint32_t* row(std::uint32_t i) const { return neighbor + std::size_t(i) * std::size_t(k); }

  // That of the octant of a surfel.
  CGAL_TANDEM_HD std::uint32_t place_of(std::uint32_t s) const
  {
    std::uint32_t first = 0, last = size;
    while(last - first > 1) {
      const std::uint32_t middle = (first + last) / 2;
      (surfel[middle] <= s ? first : last) = middle;
    }
    return first;
  }
};

// Gives a surfel whose row is a line the farther neighbors of the first surfel of its octant, if those are no line.
struct Cross_lines {
  Cloud_view cloud;
  Thinned_view thinned;
  const std::uint8_t* is_wide; // by place in the thinned cloud
  std::uint8_t* is_line;
  std::uint32_t* neighbor; // of the cloud

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint32_t i = std::uint32_t(at);
    if(is_line[i] == 0)
      return;
    const std::uint32_t place = thinned.place_of(i);
    if(is_wide[place] == 0)
      return;
    is_line[i] = 0;
    std::uint32_t* const row = neighbor + at * std::size_t(cloud.k);
    const std::uint32_t* const farther = thinned.row(place);
    int size = cloud.k / 2;
    for(int j = cloud.k / 2; j < cloud.k && farther[j] != no_index; ++j) {
      const std::uint32_t s = thinned.surfel[farther[j]];
      bool is_new = s != i;
      for(int e = 0; e < cloud.k / 2; ++e)
        is_new = is_new && row[e] != s;
      if(is_new)
        row[size++] = s;
    }
    for(; size < cloud.k; ++size)
      row[size] = no_index;
  }
};

struct Mark_wide {
  Thinned_view thinned;
  Cloud_view cloud;
  Line_test test;
  const std::uint32_t* direction;
  std::uint8_t* is_wide;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t s = std::uint32_t(i);
    const std::uint32_t own = direction[thinned.surfel[s]];
    Neighborhood_sum sum;
    sum.add({0, 0, 0});
    const std::uint32_t* row = thinned.row(s);
    for(int j = 0; j < thinned.k && row[j] != no_index; ++j) {
      const std::uint32_t other = direction[thinned.surfel[row[j]]];
      if(own == no_normal || other == no_normal || are_along(own, other))
        sum.add(difference(thinned.point[row[j]], thinned.point[i]));
    }
    is_wide[i] = !test(sum.mean(), level_factor(cloud.level_of(thinned.surfel[s])));
  }
};

// Whether there are scan lines is decided for the whole cloud.
template <class Backend>
void cross_scan_lines(Backend& backend, Sorted_cloud<Backend>& cloud, const Code_frame& frame, double epsilon_steps)
{
  const Cloud_view view = cloud.view();
  const double noise = tuning::scan_lines::width_of_noise * epsilon_steps;
  const Line_test test = {noise * noise};
  const auto sampled = backend.template sum<2>(view.size, Count_lines{view, test});
  if(std::getenv("SL")) std::fprintf(stderr, "lines %.4f of %ld\n", double(sampled[1]) / double(sampled[0]), long(sampled[0]));
  if(!tuning::scan_lines::of_cloud.is_exceeded(sampled[1], sampled[0]))
    return;
  Buffer_of<Backend, std::uint8_t> is_line(view.size);
  Buffer_of<Backend, std::uint32_t> direction(view.size);
  backend.for_each(view.size, Mark_lines{view, test, is_line.data(), direction.data()});
  std::size_t last = view.size;
  for(int level = 1; level < curve_bits; ++level) {
    const auto surfel = backend.compact(view.size, Begins_octant{view.point, frame, level});
    const std::size_t n = surfel.size();
    if(n <= std::size_t(view.k))
      return;
    if(4 * n > 3 * last)
      continue;
    last = n;
    Buffer_of<Backend, Grid_point> point(n);
    backend.for_each(n, Gather_thinned{view.point, surfel.data(), point.data()});
    Buffer_of<Backend, std::uint32_t> neighbor(n * std::size_t(view.k));
    find_neighbors(backend, point.data(), std::uint32_t(n), view.k, neighbor.data());
    const Thinned_view thinned = {point.data(), surfel.data(), neighbor.data(), std::uint32_t(n), view.k};
    Buffer_of<Backend, std::uint8_t> is_wide(n);
    backend.for_each(n, Mark_wide{thinned, view, {test.noise2, std::getenv("R") ? std::atof(std::getenv("R")) : test.ratio}, direction.data(), is_wide.data()});
    backend.for_each(view.size, Cross_lines{view, thinned, is_wide.data(), is_line.data(), cloud.neighbor.data()});
    const auto left = backend.template sum<1>(view.size, Count_marked{is_line.data()});
    if(std::getenv("SL")) std::fprintf(stderr, "level %d: %zu points, %ld left\n", level, n, long(left[0]));
    if(left[0] == 0)
      return;
  }
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_CROSS_SCAN_LINES_H
