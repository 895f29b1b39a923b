// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shape gives points to which larger one, and which planes change for it. Decided by counts of points; nothing
// is changed here. See the manual, "Transfer to Larger Planes".

#ifndef CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_PLAN_H
#define CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_PLAN_H

#include <CGAL/Tandem/internal/base/tuning/finish.h>
#include <CGAL/Tandem/internal/finish/Transfer_criterion.h>
#include <CGAL/Tandem/internal/shapes/Count_scratch.h>
#include <CGAL/Tandem/internal/shapes/Options.h>
#include <CGAL/Tandem/internal/shapes/links.h>

#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

enum class Planes { may_change, are_fixed };

template <class Backend>
struct Transfer_plan {
  Targets<Backend> target; // by shape: where points that fit go; itself if it gives none
  typename Backend::template Buffer<std::uint8_t> is_changed; // by shape: whether it takes its local plane
  bool is_any = false;                                        // otherwise nothing would change
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
  std::uint64_t* count;
  Tolerance tolerance;
  bool counts_after; // whether the second plane counts at all

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Count_scratch& scratch, std::uint32_t c) const
  {
    if(!cells.may_have(block, c, [&](std::uint32_t s) { return queries_of[s].size() > 0; }))
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

// By link: giving shape << 32 | taking shape, or no_query.
constexpr std::uint64_t no_query = ~std::uint64_t(0);

template <class Backend>
struct Find_query {
  Transfer_criterion criterion;
  const Link* link;
  std::uint64_t* query;
  std::int32_t* takes; // by shape; null if planes do not change

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t a = link[i].first(), b = link[i].second();
    const bool is_first_larger = is_before(criterion.shape, a, b);
    const std::uint32_t s = is_first_larger ? a : b, t = is_first_larger ? b : a;
    query[i] = criterion.may_take(s, t) ? std::uint64_t(t) << 32 | s : no_query;
    if(query[i] != no_query && takes != nullptr)
      Backend::atomic_max(takes[s], 1);
  }
};

// The queries of links, then those of shapes with themselves.
struct Take_queries {
  const std::uint64_t* query;
  std::uint32_t links;
  const std::int32_t* takes;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return i < links ? query[i] != no_query : takes[i - links] != 0; }
  CGAL_TANDEM_HD std::uint64_t take(std::uint32_t i) const
  {
    return i < links ? query[i] : std::uint64_t(i - links) << 32 | (i - links);
  }
};

template <class Table>
struct Fill_table {
  const std::uint64_t* key;
  Table table;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { table.set(i, key[i], std::uint32_t(i)); }
};

// Queries from their sorted keys; those of one giving shape are a range.
template <class Table>
struct Make_query {
  Table table;
  std::size_t queries;
  const Shape* shape;
  const Plane* plane;
  Transfer_query* query;
  Range* queries_of; // by giving shape

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::uint32_t from = std::uint32_t(table.key(i) >> 32), to = std::uint32_t(table.key(i));
    query[i] = {from, to, plane[to], rounded(shape[to].local)};
    if(i == 0 || table.key(i - 1) >> 32 != from)
      queries_of[from].first = std::uint32_t(i);
    if(i + 1 == queries || table.key(i + 1) >> 32 != from)
      queries_of[from].last = std::uint32_t(i + 1);
  }
};

// How many points the two planes of a shape explain.
struct Explained {
  std::int64_t before = 0, after = 0;
};

template <class Backend>
struct Sum_explained {
  Transfer_criterion criterion;
  const Transfer_query* query;
  const std::uint64_t* count; // two by query
  Explained* explained;       // by shape

  CGAL_TANDEM_HD void operator()(std::size_t q) const
  {
    Explained& e = explained[query[q].to];
    Backend::atomic_add(e.before, criterion.explained(query[q], false, std::int64_t(count[2 * q])));
    Backend::atomic_add(e.after, criterion.explained(query[q], true, std::int64_t(count[2 * q + 1])));
  }
};

// A shape takes its local plane if that explains more.
struct Choose_plane {
  const Explained* explained;
  std::uint8_t* is_changed;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    constexpr tuning::Share share = tuning::transfer::better_plane;
    is_changed[id] = share.is_exceeded(explained[id].after, explained[id].before);
  }
};

