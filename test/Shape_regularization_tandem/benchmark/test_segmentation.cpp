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

std::size_t number_of(const Labels& labels) { return std::size_t(1 + *std::max_element(labels.begin(), labels.end())); }

BOOST_AUTO_TEST_CASE(labelings_counted_by_hand)
{
  struct Labeling {
    const char* name;
    Labels truth, found;
    std::size_t smallest_face;
    double precision, recall, f, mean_iou, over_segmented, under_segmented;
    double worst_kept, all_kept;
  };
  const Labeling labelings[] = {
    {"equal", labels({{0, 10}, {-1, 3}, {1, 5}}), labels({{1, 10}, {-1, 3}, {0, 5}}), 1, 1, 1, 1, 1, 0, 0, 1, 1},
    {"9 of 12 points", labels({{0, 12}}), labels({{0, 9}, {-1, 3}}), 1, 1, 1, 1, .75, 0, 0, .75, .75},
    {"8 of 11 points", labels({{0, 11}}), labels({{0, 8}, {-1, 3}}), 1, 0, 0, 0, 0, 0, 0, 8. / 11, 8. / 11},
    {"9 of 10 points", labels({{0, 10}}), labels({{0, 9}, {-1, 1}}), 1, 1, 1, 1, .9, 0, 0, .9, .9},
    {"17 of 19 points", labels({{0, 19}}), labels({{0, 17}, {-1, 2}}), 1, 1, 1, 1, 17. / 19, 0, 0, 17. / 19, 17. / 19},
    {"one of three faces, and a shape on none", labels({{0, 8}, {1, 8}, {2, 8}, {-1, 4}}),
     labels({{0, 8}, {-1, 16}, {1, 4}}), 1, .5, 1. / 3, .4, 1, 0, 0, 0, 1. / 3},
    {"a face in parts", labels({{0, 10}, {1, 6}}), labels({{0, 5}, {1, 5}, {2, 6}}), 1, 1. / 3, .5, .4, 1, .5, 0, .5,
     11. / 16},
    {"a shape over faces", labels({{0, 5}, {1, 5}, {2, 6}}), labels({{0, 10}, {1, 6}}), 1, .5, 1. / 3, .4, 1, 0, .5, 0,
     11. / 16},
    {"a face of which a crumb is left", labels({{0, 90}, {1, 10}}), labels({{0, 99}, {1, 1}}), 1, .5, .5, .5, 10. / 11,
     0, 0, .1, .91},
    {"a small face", labels({{0, 10}, {1, 2}}), labels({{0, 10}, {-1, 2}}), 3, 1, 1, 1, 1, 0, 0, 0, 5. / 6},
    {"a face just large enough", labels({{0, 10}, {1, 2}}), labels({{0, 10}, {-1, 2}}), 2, 1, .5, 2. / 3, 1, 0, 0, 0,
     5. / 6},
    {"a small face that is found", labels({{0, 10}, {1, 2}}), labels({{0, 10}, {1, 2}}), 3, 1, 1, 1, 1, 0, 0, 1, 1},
    {"nothing found", labels({{0, 5}}), labels({{-1, 5}}), 1, 0, 0, 0, 0, 0, 0, 0, 0}};
  for(const Labeling& l : labelings)
    BOOST_TEST_CONTEXT(l.name)
    {
      const Truth truth = {l.truth, std::vector<Plane>(number_of(l.truth))};
      const Detection detection = {l.found, std::vector<Plane>(number_of(l.found))};
      const Segmentation s = evaluate_segmentation(truth, detection, l.smallest_face);
      const Kept_faces kept = evaluate_kept(truth, detection);
      const double got[] = {s.precision,      s.recall,          s.f,        s.mean_iou,
                            s.over_segmented, s.under_segmented, kept.worst, kept.all};
      const double expected[] = {l.precision,      l.recall,          l.f,          l.mean_iou,
                                 l.over_segmented, l.under_segmented, l.worst_kept, l.all_kept};
      BOOST_TEST(got == expected, boost::test_tools::tolerance(1e-12) << boost::test_tools::per_element());
      BOOST_TEST(kept.is_right() == (l.worst_kept >= .9));
    }
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
