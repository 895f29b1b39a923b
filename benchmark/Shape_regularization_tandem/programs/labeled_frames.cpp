// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tandem on generated clouds with true labels, with given and with its own normals: a line each, then means.
//   labeled_frames [--csv FILE] [--simplicity MU] [--regularity RHO] [--contestant NAME] [PART...]
// only clouds whose group or name contains one of the PARTs. Another contestant: growing or ransac, say.
// Columns: F, mean IoU, precision and recall at an intersection over union of .75, over- and under-segmentation, number
// of shapes, F1 at .5, precision of points, ratio of the points in the ten largest shapes and faces
// (criteria/segmentation.h). Of walls: the scenes in which each face has a shape of its own, the ratio of a face in its
// main shape, of the worst face and of all.

#include "clouds/named_clouds.h"
#include "contestants/Contestant.h"
#include "criteria/judgement.h"

#include <cstdio>
#include <map>

using namespace CGAL::Tandem::benchmark;
namespace scenes = CGAL::Tandem::scenes;

namespace {

const std::vector<std::string> columns = {
  "segmentation_f", "mean_iou",   "segmentation_precision", "segmentation_recall", "over_segmented", "under_segmented",
  "shapes",         "face_f1_50", "point_precision",        "top_10_shapes",       "top_10_faces"};
// Of the file.
const char* const written_columns =
  "group cloud normals points shapes coverage mean_distance_in_epsilons degrees_of_freedom_relaxed planes_relaxed "
  "segmentation_f mean_iou segmentation_precision segmentation_recall over_segmented under_segmented "
  "top_10_shapes top_10_faces true_faces face_f1_50 point_precision angle_error_deg parallel_false_relaxed";
const char* const titles = "   F.75    mIoU    prec     rec    over   under  shapes    F1.5   pprec   top10   faces";

using Values = std::vector<double>;

Values mean(const std::vector<Values>& all)
{
  Values result(columns.size(), 0);
  for(std::size_t i = 0; i < result.size(); ++i) {
    for(const Values& values : all)
      result[i] += values[i];
    result[i] /= double(all.size());
  }
  return result;
}

const char* const kinds[] = {"given", "own"}; // of normals

class Judge {
public:
  // The task has the simplicity and the regularity.
  Judge(const Task& knobs, const std::string& contestant_name, const std::vector<std::string>& parts)
    : knobs_(knobs), contestant_(contestant(contestant_name)), parts_(parts)
  {}

  // Frames of a group follow each other.
  void judge(const std::string& title, const std::vector<scenes::Labeled_scene>& frames)
  {
    std::map<std::string, std::vector<Values>> all[2];
    std::vector<std::string> groups;
    std::printf("\n%-30s%s\n", title.c_str(), titles);
    for(const scenes::Labeled_scene& frame : frames) {
      if(!is_wanted(frame))
        continue;
      const Named_cloud cloud = make_cloud(frame);
      if(groups.empty() || groups.back() != frame.group)
        groups.push_back(frame.group);
      for(int own : {0, 1}) {
        rows_.push_back(row(frame, cloud, own));
        Values values;
        for(const std::string& column : columns)
          values.push_back(std::strtod(cell(rows_.back(), column).c_str(), nullptr));
        print(frame.name, kinds[own], values);
        all[own][frame.group].push_back(values);
      }
    }
    if(!groups.empty())
      print_means(title, groups, all);
  }

  void judge_walls()
  {
    std::map<std::string, std::vector<Kept_faces>> all;
    for(const scenes::Labeled_scene& wall : scenes::labeled_walls()) {
      if(!is_wanted(wall))
        continue;
      const Named_cloud cloud = make_cloud(wall);
      for(int own : {0, 1}) {
        const Kept_faces kept = evaluate_kept(cloud.truth, detect(cloud, own).detection);
        all[wall.group + " " + kinds[own]].push_back(kept);
        Row row = {{"group", wall.group}, {"cloud", wall.name}, {"normals", kinds[own]}};
        append_cell(row, "is_right", kept.is_right());
        append_cell(row, "worst_face_kept", kept.worst);
        append_cell(row, "mean_kept", kept.all);
        rows_.push_back(row);
      }
    }
    std::printf("\n%-30s  right  worst   kept\n", "walls");
    for(const auto& [group, kept] : all)
      print_kept(group, kept);
  }

