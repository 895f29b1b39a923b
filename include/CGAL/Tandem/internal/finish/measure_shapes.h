// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Statistics of shapes: the mean distance of points, the terms of the score that depend on points, and how many normals
// are opposite to their planes. Computed on the grid by integer sums, so they are the same for every order of the
// points. Changes nothing else.

#ifndef CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H
#define CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H

#include <CGAL/Tandem/internal/shapes/Labels.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Moment_table.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>

namespace CGAL::Tandem::internal {

// The sums over all points.
struct Point_measures {
  enum : std::size_t { distance, fit, links, free_links, size };
};

// The sums of one cell, before they are added to those of all cells. A point adds at most 2^15 to one of them, so those
// of 2^16 points fit 32 bits. A cell of few, heavy surfels may have more points.
struct Measure_scratch {
  Count_scratch opposed;
  std::uint32_t sum[Point_measures::size];
};

// For each cell, measures its points that belong to a shape of the result. opposed[s] counts the normals of shape s
// that are opposite to its plane.
template <class Backend>
struct Measure_points {
  Cloud_view cloud;
  const Range* cells;
  Labels_of_points labels;
  const Plane* plane;         // by label
  const std::uint32_t* shape; // of each surfel, and of ghosts; a mark if there is none
  Tolerance tolerance;
  std::uint64_t* opposed; // by shape
  std::uint64_t* sum;     // Point_measures

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Measure_scratch& scratch, std::uint32_t c) const
  {
    const Range cell = cells[c];
    const std::uint32_t points = cloud.surfels.points(cell.last - 1).last - cloud.surfels.points(cell.first).first;
    const bool is_heavy = points > 1u << 16;
    scratch.opposed.clear(block);
    block.for_each(Point_measures::size, [&](std::uint32_t m) { scratch.sum[m] = 0; });
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      std::uint64_t of_surfel[Point_measures::size] = {0, 0, 0, 0};
      count_links(i, of_surfel);
      if(shape[i] < first_mark)
        measure(block, scratch, i, of_surfel);
      for(std::size_t m = 0; m < Point_measures::size; ++m)
        if(is_heavy)
          Backend::atomic_add(sum[m], of_surfel[m]);
        else if(of_surfel[m] > 0)
          block.add(scratch.sum[m], std::uint32_t(of_surfel[m]));
    });
    scratch.opposed.template flush<Backend>(block, opposed);
    block.for_each(Point_measures::size,
                   [&](std::uint32_t m) { Backend::atomic_add(sum[m], std::uint64_t(scratch.sum[m])); });
  }

private:
  template <class Block>
  CGAL_TANDEM_HD void measure(Block& block, Measure_scratch& scratch, std::uint32_t i, std::uint64_t* of_surfel) const
  {
    const Plane& p = plane[labels.label[i]];
    std::uint32_t number_opposed = 0;
    labels.for_each_point(i, [&](std::uint32_t at) {
      const std::int64_t distance = signed_distance(p, cloud.surfels.point[at]);
      const std::uint64_t fraction = Score::fraction_of(tolerance, distance);
      of_surfel[Point_measures::distance] += fraction;
      const Tolerance own = cloud.surfels.tolerance_of_point(at, tolerance);
      of_surfel[Point_measures::fit] += std::uint64_t(
        Score::weight_at(own.distance != tolerance.distance ? Score::fraction_of(own, distance) : fraction));
      number_opposed += normal_product(p, decode_normal(cloud.surfels.point[at].normal)) < 0;
    });
    if(number_opposed > 0)
      scratch.opposed.template add<Backend>(block, shape[i], number_opposed, opposed);
  }

  CGAL_TANDEM_HD void count_links(std::uint32_t i, std::uint64_t* of_surfel) const
  {
    const std::uint32_t points = cloud.surfels.points(i).size();
    const std::uint32_t* row = cloud.row(i);
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t s = shape[i], t = shape[row[j]];
      if(s != t && (s < first_mark || t < first_mark))
        of_surfel[s < first_mark && t < first_mark ? Point_measures::links : Point_measures::free_links] += points;
    }
  }
};

// The sums of all ranks, then the opposite normals of each of n shapes.
template <class Backend>
std::vector<std::uint64_t> measure_points(Labeled_cloud<Backend>& points, const Final_shapes& shapes,
                                          const Plane* plane, const Tolerance& tolerance, std::size_t n)
{
  auto sums = filled_buffer(points.backend, Point_measures::size + n, std::uint64_t(0));
  points.backend.template for_each_cell<Measure_scratch>(
    points.number_of_cells(),
    Measure_points<Backend>{points.cloud.view(), points.cells.data(), shapes.labels, plane, shapes.shape, tolerance,
                            sums.data() + Point_measures::size, sums.data()});
  points.ranks.sum(sums.data(), sums.size());
  return to_vector(points.backend, sums);
}

inline Score_counts counts_of(const std::vector<std::uint64_t>& sum)
{
  return {std::int64_t(sum[Point_measures::fit]), std::int64_t(sum[Point_measures::links]),
          std::int64_t(sum[Point_measures::free_links])};
}

// Of labels and planes without relations. free_links: the part of the links to free points.
struct Measured_score {
  Score_terms terms;
  std::int64_t free_links = 0;
};

// Computed anew, by the moments of the shapes.
template <class Backend>
Measured_score measure_score(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                             const Stage_parameters& options)
{
  const Score_counts counts =
    counts_of(measure_points(points, {{points.cloud.surfels(), points.label(), nullptr}, points.label()},
                             shapes.plane.data(), options.growth.tolerance, shapes.size));
  std::vector<std::size_t> size;
  for(const Shape& shape : to_vector(points.backend, shapes.counted(), shapes.size))
    if(shape.is_live())
      size.push_back(std::size_t(shape.moments.count));
  return {score_terms(options.score, counts, size), options.score.links(0, counts.free_links)};
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_FINISH_MEASURE_SHAPES_H
