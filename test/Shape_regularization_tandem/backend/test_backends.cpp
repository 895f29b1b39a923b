// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps before and after the loop, and the searches of blocks, against naive versions on several back ends.

#include "testing/backend_operations.h"
#include "testing/block_searches.h"
#include "testing/host_backends.h"

#include <CGAL/Tandem/internal/result/extract_shapes.h>

BOOST_AUTO_TEST_SUITE(test_backends)

using namespace CGAL::Tandem::internal;

template <class Backend>
class Backend_steps {
public:
  Backend_steps(Backend& backend, const std::string& name, const Fixture& f) : backend_(backend), name_(name), f_(f) {}

  void run()
  {
    test_searches();
    test_order();
    test_border();
    test_deltas();
    test_component_sizes();
    test_exact_check();
    test_measures();
    test_groups();
  }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  void test_searches()
  {
    for(std::uint32_t start : search_starts)
      for(std::uint32_t most : search_sizes)
        CHECK_AT(count_wrong_searches(backend_, start, most) == 0,
                 name_ + ": searches from " + std::to_string(start) + " on for " + std::to_string(most) + " items");
  }

  // Many points of one code: each point 1 to 4 times, and the points between far outliers.
  void test_order()
  {
    std::vector<Grid_point> point;
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i)
      point.insert(point.end(), 1 + i % 4, f_.point[i]);
    point.push_back({1 << 28, 1 << 28, 1 << 28, no_normal});
    point.push_back({-(1 << 28), -(1 << 28), -(1 << 28), no_normal});
    const Code_frame frame = make_code_frame(point.data(), point.size());
    std::vector<std::uint32_t> expected(point.size()), got;
    for(std::uint32_t i = 0; i < expected.size(); ++i)
      expected[i] = i;
    auto key = [&](std::uint32_t i) {
      const Grid_point& p = point[i]; // equal points: the last one first
      return std::make_tuple(frame.code(p), frame.code_inside(p), p.x, p.y, p.z, p.normal, ~i);
    };
    std::sort(expected.begin(), expected.end(), [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
    const auto order =
      sort_along_curve(backend_, {point.data(), point.size()}, frame,
                       make_tie_order([](std::uint32_t i, std::uint32_t j) { return i > j; }, Nothing()));
    for(std::size_t i = 0; i < order.size(); ++i)
      got.push_back(order.view().index(i));
    check_lists(got, expected, name_ + ": order along the curve");
    test_cells(order, frame);
  }

  template <class Table>
  void test_cells(const Table& order, const Code_frame& frame)
  {
    Sequential_backend sequential;
    Host_sort_table copy(order.size());
    for(std::size_t i = 0; i < order.size(); ++i)
      copy.view().set(i, order.view().key(i), order.view().index(i));
    for(std::size_t size : {std::size_t(64), std::size_t(700)}) {
      const std::vector<Range> got = split_cells(backend_, order, frame, size),
                               expected = split_cells(sequential, copy, frame, size);
      CHECK_AT(got.size() == expected.size() &&
                 std::equal(got.begin(), got.end(), expected.begin(),
                            [](const Range& a, const Range& b) { return a.first == b.first && a.last == b.last; }),
               name_ + ": cells of " + std::to_string(size));
    }
  }

  void test_border()
  {
    std::vector<std::uint32_t> expected;
    for(const Range& cell : f_.cells)
      for(std::uint32_t i = cell.first; i < cell.last; ++i) {
        bool is_at_border = false;
        f_.for_each_neighbor(i, [&](std::uint32_t q) { is_at_border |= q < cell.first || q >= cell.last; });
        if(is_at_border)
          expected.push_back(i);
      }
    Labeled_cloud<Backend> points(backend_);
    take_cloud(f_, points);
    find_border(points);
    const auto& border = points.border;
    check_lists(to_vector(backend_, border.point), expected, name_ + ": border");
    for(std::size_t c = 0; c < f_.cells.size(); ++c)
      for(std::uint32_t b = border.range[c].first; b < border.range[c].last; ++b)
        CHECK_AT(border.point[b] >= f_.cells[c].first && border.point[b] < f_.cells[c].last,
                 name_ + ": border of a cell");
    CHECK_AT(border.range[f_.cells.size() - 1].last == expected.size(), name_ + ": border of the last cell");
  }

  // Twice: what has been added to the shapes is zero again.
  void test_deltas()
  {
    Shape_table<Backend> shapes;
    shapes.size = f_.plane.size() + 5;
    shapes.table() = filled_buffer(backend_, shapes.size, Shape());
    std::vector<Shared_moments> expected(shapes.size);
    for(int pass = 0; pass < 2; ++pass) {
      const std::string where = name_ + ": deltas of pass " + std::to_string(pass);
      std::vector<char> is_any_expected(shapes.size, 0);
      for(Shape& shape : shapes.table())
        shape.history.set_fitted(true);
      Shared_moments* sums = start_deltas(backend_, shapes, shapes.size);
      for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
        const std::uint32_t s = f_.label[i];
        if(s >= first_mark || (pass == 1 && s % 3 == 0))
          continue;
        is_any_expected[s] = 1;
        add_point(sums[s], f_.point[i], -1);
        add_point(expected[s], f_.point[i], -1);
      }
      CHECK_AT(std::count(is_any_expected.begin(), is_any_expected.end(), 1) > 0, where + ": there are none");
      add_deltas(backend_, shapes);
      for(const Shared_moments& sum : shapes.delta)
        CHECK_AT(!is_any(sum), where + ", added");
      std::vector<Shared_moments> got(shapes.size);
      for(std::size_t s = 0; s < shapes.size; ++s) {
        atomic_add<Sequential_backend>(got[s], shapes.table()[s].moments, shapes.table()[s].box);
        CHECK_AT(shapes.table()[s].history.is_fitted() == (is_any_expected[s] == 0), where + ": shapes to be fitted");
      }
      check_moments(got, expected, where);
    }
    const std::size_t more = 2 * shapes.delta.size();
    const Shared_moments* const sums = start_deltas(backend_, shapes, more);
    CHECK_AT(shapes.delta.size() >= more, name_ + ": room for deltas");
    CHECK_AT(std::none_of(sums, sums + more, is_any), name_ + ": deltas that are not zero");
  }

