// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Splits against plain loops, on all back ends of the host: which shapes split, which planes their parts have, and what
// becomes of points, shapes and lists. test_split_scenes has shapes that have to split, and some that must not.

#include "testing/body_fixture.h"
#include "testing/host_backends.h"
#include "testing/same_bits.h"

#include <CGAL/Tandem/internal/rounds/split_shapes.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_split)

using namespace CGAL::Tandem::internal;

using Labels = std::vector<std::uint32_t>;
using Sample = std::vector<Sampled_point>;

bool is_same(const Plane& a, const Plane& b) { return a.nx == b.nx && a.ny == b.ny && a.nz == b.nz && a.d == b.d; }

struct Slow_split {
  std::uint32_t id;
  Split best;
  std::uint64_t cut; // links between both parts
  bool is_accepted;
};

// The definition, shape by shape.
class Slow_splits {
public:
  Slow_splits(const Fixture& f, const Labels& label, const Options& options, std::uint32_t first)
    : f_(f), label_(label), options_(options), gain_(options), first_(first)
  {}

  // Of all shapes that may split, by rising id.
  std::vector<Slow_split> find(const std::vector<Shape>& shape) const
  {
    std::vector<Slow_split> result;
    for(std::uint32_t id = 0; id < shape.size(); ++id) {
      if(!shape[id].is_live() || !gain_.may_split(shape[id]))
        continue;
      const Split best = best_of(shape[id], sample_of(shape[id], id));
      const std::uint64_t cut = best.gain > 0 ? links(id, best) : 0;
      const std::int64_t cost = std::int64_t(cut) * (Score::unit / 2) / f_.cloud.k; // half a point for all of a point
      result.push_back({id, best, cut, best.gain > cost});
    }
    return result;
  }

private:
  Sample sample_of(const Shape& shape, std::uint32_t id) const
  {
    Sample sample;
    for(std::uint32_t i = 0; i < label_.size(); ++i) {
      const std::uint32_t hash = hash_of_position(first_ + i);
      if(label_[i] == id && hash <= sample_bound(shape, Split_gain::sample_size))
        sample.push_back({hash, f_.level_of(i), f_.point[i]});
    }
    std::sort(sample.begin(), sample.end(), [](const auto& a, const auto& b) { return a.hash < b.hash; });
    return sample;
  }

  Split best_of(const Shape& shape, const Sample& sample) const
  {
    Split best;
    for(int start = 0; start < Split_gain::starts; ++start) {
      const Split split = gain_.trial(shape, {sample.data(), std::uint32_t(sample.size())}, start);
      if(split.gain > best.gain)
        best = split;
    }
    return best;
  }

  std::uint64_t links(std::uint32_t id, const Split& split) const
  {
    std::uint64_t result = 0;
    for(std::uint32_t i = 0; i < label_.size(); ++i)
      if(label_[i] == id)
        f_.for_each_neighbor(i, [&](std::uint32_t j) {
          result += label_[j] == id && is_nearer(split.second, split.first, f_.point[i]) !=
                                         is_nearer(split.second, split.first, f_.point[j]);
        });
    return result;
  }

  const Fixture& f_;
  const Labels& label_;
  Options options_;
  Split_gain gain_;
  std::uint32_t first_;
};

// Shapes that have the points of two or three faces of a scene, or of one.
template <class Backend>
class Splits {
public:
  Splits(Backend& backend, const std::string& name, const Fixture& f)
    : backend_(backend), name_(name), f_(f), options_(Options())
  {
    options_.score = Score(30, f.cloud.k);
    options_.minimum_region_size = 30;
    options_.maximum_distance = double(f.tolerance.distance) / normal_scale;
    options_.growth.tolerance = f.tolerance;
  }

  void run()
  {
    for(std::uint32_t first : {0u, 0xfffffff1u})
      for(std::uint32_t joined : {1u, 2u, 3u}) {
        label_ = f_.label;
        for(std::uint32_t& s : label_)
          s = s < first_mark ? s - s % joined : s;
        test(first, name_ + ", " + std::to_string(joined) + " faces");
      }
    if(f_.point.size() >= 1000)
      CHECK_AT(accepted_ > (f_.level.empty() ? 2 : 1) && refused_ > 0,
               name_ + ": " + std::to_string(accepted_) + " splits, " + std::to_string(refused_) + " refused");
  }

private:
  void test(std::uint32_t first, const std::string& where)
  {
    const std::vector<Shape> shape = make_shapes();
    const std::vector<Slow_split> expected = Slow_splits(f_, label_, options_, first).find(shape);
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    points.cloud.first = first;
    set_labels(points, label_, f_.state);
    Shape_table<Backend> shapes = start(shape);
    require(points, shapes, tables::fits | tables::lists);
    check_found(find_splits(points, shapes, options_), expected, where);
    split_shapes(points, shapes, options_);
    check_result(points, shapes, expected, where);
  }

