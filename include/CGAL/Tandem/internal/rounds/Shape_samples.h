// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The samples of all shapes, in one pass over the points. Nothing else changes.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLES_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/backend/lanes.h>
#include <CGAL/Tandem/internal/base/keys.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- A sample of the points of a shape: those of the least hash of their position. That of a union of shapes is a merge of
// theirs, so that shapes can unite without a pass over the points.

struct Sampled_point {
  std::uint32_t hash, level; // level: of its tolerance
  Grid_point point;
};

// By rising hash.
struct Shape_sample {
  static constexpr std::uint32_t capacity = 64;
  std::uint32_t size;
  Sampled_point item[capacity];
};

// Whether an item of the other one is among the least hashes of both.
CGAL_TANDEM_HD inline bool has_least(const Shape_sample& target, const Shape_sample& other)
{
  return other.size > 0 &&
         (target.size < Shape_sample::capacity || other.item[0].hash < target.item[Shape_sample::capacity - 1].hash);
}

// The items of a sample, two in each of 32 lanes: that of the rank of the lane, and the one 32 places behind.
struct Sample_in_lanes {
  Sampled_point item[2];
  std::uint32_t size;
  std::uint64_t hashes; // of both items

  CGAL_TANDEM_HD explicit Sample_in_lanes(const Shape_sample& sample) : item(), size(sample.size)
  {
    for(std::uint32_t k = 0; k < 2; ++k)
      if(place(k) < size)
        item[k] = sample.item[place(k)];
    hashes = std::uint64_t(item[1].hash) << 32 | item[0].hash;
  }

  CGAL_TANDEM_HD static std::uint32_t place(std::uint32_t k) { return 32 * k + Lane_group::rank(); }

  // The number of items of less hash, by bisection.
  CGAL_TANDEM_HD std::uint32_t below(std::uint32_t hash) const
  {
    std::uint32_t n = 0;
    for(std::uint32_t step = Shape_sample::capacity; step > 0; step /= 2) {
      const std::uint32_t last = n + step - 1;
      const std::uint64_t both = Lane_group::of_lane(hashes, last % 32);
      if(last < size && std::uint32_t(last < 32 ? both : both >> 32) < hash)
        n += step;
    }
    return n;
  }

  // Writes the items to their places in a merge with another sample; no two have one hash.
  CGAL_TANDEM_HD void write(const Sample_in_lanes& other, Shape_sample& merged) const
  {
    for(std::uint32_t k = 0; k < 2; ++k) {
      const std::uint32_t at = place(k) + other.below(item[k].hash);
      if(place(k) < size && at < Shape_sample::capacity)
        merged.item[at] = item[k];
    }
  }
};

// merge_sample() by 32 lanes.
CGAL_TANDEM_HD inline void merge_sample_by_group(Shape_sample& target, const Shape_sample& other)
{
  static_assert(Shape_sample::capacity == 64, "two items for each lane");
  const Sample_in_lanes a(target), b(other);
  Lane_group::sync(); // all have read
  a.write(b, target);
  b.write(a, target);
  const std::uint32_t both = a.size + b.size;
  Lane_group::single([&] { target.size = both < Shape_sample::capacity ? both : Shape_sample::capacity; });
}

// The least hashes of both.
CGAL_TANDEM_HD inline void merge_sample(Shape_sample& target, const Shape_sample& other)
{
  if(!has_least(target, other))
    return;
  if(Lane_group::size() > 1)
    return merge_sample_by_group(target, other);
  const std::uint32_t both = target.size + other.size;
  const std::uint32_t n = both < Shape_sample::capacity ? both : Shape_sample::capacity;
  std::uint32_t a = 0, b = 0; // how many of each are among the least n
  while(a + b < n)
    if(b == other.size || (a < target.size && target.item[a].hash < other.item[b].hash))
      ++a;
    else
      ++b;
  for(std::uint32_t i = n; b > 0;) // from the end, so that nothing is overwritten before it has been moved
    if(a > 0 && target.item[a - 1].hash > other.item[b - 1].hash)
      target.item[--i] = target.item[--a];
    else
      target.item[--i] = other.item[--b];
  target.size = n;
}

