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
  file.put(static_cast<const Run_costs&>(run));
  file.put(run.detection.label);
  file.put(run.detection.planes);
  file.put(run.normals);
  file.put(run.hash);
  file.put(run.error);
}

Run get_run(Memory_file& file)
{
  Run run;
  file.get(static_cast<Run_costs&>(run));
  file.get(run.detection.label);
  file.get(run.detection.planes);
  file.get(run.normals);
  file.get(run.hash);
  file.get(run.error);
  return run;
}

void put(Memory_file& file, const Ply_cloud& cloud, const Task& task, const Run& base)
{
  file.put(task);
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
    in.get(task);
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