  std::vector<Shape> make_shapes() const
  {
    std::vector<Shape> shape(f_.plane.size());
    for(std::uint32_t i = 0; i < label_.size(); ++i)
      if(label_[i] < first_mark) {
        shape[label_[i]].moments.add(f_.point[i], 1, f_.level_of(i));
        shape[label_[i]].box.add(f_.point[i]);
      }
    for(Shape& s : shape)
      if(s.is_live())
        refit(s);
    return shape;
  }

  // There is no room for more.
  Shape_table<Backend> start(const std::vector<Shape>& shape)
  {
    Shape_table<Backend> shapes = make_table(backend_, shape);
    shapes.plane = to_buffer(backend_, f_.plane);
    return shapes;
  }

  void check_found(const Found_splits<Backend>& found, const std::vector<Slow_split>& expected,
                   const std::string& where)
  {
    std::vector<std::uint32_t> id, accepted;
    for(std::size_t i = 0; i < expected.size(); ++i) {
      id.push_back(expected[i].id);
      if(expected[i].is_accepted)
        accepted.push_back(std::uint32_t(i));
      (expected[i].is_accepted ? accepted_ : refused_) += expected[i].best.gain > 0;
    }
    check_lists(to_vector(backend_, found.id), id, where + ": shapes that may split");
    check_lists(to_vector(backend_, found.accepted), accepted, where + ": shapes that split");
    for(std::size_t i = 0; i < expected.size() && i < found.id.size(); ++i) {
      const Split &got = found.split[i * Split_gain::starts], &best = expected[i].best;
      const std::string at = where + ", shape " + std::to_string(expected[i].id);
      check_equal(got.gain, best.gain, at + ": gain");
      CHECK_AT(best.gain == 0 || (is_same(got.first, best.first) && is_same(got.second, best.second)), at + ": planes");
    }
  }

  void check_result(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes,
                    const std::vector<Slow_split>& expected, const std::string& where)
  {
    Labels label = label_;
    std::size_t size = f_.plane.size();
    for(const Slow_split& s : expected) {
      if(!s.is_accepted)
        continue;
      for(std::uint32_t i = 0; i < label.size(); ++i)
        if(label[i] == s.id && is_nearer(s.best.second, s.best.first, f_.point[i]))
          label[i] = std::uint32_t(size);
      ++size;
    }
    check_equal(shapes.size, size, where + ": number of shapes");
    if(shapes.size != size)
      return;
    check_lists(to_vector(backend_, points.label(), label.size()), label, where + ": labels");
    std::size_t half = f_.plane.size();
    for(const Slow_split& s : expected)
      if(s.is_accepted)
        CHECK_AT(is_same(shapes.plane[s.id], s.best.first) && is_same(shapes.plane[half++], s.best.second),
                 where + ", shape " + std::to_string(s.id) + ": planes of the parts");
    check_tables(points, shapes, label, where);
  }

  // What follows from labels.
  void check_tables(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, const Labels& label,
                    const std::string& where)
  {
    std::vector<Fitted_moments> sum(shapes.size);
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark)
        sum[label[i]].moments.add(f_.point[i], 1, f_.level_of(i));
    CHECK_AT(shapes.has_moments(), where + ": moments have to be made again");
    require(points, shapes, tables::fits | tables::lists);
    for(std::uint32_t id = 0; id < shapes.size; ++id) {
      CHECK_AT(are_equal(shapes.fitted()[id].moments, sum[id].moments),
               where + ": moments of shape " + std::to_string(id));
      refit(sum[id]);
      CHECK_AT(sum[id].moments.count == 0 || CGAL::Tandem::internal::is_same(shapes.fitted()[id].local, sum[id].local),
               where + ": fit of shape " + std::to_string(id));
    }
    CHECK_AT(std::none_of(shapes.delta.begin(), shapes.delta.end(), is_any), where + ": deltas that stay");
    const std::vector<Cell_shapes> expected = f_.list_shapes(label);
    for(std::size_t c = 0; c < expected.size(); ++c) {
      const Cell_shapes &got = points.lists()[c], &e = expected[c];
      const bool is_listed = e.size <= Cell_shapes::capacity;
      check_equal(got.size <= Cell_shapes::capacity, is_listed,
                  where + ": whether cell " + std::to_string(c) + " is listed");
      CHECK_AT(!is_listed || shapes_of(got) == shapes_of(e), where + ": list of cell " + std::to_string(c));
    }
  }

  static std::set<std::uint32_t> shapes_of(const Cell_shapes& list)
  {
    return std::set<std::uint32_t>(list.shape, list.shape + (std::min)(list.size, Cell_shapes::capacity));
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
  Options options_;
  Labels label_;
  int accepted_ = 0, refused_ = 0;
};

BOOST_AUTO_TEST_CASE(all_cases)
{
  for(const Levels levels : {Levels::none, Levels::mixed})
    on_host_backends([&](auto backend, const std::string&) { test_on<Splits>(std::move(backend), levels); });
}

BOOST_AUTO_TEST_SUITE_END()