  const std::vector<Row>& rows() const { return rows_; }

private:
  bool is_wanted(const scenes::Labeled_scene& frame) const
  {
    const std::string name = frame.group + " " + frame.name;
    return parts_.empty() || std::any_of(parts_.begin(), parts_.end(),
                                         [&](const std::string& part) { return name.find(part) != std::string::npos; });
  }

  Run detect(const Named_cloud& cloud, bool estimates_normals) const
  {
    Task task = cloud.task;
    task.simplicity = knobs_.simplicity;
    task.regularity = knobs_.regularity;
    task.estimates_normals = estimates_normals;
    return run(contestant_, cloud.cloud, task);
  }

  Row row(const scenes::Labeled_scene& frame, const Named_cloud& cloud, int own) const
  {
    Row all = {{"group", frame.group}, {"cloud", frame.name}, {"normals", kinds[own]}}, row;
    append_cell(all, "points", cloud.cloud.points.size());
    append_judgement(all, cloud, cloud.task, detect(cloud, own));
    std::istringstream columns(written_columns);
    for(std::string column; columns >> column;)
      row.emplace_back(column, cell(all, column));
    return row;
  }

  static void print(const std::string& name, const std::string& normals, const Values& values)
  {
    std::printf("%-24s %-5s", name.c_str(), normals.c_str());
    for(std::size_t i = 0; i < values.size(); ++i)
      std::printf(columns[i] == "shapes" ? " %7.1f" : " %7.3f", values[i]);
    std::printf("\n");
    std::fflush(stdout);
  }

  // Of each group, and of these.
  void print_means(const std::string& title, const std::vector<std::string>& groups,
                   std::map<std::string, std::vector<Values>> (&all)[2])
  {
    std::printf("\n%-30s%s\n", (title + ", means").c_str(), titles);
    for(int own : {0, 1}) {
      std::vector<Values> means;
      for(const std::string& group : groups) {
        means.push_back(mean(all[own][group]));
        print(group, kinds[own], means.back());
      }
      print("MEAN OF GROUPS", kinds[own], mean(means));
    }
  }

  static void print_kept(const std::string& group, const std::vector<Kept_faces>& all)
  {
    Kept_faces total;
    int right = 0;
    for(const Kept_faces& kept : all) {
      right += kept.is_right();
      total.worst = (std::min)(total.worst, kept.worst);
      total.all += kept.all / double(all.size());
    }
    std::printf("%-30s %3d/%zu %6.3f %6.3f\n", group.c_str(), right, all.size(), total.worst, total.all);
  }

  Task knobs_;
  Contestant contestant_;
  std::vector<std::string> parts_;
  std::vector<Row> rows_;
};

} // namespace

int main(int argc, char** argv)
try {
  std::vector<std::string> parts(argv + 1, argv + argc);
  std::string csv, contestant = "tandem-sequential";
  Task knobs;
  for(; parts.size() > 1 && parts[0].compare(0, 2, "--") == 0; parts.erase(parts.begin(), parts.begin() + 2)) {
    if(parts[0] == "--csv")
      csv = parts[1];
    else if(parts[0] == "--simplicity" || parts[0] == "--regularity")
      (parts[0] == "--simplicity" ? knobs.simplicity : knobs.regularity) = std::stod(parts[1]);
    else if(parts[0] == "--contestant")
      contestant = parts[1];
    else
      throw std::runtime_error("unknown option " + parts[0]);
  }
  Judge judge(knobs, contestant, parts);
  judge.judge("labeled frames", scenes::labeled_frames());
  judge.judge("scenes", scenes::labeled_scenes());
  judge.judge("scan lines", scenes::labeled_scan_lines());
  judge.judge_walls();
  if(!csv.empty())
    write_csv(csv, judge.rows());
  return 0;
} catch(const std::exception& e) {
  std::fprintf(stderr, "labeled_frames: %s\n", e.what());
  return 1;
}
