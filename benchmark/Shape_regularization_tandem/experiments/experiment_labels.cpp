// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "clouds/labeled_frames.h"
#include "experiment_trials.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

// With given and with own normals.
void run_labels(const Experiment_options& options)
{
  Trials trials(options, "labels");
  std::vector<Labeled_frame> frames = labeled_frames();
  for(const Labeled_frame& scene : labeled_scenes())
    frames.push_back(scene);
  std::string group;
  for(const Labeled_frame& frame : frames) {
    if(options.is_quick && frame.group == group)
      continue;
    group = frame.group;
    const Named_cloud cloud = make_cloud(frame);
    for(const char* normals : {"given", "own"}) {
      Task task = cloud.task;
      task.threads = options.threads;
      task.estimates_normals = normals == std::string("own");
      for(const std::string& method : methods(options, {"tandem", "growing-cached", "ransac", "growing+regularize"}))
        trials.add(cloud, task, {method, {{"group", frame.group}}});
    }
    trials.write();
  }
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
