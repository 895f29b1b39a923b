// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Large planes take what they explain of smaller shapes: the bodies and the plan against naive versions on several back
// ends.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/finish/transfer_points.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::Tandem::internal;

// Each true face is shared among three shapes of unequal size, with planes that are moved or turned a little, and with
// wrong points among theirs. Plans as the manual says, by the points of the shapes instead of their moments.
class Slow_transfers {
public:
  static constexpr double epsilon = 2500;

  explicit Slow_transfers(const Fixture& f) : f_(f), label(f.label)
  {
    const std::uint32_t faces = std::uint32_t(f.plane.size());
    shape.resize(3 * faces);
    points_.resize(shape.size());
    for(std::uint32_t i = 0; i < label.size(); ++i)
      if(label[i] < first_mark) {
        label[i] += faces * (i % 7 < 4 ? 0 : i % 7 < 6 ? 1 : 2);
        shape[label[i]].moments.add(f.point[i], 1);
        points_[label[i]].push_back(i);
      }
    for(std::uint32_t s = 0; s < shape.size(); ++s) {
      Shape& own = shape[s];
      if(!own.is_live())
        continue;
      refit(own);
      const Plane& p = f.plane[s % faces];
      const Vector face = {p.nx / normal_scale, p.ny / normal_scale, p.nz / normal_scale};
      own.plane = s % 4 == 0 ? own.local : plane_through(face, own.scatter.centroid);
      own.plane.offset += s % 5 == 0 ? .7 * epsilon : s % 3 == 0 ? .2 * epsilon : 0;
      own.plane_number = s % 6 == 1 ? 3 : s % 6 == 2 ? int(s) : -1;
    }
    for(const Shape& s : shape)
      plane.push_back(rounded(s.plane));
    for(std::uint32_t a = 0; a < shape.size(); ++a)
      for(std::uint32_t b = a + 1; b < shape.size(); ++b)
        if((a % faces == b % faces || (a * 7 + b) % 11 == 0) && is_large(a) && is_large(b))
          link.push_back({std::uint64_t(a) << 32 | b, 5});
  }

  // By shape: where its points go, and whether it takes its local plane.
  std::vector<std::pair<std::uint32_t, bool>> plan(bool may_change) const
  {
    std::vector<std::vector<std::uint32_t>> takers(shape.size()); // by giving shape, by falling size
    std::vector<std::pair<std::uint32_t, bool>> result;
    for(std::uint32_t s = 0; s < shape.size(); ++s)
      result.emplace_back(s, false);
    std::vector<std::pair<std::size_t, std::size_t>> explained(shape.size()); // by its plane, and by the local one
    std::vector<char> takes(shape.size(), 0);
    for(const Link& l : link) {
      std::uint32_t s = l.first(), t = l.second();
      if(points_[s].size() < points_[t].size())
        std::swap(s, t);
      const bool have_one_plane = shape[s].plane_number >= 0 && shape[s].plane_number == shape[t].plane_number;
      if(have_one_plane || !(may_fit(t, shape[s].plane) || (may_change && may_fit(t, shape[s].local))))
        continue;
      takers[t].push_back(s);
      takes[s] = 1;
      explained[s].first += number_explained(t, shape[s].plane);
      explained[s].second += number_explained(t, shape[s].local);
    }
    for(std::uint32_t s = 0; s < shape.size(); ++s) {
      const std::size_t before = explained[s].first + number_fitting(s, shape[s].plane),
                        after = explained[s].second + number_fitting(s, shape[s].local);
      result[s].second =
        may_change && takes[s] && tuning::transfer::better_plane.is_exceeded(std::int64_t(after), std::int64_t(before));
    }
    for(std::uint32_t t = 0; t < shape.size(); ++t) {
      std::sort(takers[t].begin(), takers[t].end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::make_pair(points_[b].size(), a) < std::make_pair(points_[a].size(), b);
      });
      for(std::uint32_t s : takers[t])
        if(result[t].first == t && number_explained(t, result[s].second ? shape[s].local : shape[s].plane) > 0)
          result[t].first = s;
    }
    return result;
  }

private:
  bool is_large(std::uint32_t s) const { return shape[s].moments.count >= 10; }

  double distance(const Regular_plane& p, const Grid_point& q) const
  {
    return p.normal.x * q.x + p.normal.y * q.y + p.normal.z * q.z - p.offset;
  }

  // Mean and variance of the distances of the points.
  std::pair<double, double> distances(std::uint32_t t, const Regular_plane& p) const
  {
    double sum = 0, squares = 0;
    for(std::uint32_t i : points_[t])
      sum += distance(p, f_.point[i]);
    const double mean = sum / double(points_[t].size());
    for(std::uint32_t i : points_[t])
      squares += std::pow(distance(p, f_.point[i]) - mean, 2);
    return {mean, squares / double(points_[t].size())};
  }

  // By Cantelli's inequality, enough points may be within epsilon.
  bool may_fit(std::uint32_t t, const Regular_plane& p) const
  {
    const auto [mean, variance] = distances(t, p);
    const double beyond = std::fabs(mean) - epsilon;
    const tuning::Share share = tuning::transfer::explained_share;
    return beyond <= 0 ||
           double(share.denominator - share.numerator) * variance >= double(share.numerator) * beyond * beyond;
  }

  std::size_t number_fitting(std::uint32_t t, const Regular_plane& p) const
  {
    const Plane integer = rounded(p);
    return std::size_t(std::count_if(points_[t].begin(), points_[t].end(),
                                     [&](std::uint32_t i) { return fits(integer, f_.point[i], f_.tolerance); }));
  }

  // All that fit, if they are a large enough share of the shape, or of a layer.
  std::size_t number_explained(std::uint32_t t, const Regular_plane& p) const
  {
    const auto [mean, variance] = distances(t, p);
    using namespace tuning::transfer;
    const bool is_layer =
      std::fabs(mean) > layer_distance * epsilon && variance <= layer_variance * distances(t, shape[t].local).second;
    const std::size_t fitting = number_fitting(t, p);
    const tuning::Share share = is_layer ? layer_share : explained_share;
    return share.is_reached(std::int64_t(fitting), std::int64_t(points_[t].size())) ? fitting : 0;
  }

  const Fixture& f_;
  std::vector<std::vector<std::uint32_t>> points_; // by shape