  void test_component_sizes()
  {
    const std::uint32_t n = f_.cloud.size;
    std::vector<std::uint32_t> component(n), size(n, 0), expected(n, 0);
    for(std::uint32_t i = 0; i < n; ++i) {
      component[i] = i - i % (1 + i / 16 % 32); // more roots in a cell than its table has slots
      if(f_.label[i] < first_mark)
        ++expected[component[i]];
    }
    backend_.template for_each_cell<Count_scratch>(
      f_.cells.size(), Count_components<Backend>{f_.cells.data(), labels_of_points(), component.data(), size.data()});
    check_lists(size, expected, name_ + ": sizes of components");
  }

  Labels_of_points labels_of_points() const { return {f_.cloud.surfels, f_.label.data(), nullptr}; }

  // Points that the integers leave open are decided by the caller's coordinates.
  void test_exact_check()
  {
    const std::uint32_t n = f_.cloud.size;
    const Tolerance certain = {f_.tolerance.distance / 2, f_.tolerance.squared_cosine};
    const Exact_bounds bounds = {1200, 0};
    std::vector<CGAL::Tandem::Coefficients> plane;
    for(const Plane& p : f_.plane)
      plane.push_back({double(p.nx) / normal_scale, double(p.ny) / normal_scale, double(p.nz) / normal_scale,
                       double(p.d) / normal_scale});
    std::vector<double> coordinates(3 * std::size_t(n)), normals(coordinates.size(), 1);
    std::vector<std::uint32_t> origin(n), label = f_.label, expected = label;
    const std::vector<std::uint8_t> level = f_.mixed_levels();
    std::size_t rejected = 0;
    for(std::uint32_t i = 0; i < n; ++i) {
      origin[i] = n - 1 - i;
      const double p[3] = {double(f_.point[i].x), double(f_.point[i].y), double(f_.point[i].z)};
      std::copy(p, p + 3, &coordinates[3 * std::size_t(origin[i])]);
      if(label[i] < first_mark && !fits(f_.plane[label[i]], f_.point[i], certain.at(level[i])) &&
         !bounds.is_near(plane[label[i]], {p[0], p[1], p[2]}, level[i])) {
        expected[i] = locked_label;
        ++rejected;
      }
    }
    const Surfels_view points = {f_.point.data(), nullptr, nullptr, level.data()};
    check_exactly(backend_, {points, origin.data(), label.data(), n}, f_.plane.data(), certain,
                  {{{coordinates.data(), false}, {normals.data(), false}}, plane.data(), bounds});
    check_lists(label, expected, name_ + ": exact check");
    CHECK_AT(rejected > 20 || n < 100, name_ + ": " + std::to_string(rejected) + " points rejected");
  }

