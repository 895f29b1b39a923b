// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The loops over values that have just been read, which vectorize: whether they are finite, null vectors, and bounds.
// Points that an engine takes while they are read, a piece at a time, come back as those that are read to the tables;
// and they are there when twins are told apart by them.

#include "testing/test_support.h"

#include <CGAL/Tandem/internal/cloud/import_cloud.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

BOOST_AUTO_TEST_SUITE(test_inspect_points)

using namespace CGAL::Tandem::internal;

// All that can be used, up to the largest and down to the smallest numbers, wherever it is among others.
template <class Value>
void test_values()
{
  using Limits = std::numeric_limits<Value>;
  const Value large = (Limits::max)(), small = Limits::denorm_min(), infinite = Limits::infinity();
  for(std::size_t points : {1, 2, 7, 8, 9, 40})
    for(std::size_t i = 0; i < 3 * points; ++i) {
      std::vector<Value> v(3 * points, Value(1));
      for(Value value : {large, -large, small, -small, Value(0)}) {
        v[i] = value;
        CHECK(are_finite(v.data(), v.size()) && !has_null(v.data(), v.size()));
        const Coordinate_box box = box_around(v.data(), v.size());
        for(std::size_t c = 0; c < 3; ++c) {
          const Value other = points > 1 || c != i % 3 ? Value(1) : value;
          CHECK(box.low[c] == double(c == i % 3 ? (std::min)(value, other) : other));
          CHECK(box.high[c] == double(c == i % 3 ? (std::max)(value, other) : other));
        }
      }
      for(Value value : {Limits::quiet_NaN(), infinite, -infinite}) {
        v[i] = value;
        CHECK(!are_finite(v.data(), v.size()));
      }
      std::fill_n(v.begin() + std::ptrdiff_t(i / 3 * 3), 3, Value(0));
      CHECK(has_null(v.data(), v.size()));
      v[i] = -small;
      CHECK(!has_null(v.data(), v.size()));
    }
}

BOOST_AUTO_TEST_CASE(values)
{
  test_values<float>();
  test_values<double>();
}

// What a device would hold, of coordinates and normals. Takes pieces of up to 1000 points.
struct Taken_values : Uploaded_values {
  std::vector<char> values[2];
  char* table[2];

  void download() override
  {
    for(int t = 0; t < 2; ++t)
      std::copy(values[t].begin(), values[t].end(), table[t]);
  }
};

struct Test_upload {
  struct Piece {
    std::size_t size;
    char* values;
  };

  void start(Vector_table& coordinates, Vector_table& normals, std::size_t n)
  {
    bytes = coordinates.vector_bytes();
    taken->table[0] = coordinates.bytes();
    taken->table[1] = normals.bytes();
    for(int t = 0; t < 2; ++t)
      taken->values[t].resize(taken->table[t] != nullptr ? n * bytes : 0);
  }

  Piece begin(std::size_t most)
  {
    const std::size_t size = (std::min)(most, std::size_t(1000));
    return {size, new char[2 * size * bytes]};
  }

  void end(const Piece& p, std::size_t first)
  {
    for(std::size_t t = 0; t < 2 && taken->table[t] != nullptr; ++t)
      std::copy_n(p.values + t * p.size * bytes, p.size * bytes, taken->values[t].data() + first * bytes);
    delete[] p.values;
  }

  std::shared_ptr<Uploaded_values> finish() { return taken; }

  std::shared_ptr<Taken_values> taken = std::make_shared<Taken_values>();
  std::size_t bytes = 0;
};

bool is_same(const Import& a, const Import& b)
{
  const auto is_same_vector = [](const Vector& v, const Vector& w) { return v.x == w.x && v.y == w.y && v.z == w.z; };
  bool is_same = a.count == b.count && a.item == b.item && a.has_normals == b.has_normals &&
                 a.number_of_ignored_coordinates == b.number_of_ignored_coordinates &&
                 a.number_of_ignored_normals == b.number_of_ignored_normals &&
                 std::equal(a.box.low, a.box.low + 3, b.box.low) && std::equal(a.box.high, a.box.high + 3, b.box.high);
  for(std::size_t i = 0; i < a.count && is_same; ++i)
    is_same =
      is_same_vector(a.position(i), b.position(i)) && (!a.has_normals || is_same_vector(a.normal(i), b.normal(i)));
  return is_same;
}

// Whether points are bad: they are noticed in the pieces, and only then the values are brought by the import itself.
template <class K, class NormalMap>
void test_pieces(const std::string& name, const Pairs<K>& cloud, bool has_bad_points)
{
  using Traits = CGAL::Tandem::Tandem_traits_3<K, Pairs<K>, First<K>, NormalMap, CGAL::Parallel_if_available_tag>;
  const Traits traits;
  auto backend = traits.backend();
  const Item_reader<Traits> reader(traits, First<K>(), typename Traits::Normal_map());
  const Import expected = read_points(backend, cloud, reader);
  Import in = read_points(backend, cloud, reader, Test_upload());
  CHECK_AT((in.uploaded == nullptr) == has_bad_points, name + ": where the values are");
  in.drop_upload();
  CHECK_AT(is_same(in, expected), name + ": other values");
  CHECK_AT((expected.count < cloud.size()) == has_bad_points, name + ": bad points");
}

template <class K>
void test_kernel(const std::string& name)
{
  using FT = typename K::FT;
  for(std::size_t n : {1, 999, 1001, 65536, 70000}) {
    Pairs<K> cloud = make_pairs<K>(make_box_cloud(12000));
    cloud.resize(n);
    const std::string what = name + ", " + std::to_string(n) + " points";
    test_pieces<K, Second<K>>(what, cloud, false);
    test_pieces<K, CGAL::Default>(what + " without normals", cloud, false);
    cloud.back().first = typename K::Point_3(FT(0), FT(std::nan("")), FT(0));
    cloud[n / 2].second = typename K::Vector_3(FT(0), FT(0), FT(0));
    test_pieces<K, Second<K>>(what + ", some bad", cloud, true);
  }
}

BOOST_AUTO_TEST_CASE(pieces)
{
  test_kernel<CGAL::Simple_cartesian<double>>("double");
  test_kernel<CGAL::Simple_cartesian<float>>("float");
}

// The values are fetched once, before the first comparison, and only if there are twins.
void test_twins(std::vector<Grid_point> points, int expected)
{
  Sequential_backend backend;
  int prepared = 0, early = 0, questions = 0;
  sort_along_curve(backend, {points.data(), points.size()}, make_code_frame(points.data(), points.size()),
                   make_tie_order(
                     [&](std::uint32_t i, std::uint32_t j) {
                       early += prepared == 0;
                       ++questions;
                       return j < i;
                     },
                     [&] { ++prepared; }));
  const std::string name = std::to_string(points.size()) + " points";
  CHECK_AT(prepared == expected && early == 0, name + ": prepared " + std::to_string(prepared) + " times");
  CHECK_AT((questions > 0) == (expected > 0), name + ": " + std::to_string(questions) + " questions");
}

BOOST_AUTO_TEST_CASE(twins)
{
  test_twins({}, 0);
  test_twins({{0, 0, 0, 7}, {0, 0, 1, 7}, {9, 0, 0, 7}}, 0);
  test_twins({{0, 0, 0, 7}, {5, 0, 0, 7}, {0, 0, 0, 8}}, 0);
  test_twins({{0, 0, 0, 7}, {5, 0, 0, 7}, {0, 0, 0, 7}, {5, 0, 0, 7}}, 1);
}

BOOST_AUTO_TEST_SUITE_END()