public:
  std::vector<std::uint32_t> label;
  std::vector<Shape> shape;
  std::vector<Plane> plane;
  std::vector<Link> link;
};

template <class Backend>
class Transfer_bodies {
public:
  Transfer_bodies(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f)
  {}

  void run()
  {
    for(std::uint32_t parts : {1u, 3u, 16u})
      test_counts(parts);
    for(Planes planes : {Planes::are_fixed, Planes::may_change})
      test_plan(planes);
    test_transfer();
  }

private:
  std::uint32_t number_of_shapes() const { return std::uint32_t(f_.plane.size()); }

  // Shape s has s % 4 queries, with the planes of the shapes that follow. Cells are in parts.
  void test_counts(std::uint32_t parts)
  {
    std::vector<Range> queries_of;
    std::vector<Transfer_query> query;
    for(std::uint32_t s = 0; s < number_of_shapes(); ++s) {
      const std::uint32_t first = std::uint32_t(query.size());
      for(std::uint32_t q = 0; q < s % 4; ++q)
        query.push_back({s, 0, f_.plane[(s + q) % number_of_shapes()], f_.plane[(s + 2 * q + 1) % number_of_shapes()]});
      queries_of.push_back({first, std::uint32_t(query.size())});
    }
    for(bool counts_after : {false, true}) {
      std::vector<std::uint64_t> count(2 * query.size(), 0), expected(2 * query.size(), 0);
      for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
        if(f_.label[i] < first_mark)
          for(std::uint32_t q = queries_of[f_.label[i]].first; q < queries_of[f_.label[i]].last; ++q) {
            expected[2 * q] += fits(query[q].before, f_.point[i], f_.tolerance);
            expected[2 * q + 1] += counts_after && fits(query[q].after, f_.point[i], f_.tolerance);
          }
      backend_.template for_each_cell<Count_scratch>(
        f_.cells.size() * parts,
        Count_fitting<Backend>{f_.cloud, f_.parts_view(parts), f_.label.data(), queries_of.data(), query.data(),
                               count.data(), f_.tolerance, counts_after});
      check_lists(count, expected, name_ + ": points that fit the planes of queries");
    }
  }

  void test_plan(Planes planes)
  {
    const std::string where = name_ + (planes == Planes::may_change ? ", planes change" : ", planes are fixed");
    const Slow_transfers slow(f_);
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, slow.label);
    Shape_table<Backend> shapes = make_table(backend_, slow.shape);
    shapes.plane = to_buffer(backend_, slow.plane);
    shapes.set_fitted();
    require(points, shapes, tables::lists);
    Options options = Options();
    options.maximum_distance = slow.epsilon;
    options.growth.tolerance = f_.tolerance;
    const auto links = to_buffer(backend_, slow.link);
    const auto plan = Transfer_planner<Backend>(points, shapes, options, planes).plan(links);
    const auto expected = slow.plan(planes == Planes::may_change);
    std::size_t given = 0, changed = 0;
    for(std::size_t s = 0; s < expected.size(); ++s) {
      given += expected[s].first != s;
      changed += expected[s].second;
      if(!plan.is_any)
        continue;
      check_equal(plan.target[s], expected[s].first, where + ": target of shape " + std::to_string(s));
      check_equal(plan.is_changed[s] != 0, expected[s].second, where + ": plane of shape " + std::to_string(s));
    }
    check_equal(plan.is_any, given + changed > 0, where + ": whether there is any transfer");
    CHECK_AT(f_.cloud.size < 100 || (given > 2 && (changed > 2) == (planes == Planes::may_change)),
             where + ": " + std::to_string(given) + " transfers, " + std::to_string(changed) + " new planes");
  }

  // Every second shape gives to the next one, every third one has a new plane.
  void test_transfer()
  {
    std::vector<std::uint32_t> target, label = f_.label, expected = label;
    std::vector<std::uint8_t> is_changed, state(label.size(), interior_bit | tried_seed_bit);
    for(std::uint32_t s = 0; s < number_of_shapes(); ++s) {
      target.push_back(s % 2 == 0 ? s : (s + 1) % number_of_shapes());
      is_changed.push_back(s % 3 == 0);
    }
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = label[i];
      if(s < first_mark && f_.fits(target[s], i))
        expected[i] = target[s];
      else if(s < first_mark && is_changed[s] && !f_.fits(s, i))
        expected[i] = free_label;
    }
    backend_.for_each(
      f_.cloud.size,
      Transfer_point{
        f_.cloud, {label.data(), state.data()}, target.data(), is_changed.data(), f_.plane.data(), f_.tolerance});
    check_lists(label, expected, name_ + ": transfer");
    check_lists(state, std::vector<std::uint8_t>(label.size(), tried_seed_bit), name_ + ": states after a transfer");
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

int main()
{
  test_on_all_backends<Transfer_bodies>();
  return report();
}
