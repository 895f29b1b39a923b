// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metrics of plane segmentation on labelings of a few points that can be counted by hand.

#include "testing/checks.h"

#include "clouds/label_files.h"
#include "criteria/segmentation.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(test_segmentation)

using namespace CGAL::Tandem::benchmark;

using Labels = std::vector<std::int32_t>;

// So many points of each label, in turn.
Labels labels(const std::vector<std::pair<int, std::size_t>>& runs)
{
  Labels result;
  for(const auto& run : runs)
    result.insert(result.end(), run.second, run.first);
  return result;
}

Segmentation judge(const Labels& truth, const Labels& found, std::size_t smallest_face = 1)
{
  const auto number = [](const Labels& all) { return std::size_t(1 + *std::max_element(all.begin(), all.end())); };
  return evaluate_segmentation({truth, std::vector<Plane>(number(truth))}, {found, std::vector<Plane>(number(found))},
                               smallest_face);
}

BOOST_AUTO_TEST_CASE(equal_labels_are_perfect)
{
  const Labels truth = labels({{0, 10}, {-1, 3}, {1, 5}});
  const Segmentation s = judge(truth, labels({{1, 10}, {-1, 3}, {0, 5}}));
  BOOST_TEST(s.precision == 1);
  BOOST_TEST(s.recall == 1);
  BOOST_TEST(s.f == 1);
  BOOST_TEST(s.mean_iou == 1);
}

BOOST_AUTO_TEST_CASE(a_match_has_an_iou_of_three_quarters)
{
  // 9 of 12 points: .75. 8 of 11: .727.
  const Segmentation at = judge(labels({{0, 12}}), labels({{0, 9}, {-1, 3}}));
  BOOST_TEST(at.f == 1);
  BOOST_TEST(at.mean_iou == .75);
  const Segmentation below = judge(labels({{0, 11}}), labels({{0, 8}, {-1, 3}}));
  BOOST_TEST(below.f == 0);
  BOOST_TEST(below.mean_iou == 0);
}

BOOST_AUTO_TEST_CASE(precision_and_recall_count_shapes_and_faces)
{
  // Of three faces one is found exactly; another shape is on no face.
  const Segmentation s = judge(labels({{0, 8}, {1, 8}, {2, 8}, {-1, 4}}), labels({{0, 8}, {-1, 16}, {1, 4}}));
  BOOST_TEST(s.precision == .5);
  BOOST_TEST(s.recall == 1. / 3);
  BOOST_TEST(s.f == .4);
}

BOOST_AUTO_TEST_CASE(a_face_in_parts_is_over_segmented)
{
  const Segmentation s = judge(labels({{0, 10}, {1, 6}}), labels({{0, 5}, {1, 5}, {2, 6}}));
  BOOST_TEST(s.over_segmented == .5);
  BOOST_TEST(s.under_segmented == 0);
}

BOOST_AUTO_TEST_CASE(a_shape_over_faces_is_under_segmented)
{
  const Segmentation s = judge(labels({{0, 5}, {1, 5}, {2, 6}}), labels({{0, 10}, {1, 6}}));
  BOOST_TEST(s.under_segmented == .5);
  BOOST_TEST(s.over_segmented == 0);
}

BOOST_AUTO_TEST_CASE(small_faces_need_not_be_found)
{
  const Labels truth = labels({{0, 10}, {1, 2}});
  BOOST_TEST(judge(truth, labels({{0, 10}, {-1, 2}}), 3).recall == 1);
  BOOST_TEST(judge(truth, labels({{0, 10}, {-1, 2}}), 2).recall == .5);
  BOOST_TEST(judge(truth, labels({{0, 10}, {1, 2}}), 3).precision == 1);
}

BOOST_AUTO_TEST_CASE(nothing_found_is_zero)
{
  const Segmentation s = evaluate_segmentation({labels({{0, 5}}), std::vector<Plane>(1)}, {labels({{-1, 5}}), {}}, 1);
  BOOST_TEST(s.f == 0);
  BOOST_TEST(s.precision == 0);
}

// Numbers begin anywhere; 0 is a face only beside negative labels.
BOOST_AUTO_TEST_CASE(labels_and_points_are_read_from_text)
{
  const auto write = [](const char* path, const char* text) { std::ofstream(path) << text; };
  write("test_segmentation.txt", "7\n0\n3\n7\n");
  BOOST_TEST(read_text_labels("test_segmentation.txt") == (Labels{0, -1, 1, 0}));
  write("test_segmentation.txt", "7\n0\n-1\n7");
  BOOST_TEST(read_text_labels("test_segmentation.txt") == (Labels{0, 1, -1, 0}));
  write("test_segmentation.txt", "7\nwall\n");
  BOOST_CHECK_THROW(read_text_labels("test_segmentation.txt"), std::runtime_error);
  write("test_segmentation.txt", "# x y z\n0 0 1\n1 0 1\n\n0 1 1\n5 5 5\n");
  const Ply_cloud cloud = read_cloud("test_segmentation.txt");
  BOOST_TEST(cloud.points.size() == 4u);
  BOOST_TEST(!cloud.has_normals());
  const Truth truth = make_truth(cloud.points, {0, 0, 0, -1});
  BOOST_TEST(truth.faces.size() == 1u);
  BOOST_TEST(std::abs(truth.faces[0].normal.z) == 1, boost::test_tools::tolerance(1e-12));
  BOOST_CHECK_THROW(make_truth(cloud.points, {0, 0, 0}), std::runtime_error);
  write("test_segmentation.txt", "0 0 1 0 0 1\n1 0 1\n");
  BOOST_CHECK_THROW(read_cloud("test_segmentation.txt"), std::runtime_error);
  std::remove("test_segmentation.txt");
}

BOOST_AUTO_TEST_SUITE_END()
