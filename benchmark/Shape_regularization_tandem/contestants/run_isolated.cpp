// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "run_isolated.h"
#include "Memory_file.h"

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <malloc.h>
#include <sys/time.h>
#include <sys/wait.h>

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

const char* const isolated_option = "--isolated";

void put(Memory_file& file, const Run& run)
{
  file.put(run.detection.label);
  file.put(run.detection.planes);
  file.put(run.normals);
  file.put(std::vector<double>{run.normal_seconds, run.detection_seconds, run.regularization_seconds, run.user});
  file.put(run.stages);
  file.put(run.hash);
  file.put(std::vector<std::size_t>{run.peak_bytes, run.engine_bytes, run.finished});
  file.put(run.error);
}

Run get_run(Memory_file& file)
{
  Run run;
  file.get(run.detection.label);
  file.get(run.detection.planes);
  file.get(run.normals);
  std::vector<double> seconds;
  file.get(seconds);
  run.normal_seconds = seconds.at(0);
  run.detection_seconds = seconds.at(1);
  run.regularization_seconds = seconds.at(2);
  run.user = seconds.at(3);
  file.get(run.stages);
  file.get(run.hash);
  std::vector<std::size_t> counts;
  file.get(counts);
  run.peak_bytes = counts.at(0);
  run.engine_bytes = counts.at(1);
  run.finished = counts.at(2) != 0;
  file.get(run.error);
  return run;
}

// f(member) for all of a task, in one order.
template <class Any_task, class F>
void for_each_member(Any_task& t, F f)
{
  f(t.maximum_distance), f(t.maximum_angle_deg), f(t.minimum_region_size), f(t.angle_tolerance_deg);
  f(t.maximum_offset), f(t.k_neighbors), f(t.cell_size), f(t.cluster_epsilon);
  f(t.threads), f(t.seed), f(t.estimates_normals);
  auto& p = t.engine;
  f(p.maximum_distance), f(p.maximum_angle), f(p.angle_tolerance), f(p.maximum_offset);
  f(p.minimum_region_size), f(p.k_neighbors), f(p.cell_size), f(p.regularity_period);
  f(p.simplicity), f(p.regularity), f(p.surfel_size);
  f(p.regularize_parallelism), f(p.regularize_orthogonality), f(p.regularize_coplanarity);
  f(p.fixed_directions), f(p.regularize_axis_symmetry), f(p.symmetry_direction);
}

void put(Memory_file& file, const Ply_cloud& cloud, const Task& task, const Run& base)
{
  for_each_member(task, [&](const auto& member) { file.put(member); });
  file.put(cloud.points);
  file.put(cloud.normals);
  put(file, base);
}

// Does not return, if it can be helped. Between fork and exec nothing may allocate: other threads may hold the heap.
void start_child(const char* const* arguments, double time_limit_seconds)
{
  double whole = 0;
  itimerval timer{};
  timer.it_value.tv_usec = suseconds_t(1e6 * std::modf(time_limit_seconds, &whole));
  timer.it_value.tv_sec = time_t(whole);
  setitimer(ITIMER_REAL, &timer, nullptr); // survives exec; SIGALRM ends the process
  execv("/proc/self/exe", const_cast<char* const*>(arguments));
  _exit(127);
}

std::string why(int status, double time_limit_seconds)
{
  if(WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    std::ostringstream text;
    text << "longer than " << time_limit_seconds << " s";
    return text.str();
  }
  if(WIFSIGNALED(status))
    return std::string("ended by a signal: ") + strsignal(WTERMSIG(status));
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

Run failed(const std::string& error)
{
  Run run;
  run.error = error;
  return run;
}

} // namespace

bool is_isolated_call(int argc, char** argv) { return argc == 5 && std::strcmp(argv[1], isolated_option) == 0; }

int isolated_main(char** argv)
{
  // What is freed goes back to the system at once: else the memory that held the cloud on its way here would be used
  // again, and what uses it would seem to need less.
  mallopt(M_MMAP_THRESHOLD, 128 * 1024);
  // If memory runs out, this process shall be the one to end.
  std::ofstream("/proc/self/oom_score_adj") << "1000";
  Memory_file in(std::atoi(argv[3])), out(std::atoi(argv[4]));
  Run run;
  try {
    const Contestant c = contestant(argv[2]);
    Task task;
    Ply_cloud cloud;
    for_each_member(task, [&](auto& member) { in.get(member); });
    in.get(cloud.points);
    in.get(cloud.normals);
    const Run base = get_run(in);
    if(!base.finished && !c.base.empty())
      run = c.run(cloud, task);
    else
      run = c.step(cloud, task, base);
  } catch(const std::exception& e) {
    run = failed(e.what());
  }
  put(out, run);
  return 0;
}

Run run_isolated(const Contestant& contestant, const Ply_cloud& cloud, const Task& task, double time_limit_seconds,
                 const Run* base)
{
  Memory_file in, out;
  put(in, cloud, task, base ? *base : Run());
  const std::string descriptors[2] = {std::to_string(in.descriptor()), std::to_string(out.descriptor())};
  const char* const arguments[] = {"tandem_benchmark",     isolated_option,        contestant.name.c_str(),
                                   descriptors[0].c_str(), descriptors[1].c_str(), nullptr};
  const pid_t child = fork();
  if(child < 0)
    throw std::runtime_error("no process can be started");
  if(child == 0)
    start_child(arguments, time_limit_seconds);
  int status = 0;
  while(waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if(!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return failed(why(status, time_limit_seconds));
  out.rewind();
  return get_run(out);
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