// A shape gives to the first one, in their order, that explains enough of it.
struct Choose_target {
  Transfer_criterion criterion;
  const Transfer_query* query;
  const Range* queries_of;
  const std::uint64_t* count;
  const std::uint8_t* is_changed;
  std::uint32_t* target;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    std::uint32_t chosen = std::uint32_t(id);
    for(std::uint32_t q = queries_of[id].first; q < queries_of[id].last; ++q) {
      const std::uint32_t s = query[q].to;
      const bool after = is_changed[s] != 0;
      if(s != id && (chosen == id || is_before(criterion.shape, s, chosen)) &&
         criterion.explained(query[q], after, std::int64_t(count[2 * q + after])) > 0)
        chosen = s;
    }
    target[id] = chosen;
  }
};

struct Count_transfers {
  const std::uint32_t* target;
  const std::uint8_t* is_changed;

  CGAL_TANDEM_HD void operator()(std::size_t id, std::int64_t* sum) const
  {
    sum[0] += target[id] != id || is_changed[id] != 0;
  }
};

// The making of one plan, of fitted shapes.
template <class Backend>
class Transfer_planner {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  Transfer_planner(Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes, const Options& options,
                   Planes planes)
    : points_(points), backend_(points.backend), shapes_(shapes),
      options_(options), criterion_{shapes.fitted(), options.maximum_distance, planes == Planes::may_change}
  {}

  Transfer_plan<Backend> plan(const Buffer<Link>& links)
  {
    Transfer_plan<Backend> plan;
    list_queries(links);
    if(query_.size() == 0)
      return plan;
    count_points();
    plan.is_changed = filled_buffer(backend_, shapes_.size, std::uint8_t(0));
    plan.target.reset(shapes_.size);
    if(criterion_.may_change)
      choose_planes(plan);
    for_each_shape(backend_, shapes_,
                   Choose_target{criterion_, query_.data(), queries_of_.data(), count_.data(), plan.is_changed.data(),
                                 plan.target.data()});
    plan.is_any =
      backend_.template sum<1>(shapes_.size, Count_transfers{plan.target.data(), plan.is_changed.data()})[0] > 0;
    return plan;
  }

private:
  void list_queries(const Buffer<Link>& links)
  {
    using Table = typename Backend::Sort_table::View;
    Buffer<std::uint64_t> of_link(links.size());
    Buffer<std::int32_t> takes;
    if(criterion_.may_change)
      takes = filled_buffer(backend_, shapes_.size, std::int32_t(0));
    backend_.for_each(
      links.size(),
      Find_query<Backend>{criterion_, links.data(), of_link.data(), criterion_.may_change ? takes.data() : nullptr},
      shapes_per_thread);
    const auto keys = backend_.template collect<std::uint64_t>(
      links.size() + takes.size(), Take_queries{of_link.data(), std::uint32_t(links.size()), takes.data()});
    typename Backend::Sort_table table(keys.size());
    backend_.for_each(keys.size(), Fill_table<Table>{keys.data(), table.view()});
    backend_.sort(table);
    query_.reset(keys.size());
    queries_of_ = filled_buffer(backend_, shapes_.size, Range{0, 0});
    backend_.for_each(keys.size(),
                      Make_query<Table>{table.view(), keys.size(), shapes_.fitted(), shapes_.plane.data(),
                                        query_.data(), queries_of_.data()},
                      shapes_per_thread);
  }

  void count_points()
  {
    count_ = filled_buffer(backend_, 2 * query_.size(), std::uint64_t(0));
    backend_.template for_each_cell<Count_scratch>(
      points_.number_of_parts(),
      Count_fitting<Backend>{points_.cloud.view(), points_.listed_parts(), points_.label(), queries_of_.data(),
                             query_.data(), count_.data(), options_.growth.tolerance, criterion_.may_change});
    points_.ranks.sum(count_.data(), count_.size());
  }

  void choose_planes(Transfer_plan<Backend>& plan)
  {
    auto explained = filled_buffer(backend_, shapes_.size, Explained());
    backend_.for_each(query_.size(), Sum_explained<Backend>{criterion_, query_.data(), count_.data(), explained.data()},
                      shapes_per_thread);
    for_each_shape(backend_, shapes_, Choose_plane{explained.data(), plan.is_changed.data()});
  }

  Labeled_cloud<Backend>& points_;
  Backend& backend_;
  const Shape_table<Backend>& shapes_;
  const Options& options_;
  const Transfer_criterion criterion_;
  Buffer<Transfer_query> query_; // by giving shape
  Buffer<Range> queries_of_;     // by giving shape: its queries
  Buffer<std::uint64_t> count_;  // two by query
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_FINISH_TRANSFER_PLAN_H
