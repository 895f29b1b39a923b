// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What files of vertex groups have in them, read as other programs read it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_VG_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_VG_H

#include "testing/checks.h"

#include <array>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

struct Vg_group {
  double plane[4];
  std::vector<std::size_t> members;
};

struct Vg_file {
  std::vector<std::array<double, 3>> points, colors, normals;
  std::vector<Vg_group> groups;
};

// As the other programs read it: a key, then its values, all separated by white space.
inline void expect_key(std::istream& in, const char* key)
{
  std::string word;
  in >> word;
  CHECK_AT(word == std::string(key) + ":", "'" + word + "' instead of " + key);
}

template <class T>
T read_value(std::istream& in, const char* key)
{
  expect_key(in, key);
  T value = {};
  in >> value;
  return value;
}

std::vector<std::array<double, 3>> read_triples(std::istream& in, const char* key)
{
  std::vector<std::array<double, 3>> triples(read_value<std::size_t>(in, key));
  for(auto& triple : triples)
    in >> triple[0] >> triple[1] >> triple[2];
  return triples;
}

inline Vg_file read_vg(const std::string& text)
{
  std::istringstream in(text);
  Vg_file file;
  file.points = read_triples(in, "num_points");
  file.colors = read_triples(in, "num_colors");
  file.normals = read_triples(in, "num_normals");
  file.groups.resize(read_value<std::size_t>(in, "num_groups"));
  for(Vg_group& group : file.groups) {
    CHECK(read_value<int>(in, "group_type") == 0);
    CHECK(read_value<int>(in, "num_group_parameters") == 4);
    expect_key(in, "group_parameters");
    for(double& c : group.plane)
      in >> c;
    CHECK(!read_value<std::string>(in, "group_label").empty());
    expect_key(in, "group_color");
    for(int c = 0; c < 3; ++c) {
      double channel = -1;
      in >> channel;
      CHECK(channel >= 0 && channel <= 1);
    }
    group.members.resize(read_value<std::size_t>(in, "group_num_points"));
    for(std::size_t& i : group.members)
      in >> i;
    CHECK(read_value<int>(in, "num_children") == 0);
  }
  CHECK(bool(in));
  CHECK((in >> std::ws).eof());
  return file;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_WRITTEN_VG_H
