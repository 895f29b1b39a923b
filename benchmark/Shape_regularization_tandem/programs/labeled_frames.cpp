// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tandem on generated clouds with true labels, with given and with its own normals: a line each, then means. Its CMake
// target has the same name. Without CMake, in the root of the repository:
//   cd benchmark/Shape_regularization_tandem && g++ -std=c++17 -O2 -DNDEBUG -DCGAL_EIGEN3_ENABLED -I. -I../../include
//     -I../../test/Shape_regularization_tandem -I/usr/include/eigen3 programs/labeled_frames.cpp
//     contestants/contestants_tandem.cpp clouds/{labeled_frames,frame_models,sensor,scene_normals}.cpp
//     ../../test/Shape_regularization_tandem/testing/scene*.cpp -o labeled_frames
//   labeled_frames [PART...]     only clouds whose group or name contains one of these texts

#include "clouds/labeled_frames.h"
#include "contestants/contestants.h"
#include "criteria/segmentation.h"

#include <cstdio>
#include <map>

using namespace CGAL::Tandem::benchmark;

namespace {

struct Values {
  static constexpr int size = 9;
  double value[size] = {};
  int count = 0;

  void add(const Values& other)
  {
    for(int i = 0; i < size; ++i)
      value[i] += other.value[i];
    ++count;
  }

  Values mean() const
  {
    Values result = *this;
    for(double& v : result.value)
      v /= count;
    return result;
  }
};

const char* const columns = "F.75  mIoU   prec   rec    over   under  shapes  F1.5   pprec";

void print(const std::string& name, const char* normals, const Values& v)
{
  std::printf("%-24s %-5s", name.c_str(), normals);
  for(int i = 0; i < Values::size; ++i)
    std::printf(i == 6 ? " %6.1f" : " %6.3f", v.value[i]);
  std::printf("\n");
  std::fflush(stdout);
}

Values judge(const Named_cloud& cloud, const Detection& detection)
{
  const std::size_t minimum = cloud.task.minimum_region_size;
  const Segmentation s = evaluate_segmentation(cloud.truth, detection, minimum);
  const Truth_criteria t = evaluate_truth(cloud.truth, detection, extent_of(cloud.cloud.points), minimum);
  return {{s.f, s.mean_iou, s.precision, s.recall, s.over_segmented, s.under_segmented, double(s.shapes), t.at_50.f1,
           t.point_precision}};
}

Detection detect(const Named_cloud& cloud, bool estimates_normals)
{
  Task task = cloud.task;
  task.estimates_normals = estimates_normals;
  return tandem_contestants().back().step(cloud.cloud, task, Run()).detection;
}

bool is_wanted(const Labeled_frame& frame, int argc, char** argv)
{
  for(int i = 1; i < argc; ++i)
    if((frame.group + " " + frame.name).find(argv[i]) != std::string::npos)
      return true;
  return argc == 1;
}

// Of each group, in the order of the groups, and the mean of these means.
void print_means(const std::vector<std::string>& groups, std::map<std::string, Values> (&sums)[2], const char* name)
{
  std::printf("\n%-30s  %s\n", name, columns);
  for(int own : {0, 1}) {
    Values all;
    for(const std::string& group : groups) {
      print(group, own ? "own" : "given", sums[own][group].mean());
      all.add(sums[own][group].mean());
    }
    print("MEAN OF GROUPS", own ? "own" : "given", all.mean());
  }
}

void run(const std::vector<Labeled_frame>& frames, const char* name, int argc, char** argv)
{
  std::map<std::string, Values> sums[2];
  std::vector<std::string> groups;
  std::printf("\n%-30s  %s\n", name, columns);
  for(const Labeled_frame& frame : frames) {
    if(!is_wanted(frame, argc, argv))
      continue;
    const Named_cloud cloud = make_cloud(frame);
    if(groups.empty() || groups.back() != frame.group)
      groups.push_back(frame.group);
    for(int own : {0, 1}) {
      const Values values = judge(cloud, detect(cloud, own));
      print(frame.name, own ? "own" : "given", values);
      sums[own][frame.group].add(values);
    }
  }
  if(!groups.empty())
    print_means(groups, sums, (std::string(name) + ", means").c_str());
}

// The share of the points of each face that are in the shape that has most of its points in it.
void run_layers(int argc, char** argv)
{
  std::map<std::string, std::pair<double, Values>> kept[2];
  for(const Labeled_frame& frame : labeled_layers()) {
    if(!is_wanted(frame, argc, argv))
      continue;
    const Named_cloud cloud = make_cloud(frame);
    for(int own : {0, 1}) {
      const Detection detection = detect(cloud, own);
      const Overlap overlap(cloud.truth, detection);
      auto& entry = kept[own].emplace(frame.group, std::make_pair(1., Values())).first->second;
      double right = 0, all = 0;
      for(std::size_t f = 0; f < overlap.faces; ++f) {
        std::size_t most = 0;
        for(std::size_t s = 0; s < overlap.shapes; ++s)
          if(overlap.main_face[s] == f)
            most = (std::max)(most, overlap.common(s, f));
        right += double(most);
        all += double(overlap.face_size[f]);
        entry.first = (std::min)(entry.first, double(most) / double(overlap.face_size[f]));
      }
      entry.second.add({{right / all, double(overlap.shapes)}});
    }
  }
  std::printf("\n%-30s  worst   mean kept  shapes (right: 5 strips, 4 boards)\n", "layers");
  for(int own : {0, 1})
    for(const auto& entry : kept[own])
      std::printf("%-24s %-5s %6.3f %6.3f %9.1f\n", entry.first.c_str(), own ? "own" : "given", entry.second.first,
                  entry.second.second.mean().value[0], entry.second.second.mean().value[1]);
}

} // namespace

int main(int argc, char** argv)
try {
  run(labeled_frames(), "labeled frames", argc, argv);
  run(labeled_scenes(), "scenes", argc, argv);
  run_layers(argc, argv);
  return 0;
} catch(const std::exception& e) {
  std::fprintf(stderr, "labeled_frames: %s\n", e.what());
  return 1;
}
