// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The samples of all shapes, in one pass over the points. Nothing else changes.

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLES_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLES_H

#include <CGAL/Tandem/internal/rounds/Shape_sample.h>
#include <CGAL/Tandem/internal/shapes/require.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// A number of its own for each position in the cloud of all ranks: the finalizer of MurmurHash3, which is a bijection.
CGAL_TANDEM_HD inline std::uint32_t hash_of_position(std::uint32_t position)
{
  std::uint32_t h = position;
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

// Of a shape, hashes up to this bound belong to about one and a half times as many points as its sample has.
struct Sample_bound {
  const Shape* shape;
  std::uint32_t* bound;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    constexpr std::int64_t expected = Shape_sample::capacity * 3 / 2;
    const std::int64_t n = shape[id].moments.count;
    bound[id] = n <= expected ? ~std::uint32_t(0) : std::uint32_t((expected << 32) / n);
  }
};

// key: shape << 32 | hash.
struct Keyed_point {
  std::uint64_t key;
  Grid_point point;
};

struct Take_sampled {
  Cloud_view cloud;
  const std::uint32_t* label;
  const std::uint32_t* bound; // by shape

  CGAL_TANDEM_HD bool has(std::uint32_t i) const
  {
    return label[i] < first_mark && hash_of_position(i + cloud.first) <= bound[label[i]];
  }
  CGAL_TANDEM_HD Keyed_point take(std::uint32_t i) const
  {
    return {std::uint64_t(label[i]) << 32 | hash_of_position(i + cloud.first), cloud.point[i]};
  }
};

template <class View>
struct Set_sample_key {
  const Keyed_point* keyed;
  View table;

  CGAL_TANDEM_HD void operator()(std::size_t at) const { table.set(at, keyed[at].key, std::uint32_t(at)); }
};

// Where the points of each shape begin in the sorted table.
template <class View>
struct Begin_sample {
  View table;
  std::uint32_t* begin; // by shape

  CGAL_TANDEM_HD void operator()(std::size_t at) const
  {
    const std::uint64_t s = table.key(at) >> 32;
    if(at == 0 || table.key(at - 1) >> 32 != s)
      begin[s] = std::uint32_t(at);
  }
};

template <class View>
struct Fill_sample {
  View table;
  std::size_t size;
  const std::uint32_t* begin; // no_index: no point
  const Keyed_point* keyed;
  Shape_sample* sample;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    Shape_sample& s = sample[id];
    s.size = 0;
    for(std::size_t at = begin[id]; at < size && s.size < Shape_sample::capacity && table.key(at) >> 32 == id; ++at)
      s.item[s.size++] = {std::uint32_t(table.key(at)), keyed[table.index(at)].point};
  }
};

template <class Backend>
Shape_samples<Backend> sample_shapes(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes)
{
  Backend& backend = points.backend;
  typename Backend::template Buffer<std::uint32_t> bound(shapes.size);
  for_each_shape(backend, shapes, Sample_bound{shapes.counted(), bound.data()});
  const auto keyed = collect_of_all<Keyed_point>(backend, points.ranks, points.cloud.size(),
                                                 Take_sampled{points.cloud.view(), points.label(), bound.data()});
  typename Backend::Sort_table table(keyed.size());
  using View = typename Backend::Sort_table::View;
  backend.for_each(keyed.size(), Set_sample_key<View>{keyed.data(), table.view()});
  backend.sort(table);
  auto begin = filled_buffer(backend, shapes.size, no_index);
  backend.for_each(keyed.size(), Begin_sample<View>{table.view(), begin.data()});
  Shape_samples<Backend> samples(shapes.size);
  for_each_shape(backend, shapes,
                 Fill_sample<View>{table.view(), keyed.size(), begin.data(), keyed.data(), samples.data()});
  return samples;
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_SHAPE_SAMPLES_H