  // Every second label is a shape, all others are left out. Some points are farther away than epsilon.
  void test_measures()
  {
    const std::uint32_t n = f_.cloud.size;
    const std::size_t labels = f_.plane.size();
    std::vector<std::uint32_t> shape(n, no_index);
    std::vector<std::uint64_t> opposed(labels, 0), sums(labels), found(Point_measures::size, 0);
    std::vector<std::uint64_t> expected(Point_measures::size, 0);
    const std::vector<std::uint8_t> level = f_.mixed_levels();
    for(std::uint32_t i = 0; i < n; ++i)
      if(f_.label[i] < first_mark && f_.label[i] % 2 == 0)
        shape[i] = f_.label[i];
    for(std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t label = shape[i];
      for(int j = 0; j < f_.cloud.k && f_.cloud.row(i)[j] != no_index; ++j) {
        const std::uint32_t other = shape[f_.cloud.row(i)[j]];
        if(other != label)
          ++expected[label == no_index || other == no_index ? Point_measures::free_links : Point_measures::links];
      }
      if(label == no_index)
        continue;
      const double units = double(Score_item::tolerance_units), exact = double(f_.distance(label, i));
      const auto share = [&](const Tolerance& t) {
        return std::floor((std::min)(exact / double(t.distance), 1.) * units + .5);
      };
      const double own = share(f_.tolerance.at(level[i]));
      expected[Point_measures::distance] += std::uint64_t(share(f_.tolerance));
      expected[Point_measures::fit] += std::uint64_t(4096 - std::floor(4096 * own * own / units / units + .5));
      const Int_vector m = decode_normal(f_.point[i].normal);
      sums[label] +=
        double(f_.plane[label].nx) * m.x + double(f_.plane[label].ny) * m.y + double(f_.plane[label].nz) * m.z < 0;
    }
    Cloud_view cloud = f_.cloud;
    cloud.surfels.level = level.data();
    const Measure_points<Backend> body = {cloud,        f_.cells.data(), labels_of_points(), f_.plane.data(),
                                          shape.data(), f_.tolerance,    opposed.data(),     found.data()};
    backend_.template for_each_cell<Measure_scratch>(f_.cells.size(), body);
    check_lists(opposed, sums, name_ + ": opposed normals");
    check_lists(found, expected, name_ + ": distances, fit, and links");
  }

  // Labels that are no shapes are left out.
  void test_groups()
  {
    const std::size_t shapes = f_.plane.size() - 1;
    std::vector<std::int32_t> shape_of;
    std::vector<std::vector<std::uint32_t>> expected(shapes);
    for(std::uint32_t i = 0; i < f_.cloud.size; ++i) {
      shape_of.push_back(f_.label[i] < first_mark ? std::int32_t(f_.label[i]) : -1);
      if(f_.label[i] < shapes)
        expected[f_.label[i]].push_back(i);
    }
    const auto groups = group_points(backend_, shape_of.data(), shape_of.size(), shapes);
    for(std::size_t s = 0; s < shapes; ++s)
      check_lists(std::vector<std::uint32_t>(groups.position.begin() + groups.first[s],
                                             groups.position.begin() + groups.first[s + 1]),
                  expected[s], name_ + ": points of shape " + std::to_string(s));
    CHECK_AT(groups.position.size() == groups.first[shapes], name_);
  }

  Backend& backend_;
  const std::string name_;
  const Fixture& f_;
};

BOOST_AUTO_TEST_CASE(all_cases)
{
  on_host_backends([](auto backend, const std::string& name) {
    for(const std::string& wrong : Backend_operations<decltype(backend)>(backend).run())
      CHECK_AT(false, name + ": " + wrong);
  });
  test_on_all_backends<Backend_steps>();
  test_on<Backend_steps>(Reverse_backend());
}

BOOST_AUTO_TEST_SUITE_END()
