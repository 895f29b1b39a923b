// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Misfits of planes, counted on samples of the points, against plain loops on several back ends.

#undef NDEBUG

#include "testing/body_fixture.h"

#include <CGAL/Tandem/internal/rounds/Misfit_counter.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <vector>

using namespace CGAL::Tandem::internal;

template <class Backend>
class Misfits {
public:
  Misfits(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    for(std::uint32_t parts : {1u, 3u, 16u})
      test_misfits(parts);
    test_misfit_counter(0);
    test_misfit_counter(Sample_memory<Backend>().large_cloud);
  }

private:
  // Some shapes have no sample, and some of those that have one are not tested.
  void test_misfits(std::uint32_t parts)
  {
    const std::vector<Plane> after = f_.moved_planes();
    std::vector<std::uint32_t> place_of, mask, query_of, expected; // by shape; by place; by place; by query
    std::vector<Misfit_query> query;
    for(std::uint32_t s = 0; s < after.size(); ++s) {
      const bool has_sample = s % 5 != 4, is_tested = s % 4 != 3;
      place_of.push_back(has_sample ? std::uint32_t(mask.size()) : no_index);
      if(!has_sample)
        continue;
      mask.push_back(s % 4 == 2 ? 3 : s % 4);
      query_of.push_back(is_tested ? std::uint32_t(query.size()) : no_index);
      if(is_tested)
        query.push_back({f_.plane[s], after[s]});
    }
    std::vector<std::uint32_t> place(f_.cloud.size, no_index); // of the points of the sample
    expected.resize(query.size(), 0);
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      const std::uint32_t s = f_.label[i], p = s < first_mark ? place_of[s] : no_index;
      if(p == no_index || (i & mask[p]) != 0)
        continue;
      place[i] = p;
      if(query_of[p] != no_index)
        expected[query_of[p]] += f_.fits(s, i) && !fits(after[s], f_.point[i], f_.tolerance);
    }
    std::vector<std::uint32_t> count(query.size(), 0);
    std::vector<Sample> sample(f_.cloud.size);
    const Cells_view view = f_.parts_view(parts);
    std::vector<Range> range(f_.cells.size() * parts);
    const auto expected_samples = std::uint32_t(place.size() - std::count(place.begin(), place.end(), no_index));
    for(Sample* memory : {static_cast<Sample*>(nullptr), sample.data()}) { // first they are only counted
      std::uint32_t samples = 0;
      backend_.template for_each_cell<Count_scratch>(
        range.size(), Collect_samples<Backend>{f_.cloud, view, f_.label.data(), place_of.data(), mask.data(), memory,
                                               &samples, range.data()});
      check_equal(samples, expected_samples, name_ + ": samples");
    }
    check_samples(view, place, sample, range);
    backend_.template for_each_cell<Count_scratch>(
      range.size(), Count_misfits<Backend>{view, sample.data(), range.data(), place_of.data(), query_of.data(),
                                           query.data(), count.data(), f_.tolerance});
    check_lists(count, expected, name_ + ": misfits");
    CHECK_AT(f_.cloud.size < 100 || std::count(count.begin(), count.end(), 0u) < long(count.size()),
             name_ + ": no misfits");
  }

  // Those of each part of a cell are in its range, in any order.
  void check_samples(const Cells_view& view, const std::vector<std::uint32_t>& place, const std::vector<Sample>& sample,
                     const std::vector<Range>& range)
  {
    using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t, std::uint32_t>;
    const auto key = [](const Grid_point& p, std::uint32_t place) { return Key(p.x, p.y, p.z, place); };
    for(std::uint32_t c = 0; c < range.size(); ++c) {
      std::multiset<Key> got, expected;
      for(std::uint32_t i = range[c].first; i < range[c].last; ++i)
        got.insert(key(sample[i].point, sample[i].place));
      for(std::uint32_t i = view[c].first; i < view[c].last; ++i)
        if(place[i] != no_index)
          expected.insert(key(f_.point[i], place[i]));
      CHECK_AT(got == expected, name_ + ": samples of part " + std::to_string(c));
    }
  }

  // Of the points of some shapes.
  std::size_t number_of_samples(const std::vector<Shape>& shape, const std::vector<std::uint32_t>& ids) const
  {
    std::size_t samples = 0;
    for(std::uint32_t s : ids)
      for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
        samples += f_.label[i] == s && (i & sample_mask(shape[s].moments.count)) == 0;
    return samples;
  }

  // Shapes with the points of their labels. Each second one may be tested; its plane is moved, unless it is every third
  // one of these. large: clouds of more points have memory for their samples only.
  void test_misfit_counter(std::size_t large)
  {
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    set_labels(points, f_.label);
    Options options = Options();
    options.maximum_distance = 2500;
    options.growth.tolerance = f_.tolerance;
    std::vector<Shape> shape = f_.shapes_of_labels(f_.plane.size());
    std::vector<std::uint32_t> id;
    std::vector<Regular_plane> candidate;
    std::vector<double> expected;
    for(std::uint32_t s = 0; s < shape.size(); ++s) {
      const Plane& p = f_.plane[s];
      shape[s].local = {{p.nx / normal_scale, p.ny / normal_scale, p.nz / normal_scale}, double(p.d) / normal_scale};
      if(s % 2 != 0 || !shape[s].is_live())
        continue;
      id.push_back(s);
      candidate.push_back(shape[s].local);
      candidate.back().offset += id.size() % 3 == 0 ? 0 : options.maximum_distance / 2;
      expected.push_back(share_of_misfits(s, shape[s], candidate.back()));
    }
    Shape_table<Backend> shapes = make_table(backend_, shape);
    const auto ids = to_buffer(backend_, id);
    const auto candidates = to_buffer(backend_, candidate);
    const auto shares = [&](Misfit_counter<Backend>& counter) {
      const auto share = counter.shares(shapes, ids, candidates);
      return to_vector(backend_, share);
    };
    require(points, shapes, tables::fits | tables::lists);
    for(std::size_t s = 0; s < shape.size(); ++s) // the planes of the test in place of fits
      shapes.table()[s].local = shape[s].local;
    Sample_memory<Backend> memory = {large};
    Misfit_counter<Backend> counter(points, shapes, options, ids, memory);
    check_lists(shares(counter), expected, name_ + ": shares of misfits");
    CHECK_AT(f_.cloud.size < 100 || std::count(expected.begin(), expected.end(), 0.) < long(id.size()),
             name_ + ": no share of misfits");
    check_equal(memory.sample.size(), large == 0 ? number_of_samples(shape, id) : f_.cloud.size,
                name_ + ": memory for samples");

    // Of nearly the same points the last share is taken; otherwise they are counted again.
    for(std::size_t i = 0; i < id.size(); ++i) {
      Misfit_record& last = shapes.table()[id[i]].history.last_misfits;
      const bool is_moved = (i + 1) % 3 != 0;
      check_equal(last.points, is_moved ? shape[id[i]].moments.count : 0, name_ + ": points of a record");
      last.misfit_share = .125;
      last.points += i % 2 == 0 ? 0 : 2 * last.points / tuning::verification::points_per_change + 1;
      expected[i] = is_moved && i % 2 == 0 ? .125 : expected[i];
    }
    check_lists(shares(counter), expected, name_ + ": shares of misfits that are known");
  }

  // Of the sample of a shape.
  double share_of_misfits(std::uint32_t s, const Shape& shape, const Regular_plane& candidate) const
  {
    std::uint32_t step = 1, misfits = 0; // positions of the sample are multiples
    while(shape.moments.count / (2 * step) >= tuning::verification::sample_size)
      step *= 2;
    const Plane before = rounded(shape.local), after = rounded(candidate);
    for(std::uint32_t i = 0; i < f_.cloud.size; i += step)
      misfits += f_.label[i] == s && fits(before, f_.point[i], f_.tolerance) && !fits(after, f_.point[i], f_.tolerance);
    return double(misfits) * step / double(shape.moments.count);
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

int main()
{
  test_on_all_backends<Misfits>();
  return report();
}
