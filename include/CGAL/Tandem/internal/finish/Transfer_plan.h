// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shape gives points to which larger one, and which planes change for it. Decided by counts of points; nothing
// is changed here. See the manual, "Transfer to Larger Planes".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_PLAN_H
#define CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_PLAN_H

#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/rounds/Joint_fit_criterion.h>
#include <CGAL/Tandem/internal/shapes/Count_scratch.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/links.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

enum class Planes { may_change, are_fixed };

// What a plan is made of, beside points and shapes.
struct Transfer_input {
  const Link_list& links;
  const std::vector<int>& plane_of; // by shape: those of one number, but -1, exchange no points
  Planes planes;
};

struct Transfer_plan {
  std::vector<std::uint32_t> target;    // by shape: where points that fit go; itself if it gives none
  std::vector<std::uint8_t> is_changed; // by shape: whether it takes its local plane
  bool is_any = false;                  // otherwise nothing would change
};

// The plane of a shape, and its local plane.
struct Transfer_query {
  Plane before, after;
};

// For each cell: how many points of a shape fit the planes of its queries. The counts of query q are at 2 q and
// 2 q + 1.
template <class Backend>
struct Count_fitting {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  const Range* queries_of; // by shape
  const Transfer_query* query;
  std::uint32_t* count;
  Tolerance tolerance;
  bool counts_after; // whether the second plane counts at all

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch& scratch, std::uint32_t c) const
  {
    if(!cells.shapes[c].may_have(block, [&](std::uint32_t s) { return queries_of[s].size() > 0; }))
      return;
    const Range cell = cells[c];
    scratch.clear(block);
    block.for_each(cell.size(), [&](std::uint32_t at) {
      const std::uint32_t i = cell.first + at;
      if(label[i] >= first_mark)
        return;
      const Range range = queries_of[label[i]];
      for(std::uint32_t q = range.first; q < range.last; ++q) {
        if(fits(query[q].before, cloud.point[i], tolerance))
          scratch.template add<Backend>(block, 2 * q, count);
        if(counts_after && fits(query[q].after, cloud.point[i], tolerance))
          scratch.template add<Backend>(block, 2 * q + 1, count);
      }
    });
    scratch.template flush<Backend>(block, count);
  }
};

// The making of one plan. All moments have to be right and fitted. A query is a pair of shapes: points of the first may
// go to the second, which comes before it in the order by falling number of points, then by id. So nothing goes in
// circles.
template <class Backend>
class Transfer_planner {
  struct Query {
    std::uint32_t from, to;
  };

public:
  Transfer_planner(Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes, const Options& options,
                   const Transfer_input& in)
    : points_(points), shapes_(shapes), options_(options), in_(in)
  {}

  Transfer_plan plan()
  {
    Transfer_plan plan;
    plan.target = identity_targets(shapes_.size());
    plan.is_changed.assign(shapes_.size(), 0);
    list_queries();
    if(query_.empty())
      return plan;
    count_points();
    if(may_change())
      choose_planes(plan);
    choose_targets(plan);
    return plan;
  }

private:
  bool may_change() const { return in_.planes == Planes::may_change; }

  bool is_before(std::uint32_t a, std::uint32_t b) const
  {
    const std::int64_t na = shapes_[a].moments.count, nb = shapes_[b].moments.count;
    return na > nb || (na == nb && a < b);
  }

  // Squared distances from the plane: of the centroid, and the variance about it; in steps^2.
  struct Distances {
    double centroid2, variance;
  };

  Distances distances(std::uint32_t t, const Regular_plane& plane) const
  {
    const Scatter& s = shapes_[t].scatter;
    const double e = dot(plane.normal, s.centroid) - plane.offset;
    return {e * e, quadratic_form(s.matrix, plane.normal) / s.count};
  }

  // Whether enough points of t may be within epsilon, by Cantelli's inequality: at most v / (v + (e - epsilon)^2) of
  // them are, for a centroid at a distance e > epsilon and a variance v. No point is read.
  bool may_explain(std::uint32_t t, const Regular_plane& plane) const
  {
    using tuning::transfer::explained_share;
    const double epsilon = options_.maximum_distance;
    const Distances d = distances(t, plane);
    const double e = std::sqrt(d.centroid2) - epsilon;
    const double rest = double(explained_share.denominator - explained_share.numerator);
    return e <= 0 || d.variance * rest * 1.000001 >= e * e * double(explained_share.numerator);
  }

  // Whether t lies beside the plane, as thin as its local plane has it: then it may be a layer of its own.
  bool is_layer(std::uint32_t t, const Regular_plane& plane) const
  {
    using namespace tuning::transfer;
    const double epsilon = layer_distance * options_.maximum_distance;
    const Distances d = distances(t, plane);
    const Shape& shape = shapes_[t];
    return d.centroid2 > epsilon * epsilon && d.variance * shape.scatter.count <= layer_variance * shape.fit.smallest;
  }

