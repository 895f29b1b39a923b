// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the benchmark writes for its page: the table, above all that it marks every method that is better, and the
// colored clouds.

#undef NDEBUG

#define BOOST_TEST_MODULE benchmark_report
#include <boost/test/unit_test.hpp>

#include "report/Picture_book.h"
#include "report/comparison_table.h"
#include "report/view_files.h"

#include <cstdio>
#include <iterator>

using namespace CGAL::Tandem::benchmark;

namespace {

struct Made_up {
  const char *method, *is_cleaned;
  double seconds, coverage;
  int beyond;
};

Row row_of(const Made_up& m)
{
  Row row;
  append_cell(row, "cloud", "hut");
  append_cell(row, "method", m.method);
  append_cell(row, "description", std::string("the ") + m.method);
  append_cell(row, "cleaned", m.is_cleaned);
  append_cell(row, "finished", true);
  append_cell(row, "seconds", m.seconds);
  append_cell(row, "coverage", m.coverage);
  append_cell(row, "beyond_epsilon", m.beyond);
  append_cell(row, "points_relabeled", 0);
  return row;
}

const Detection two_planes{{0, 0, 0, 1, 1, -1}, {{{0, 0, 2}, 0}, {{1, 0, 0}, 0}}};

std::string bytes_of(const std::string& path)
{
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

} // namespace

BOOST_AUTO_TEST_CASE(better_methods_are_marked)
{
  const std::vector<Summary> all =
    summaries({row_of({"tandem", "false", 2, .8, 0}), row_of({"peer", "false", 3, .9, 7}),
               row_of({"peer", "true", 1, .7, 0}), row_of({"fast", "false", 1, .8, 0})});
  BOOST_REQUIRE_EQUAL(all.size(), 4u);
  std::vector<Row> rows;
  for(const Summary& summary : all)
    rows.push_back(summary_row(summary, all.front()));
  BOOST_TEST(cell(rows[0], "seconds") == "2.00");
  BOOST_TEST(cell(rows[0], "cover.%") == "80.0");
  BOOST_TEST(cell(rows[1], "description") == "the peer");
  BOOST_TEST(cell(rows[1], "seconds") == "3.00");
  BOOST_TEST(cell(rows[1], "cover.%") == "90.0*");
  BOOST_TEST(cell(rows[1], ">eps") == "7");
  BOOST_TEST(cell(rows[2], "seconds") == "-"); // a cleaned result was not run by itself
  BOOST_TEST(cell(rows[2], "cover.%") == "70.0");
  BOOST_TEST(cell(rows[3], "seconds") == "1.00*");
  BOOST_TEST(cell(rows[3], "cover.%") == "80.0");
  BOOST_TEST(cell(rows[3], "F1") == "-");
}

BOOST_AUTO_TEST_CASE(runs_are_summarized_by_their_median)
{
  const std::vector<Summary> all =
    summaries({row_of({"tandem", "false", 9, .8, 0}), row_of({"tandem", "false", 1, .8, 0}),
               row_of({"tandem", "false", 2, .8, 0}), row_of({"peer", "false", 3, .8, 0})});
  BOOST_REQUIRE_EQUAL(all.size(), 2u);
  BOOST_TEST(cell(summary_row(all[0], all[0]), "seconds") == "2.00");
  BOOST_TEST(cell(summary_row(all[0], all[0]), "again%") == "0.0");
  BOOST_TEST(cell(summary_row(all[1], all[0]), "seconds") == "3.00");
  BOOST_TEST(cell(summary_row(all[1], all[0]), "again%") == "-"); // it ran once
  Row failed = row_of({"peer", "false", 0, 0, 0});
  failed[4].second = "false";
  failed.emplace_back("error", "took too long");
  const Row row = summary_row(Summary(failed), all[0]);
  BOOST_TEST(cell(row, "error") == "took too long");
  BOOST_TEST(cell(row, "seconds") == "-");
}

BOOST_AUTO_TEST_CASE(colors_follow_the_points)
{
  const Detection renumbered{{1, 1, 1, 0, 0, 2}, {{{1, 0, 0}, 0}, {{0, 0, 1}, 0}, {{0, 1, 0}, 0}}};
  const std::vector<Color> a = colors_of(two_planes), b = colors_like(two_planes, renumbered);
  BOOST_TEST((b[1] == a[0]));
  BOOST_TEST((b[0] == a[1]));
  BOOST_TEST((b[2] != a[0] && b[2] != a[1]));
  for(std::size_t i = 0; i < 300; ++i)
    for(std::size_t j = 0; j < i; ++j)
      BOOST_REQUIRE_MESSAGE(color_of_index(i) != color_of_index(j), i << " and " << j << " look alike");
}

BOOST_AUTO_TEST_CASE(points_look_like_their_shapes)
{
  Ply_cloud cloud;
  cloud.points.assign(6, {0, 0, 0});
  cloud.normals.assign(6, {0, 1, 0});
  const Color red{255, 0, 0}, blue{0, 0, 255};
  const Ply_cloud picture = colored(cloud, two_planes, {red, blue});
  BOOST_TEST((picture.color[2] == red));
  BOOST_TEST((picture.color[3] == blue));
  BOOST_TEST((picture.color[5] != red && picture.color[5] != blue));
  BOOST_TEST(picture.normals[2].z == 1);
  BOOST_TEST(picture.normals[5].y == 1);
  BOOST_TEST(picture.label == two_planes.label, boost::test_tools::per_element());
  BOOST_TEST(subset(picture, 3).color.size() == 3u);
}

// As picture.gnuplot reads them: coordinates, normal, color, label of each point.
BOOST_AUTO_TEST_CASE(violations_are_black_in_the_file)
{
  Ply_cloud cloud;
  cloud.points = {{0, 0, 0}, {0, 0, 5}};
  cloud.normals.assign(2, {0, 0, 1});
  Picture_book book(cloud, {1, 20}, ".", "report_test");
  const Detection floor{{0, 0}, {{{0, 0, 1}, 0}}};
  book.add("one", floor);
  book.add("same", floor);
  const std::string bytes = bytes_of("report_test.one.ply");
  const std::size_t size = 6 * 4 + 3 + 4;
  BOOST_REQUIRE(bytes.size() > 2 * size);
  const std::string header = bytes.substr(0, bytes.size() - 2 * size);
  BOOST_TEST(header.substr(header.size() - 11) == "end_header\n");
  BOOST_TEST(header.find("nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty int label\n") !=
             std::string::npos);
  const Color first = colors_of(floor)[0];
  BOOST_TEST(bytes.substr(header.size() + 24, 3) == std::string(first.begin(), first.end()));
  BOOST_TEST(bytes.substr(header.size() + size + 24, 3) == std::string(3, char(20)));
  BOOST_TEST(bytes_of("report_test.same.ply").empty());
  BOOST_TEST(!bytes_of("report_test.input.ply").empty());
  std::remove("report_test.one.ply");
  std::remove("report_test.input.ply");
}

BOOST_AUTO_TEST_CASE(files_for_the_view_have_the_cloud_and_its_task)
{
  Task task;
  task.maximum_distance = .25;
  task.maximum_angle_deg = 20;
  task.minimum_region_size = 50;
  const std::string line = "--maximum-distance 0.25 --maximum-angle 20 --angle-tolerance 8 --maximum-offset 0.25 "
                           "--minimum-region-size 50 --k-neighbors 12 --cell-size 8192";
  const Ply_cloud cloud{{{1, 2, 1e-9}}, {{0, 0, 1}}, {7}, true};
  write_view_files(".", "viewed", cloud, task);
  BOOST_TEST(bytes_of("viewed.options") == line + "\n");
  const Ply_cloud back = read_ply("viewed.ply");
  BOOST_REQUIRE_EQUAL(back.points.size(), 1u);
  BOOST_TEST(back.points[0].z == 1e-9);
  BOOST_TEST(back.normals[0].z == 1);
  BOOST_TEST(!back.has_label());
  task.threads = 2;
  BOOST_TEST(program_options(task) == line + " --threads 2");
  std::remove("viewed.options");
  std::remove("viewed.ply");
}