// Which ranks have the sample of a shape: that of its home, or all of them. A rank that has not has an empty one.
struct Sample_homes {
  static constexpr std::uint32_t all_ranks = no_index, none = no_index - 1; // none: it is a part of that of a union

  Own_items own;
  std::uint32_t* home; // by shape; null where there is one rank

  CGAL_TANDEM_HD bool is_everywhere(std::size_t s) const { return home == nullptr || home[s] == all_ranks; }
  CGAL_TANDEM_HD bool has(std::size_t s) const { return is_everywhere(s) || home[s] == own.rank; }

  // Whether this rank does the work of item i, which needs the sample of a shape, or those of a pair.
  CGAL_TANDEM_HD bool has_item(std::size_t i, std::size_t s) const
  {
    return is_everywhere(s) ? own.has(i) : home[s] == own.rank;
  }
  CGAL_TANDEM_HD bool has_pair(std::size_t i, std::size_t a, std::size_t b) const
  {
    return has_item(i, is_everywhere(a) ? b : a);
  }
};

// By id. Homes are empty where there is one rank.
template <class Backend>
struct Shape_samples {
  Buffer_of<Backend, Shape_sample> sample;
  Buffer_of<Backend, std::uint32_t> home;
};

// --- The samples of all shapes.

// A number of its own for each position in the cloud of all ranks: the finalizer of MurmurHash3, which is a bijection.
CGAL_TANDEM_HD inline std::uint32_t hash_of_position(std::uint32_t position)
{
  std::uint32_t h = position;
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

// Hashes up to this bound belong to about so many points of a shape. A bound of 0 takes none.
CGAL_TANDEM_HD inline std::uint32_t sample_bound(const Shape& shape, std::int64_t expected)
{
  const std::int64_t n = shape.moments.count;
  return n <= expected ? ~std::uint32_t(0) : std::uint32_t((expected << 32) / n);
}

template <class Predicate>
struct Bound_samples {
  const Shape* shape;
  Predicate is_sampled;
  std::int64_t expected;
  std::uint32_t* bound; // by shape

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    bound[id] = is_sampled(std::uint32_t(id)) ? sample_bound(shape[id], expected) : 0;
  }
};

// key: shape << 32 | hash.
struct Keyed_point {
  std::uint64_t key, level; // level: of its tolerance, wide, so that all bytes are defined
  Grid_point point;
};

// Of the points, each at the place of its surfel.
struct Take_sampled {
  Cloud_view cloud;
  const std::uint32_t* label;
  const std::uint32_t* bound; // by shape

  CGAL_TANDEM_HD bool has(std::uint32_t p) const
  {
    const std::uint32_t s = label[cloud.surfels.of_point(p)];
    const std::uint32_t most = s < first_mark ? bound[s] : 0;
    return most > 0 && hash_of_position(p + cloud.first_point) <= most;
  }
  CGAL_TANDEM_HD Keyed_point take(std::uint32_t p) const
  {
    const std::uint32_t i = cloud.surfels.of_point(p);
    return {std::uint64_t(label[i]) << 32 | hash_of_position(p + cloud.first_point), cloud.level_of(i), cloud.point[i]};
  }
};

template <class View>
struct Set_sample_key {
  const Keyed_point* keyed;
  View table;

  CGAL_TANDEM_HD void operator()(std::size_t at) const { table.set(at, keyed[at].key, std::uint32_t(at)); }
};

// Puts the points in order, and where those of each shape begin and end.
template <class View>
struct Put_sampled {
  View table;
  std::size_t size;
  const Keyed_point* keyed;
  Sampled_point* point;
  Range* range; // by shape

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint64_t s = table.key(at) >> 32;
    const Keyed_point& keyed_point = keyed[table.index(at)];
    point[at] = {std::uint32_t(table.key(at)), std::uint32_t(keyed_point.level), keyed_point.point};
    if(at == 0 || table.key(at - 1) >> 32 != s)
      range[s].first = std::uint32_t(at);
    if(at + 1 == size || table.key(at + 1) >> 32 != s)
      range[s].last = std::uint32_t(at + 1);
  }
};