  // Queries by the shape that gives, then by the order of those that take. Where planes may change, shapes that may
  // take points have queries to themselves, which count the points that their planes keep.
  void list_queries()
  {
    std::vector<std::uint32_t> rank(shapes_.size()), order(shapes_.live.begin(), shapes_.live.end());
    points_.backend.sort_on_host(order.begin(), order.end(),
                                 [&](std::uint32_t a, std::uint32_t b) { return is_before(a, b); });
    for(std::size_t r = 0; r < order.size(); ++r)
      rank[order[r]] = std::uint32_t(r);
    std::vector<std::uint64_t> keys; // giving shape << 32 | rank of the taking one
    std::vector<std::uint8_t> takes(shapes_.size(), 0);
    for(const Link& link : in_.links) {
      std::uint32_t t = link.first(), s = link.second();
      if(is_before(t, s))
        std::swap(t, s);
      const bool is_one_plane = in_.plane_of[t] >= 0 && in_.plane_of[t] == in_.plane_of[s];
      if(is_one_plane || !(may_explain(t, shapes_[s].plane) || (may_change() && may_explain(t, shapes_[s].local))))
        continue;
      keys.push_back(std::uint64_t(t) << 32 | rank[s]);
      takes[s] = may_change();
    }
    for(std::uint32_t id : shapes_.live)
      if(takes[id])
        keys.push_back(std::uint64_t(id) << 32 | rank[id]);
    points_.backend.sort_on_host(keys.begin(), keys.end(), std::less<std::uint64_t>());
    for(std::uint64_t key : keys)
      query_.push_back({std::uint32_t(key >> 32), order[std::uint32_t(key)]});
  }

  void count_points()
  {
    Backend& backend = points_.backend;
    std::vector<Range> queries_of(shapes_.size(), Range{0, 0});
    std::vector<Transfer_query> planes(query_.size());
    for(std::uint32_t q = 0; q < query_.size(); ++q) {
      Range& range = queries_of[query_[q].from];
      range = {range.size() > 0 ? range.first : q, q + 1};
      const Shape& taking = shapes_[query_[q].to];
      planes[q] = {shapes_.plane[query_[q].to], may_change() ? rounded(taking.local) : Plane()};
    }
    count_.assign(2 * query_.size(), 0);
    const auto ranges = backend.read_access(queries_of);
    const auto queries = backend.read_access(planes);
    auto counts = backend.read_write_access(count_);
    backend.template for_each_cell<Count_scratch>(
      points_.number_of_cells(),
      Count_fitting<Backend>{points_.cloud.view(), points_.cells_view(), points_.label.data(), ranges.data(),
                             queries.data(), counts.data(), options_.growth.tolerance, may_change()});
    counts.copy_back();
  }

  // The points that the first shape of a query would give; none if they are too few, or a layer. after: to the local
  // plane of the second one.
  std::int64_t explained(std::size_t q, bool after) const
  {
    const std::uint32_t t = query_[q].from, s = query_[q].to;
    const std::int64_t fitting = count_[2 * q + std::size_t(after)], size = shapes_[t].moments.count;
    if(t == s)
      return fitting;
    const Regular_plane& plane = after ? shapes_[s].local : shapes_[s].plane;
    const tuning::Share least = is_layer(t, plane) ? tuning::transfer::layer_share : tuning::transfer::explained_share;
    return least.is_reached(fitting, size) ? fitting : 0;
  }

  // A shape takes its local plane if that explains more.
  void choose_planes(Transfer_plan& plan) const
  {
    std::vector<std::int64_t> before(shapes_.size(), 0), after(shapes_.size(), 0);
    for(std::size_t q = 0; q < query_.size(); ++q) {
      before[query_[q].to] += explained(q, false);
      after[query_[q].to] += explained(q, true);
    }
    for(std::uint32_t id : shapes_.live) {
      plan.is_changed[id] = tuning::transfer::better_plane.is_exceeded(after[id], before[id]);
      plan.is_any = plan.is_any || plan.is_changed[id];
    }
  }

  // Each shape gives to the first one, in their order, that explains enough of it.
  void choose_targets(Transfer_plan& plan) const
  {
    for(std::size_t q = 0; q < query_.size(); ++q) {
      const std::uint32_t t = query_[q].from, s = query_[q].to;
      if(t == s || plan.target[t] != t || explained(q, plan.is_changed[s]) == 0)
        continue;
      plan.target[t] = s;
      plan.is_any = true;
    }
  }

  Labeled_cloud<Backend>& points_;
  const Shape_table<Backend>& shapes_;
  const Options& options_;
  const Transfer_input& in_;
  std::vector<Query> query_;
  std::vector<std::uint32_t> count_; // two by query
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_PLAN_H