// The sampled points of the shapes, shape by shape, by rising hash. Homes as in Shape_samples.
template <class Backend>
struct Sorted_samples {
  Buffer_of<Backend, Sampled_point> point;
  Buffer_of<Backend, Range> range; // these by shape
  Buffer_of<Backend, std::uint32_t> home;
};

// The homes of so many shapes: the only rank with sampled points of a shape, or all ranks. To the points of this rank
// come those of the others for the shapes that all ranks have.
template <class Backend>
std::vector<std::uint32_t> share_points(const Ranks<Backend>& ranks, std::size_t shapes,
                                        std::vector<Keyed_point>& points)
{
  constexpr std::uint64_t one = std::uint64_t(1) << 32;
  std::vector<std::uint64_t> found(shapes, 0); // how many ranks have points, and the sum of their numbers
  for(const Keyed_point& p : points)
    found[p.key >> 32] = one + ranks.own_items().rank;
  std::vector<std::uint32_t> home;
  for(const std::uint64_t f : ranks.total(std::move(found)))
    home.push_back(f / one == 1 ? std::uint32_t(f) : Sample_homes::all_ranks);
  const auto shared = std::partition(
    points.begin(), points.end(), [&](const Keyed_point& p) { return home[p.key >> 32] != Sample_homes::all_ranks; });
  const std::vector<Keyed_point> of_all = ranks.gather(std::vector<Keyed_point>(shared, points.end()));
  points.erase(shared, points.end());
  points.insert(points.end(), of_all.begin(), of_all.end());
  return home;
}

// About so many points of each shape with is_sampled(id), or all of them.
template <class Backend, class Predicate>
Sorted_samples<Backend> sorted_samples(Labeled_cloud<Backend>& points, const Shape_table<Backend>& shapes,
                                       Predicate is_sampled, std::int64_t expected)
{
  using View = typename Backend::Sort_table::View;
  Backend& backend = points.backend;
  Buffer_of<Backend, std::uint32_t> bound(shapes.size);
  for_each_shape(backend, shapes, Bound_samples<Predicate>{shapes.counted(), is_sampled, expected, bound.data()});
  auto keyed = backend.template collect<Keyed_point>(points.cloud.number_of_points(),
                                                     Take_sampled{points.cloud.view(), points.label(), bound.data()});
  Sorted_samples<Backend> samples;
  if constexpr(Ranks<Backend>::are_many) {
    std::vector<Keyed_point> needed = to_vector(backend, keyed);
    samples.home = to_buffer(backend, share_points(points.ranks, shapes.size, needed));
    keyed = to_buffer(backend, needed);
  }
  const std::size_t n = keyed.size();
  typename Backend::Sort_table table(n);
  backend.for_each(n, Set_sample_key<View>{keyed.data(), table.view()});
  backend.sort(table, 32 + bits_of(shapes.size)); // of the hash, and of the shape
  samples.point.reset(n);
  samples.range = filled_buffer(backend, shapes.size, Range());
  backend.for_each(n, Put_sampled<View>{table.view(), n, keyed.data(), samples.point.data(), samples.range.data()});
  return samples;
}

// Item by item of all samples.
struct Fill_sample {
  const Sampled_point* point;
  const Range* range; // by shape
  Shape_sample* sample;

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::size_t id = at / Shape_sample::capacity, i = at % Shape_sample::capacity;
    Shape_sample& s = sample[id];
    if(i == 0)
      s.size = range[id].size() < Shape_sample::capacity ? range[id].size() : Shape_sample::capacity;
    if(i < range[id].size())
      s.item[i] = point[range[id].first + i];
  }
};

// The points of least hash of each shape with is_sampled(id). About one and a half times as many are sorted, so that few
// shapes get less than a sample has room for.
template <class Backend, class Predicate>
Shape_samples<Backend> sample_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Predicate is_sampled)
{
  constexpr std::int64_t expected = Shape_sample::capacity * 3 / 2;
  Sorted_samples<Backend> sorted = sorted_samples(points, shapes, is_sampled, expected);
  Shape_samples<Backend> samples = {Buffer_of<Backend, Shape_sample>(shapes.size), std::move(sorted.home)};
  points.backend.for_each(shapes.size * Shape_sample::capacity,
                          Fill_sample{sorted.point.data(), sorted.range.data(), samples.sample.data()});
  return samples;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLES_H
