// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contestants in processes of their own: what they say comes back, and whatever
// they do to their process, the benchmark goes on.

#include "testing/checks.h"

#include "contestants/run_isolated.h"
#include "testing/measure.h"
#include "criteria/table.h"

#include <boost/test/unit_test.hpp>

#include <csignal>
#include <cstdlib>
#include <sys/resource.h>
#include <unistd.h>

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

// Says what arrived.
Run echo(const Ply_cloud& cloud, const Task& task, const Run& base)
{
  Run run;
  run.finished = true;
  run.detection = {{7, -1, std::int32_t(cloud.points.size())}, {{cloud.points.at(1), task.maximum_distance}}};
  run.normals = cloud.normals;
  run.normal_seconds = double(task.seed);
  run.detection_seconds = base.detection_seconds;
  run.regularization_seconds = double(base.detection.label.size());
  run.user = task.simplicity;
  run.stages.growth = 0.25;
  run.hash = base.hash + "+";
  run.engine_bytes = task.k_neighbors;
  return run;
}

Run spend_memory(const Ply_cloud&, const Task&, const Run&)
{
  std::vector<char> before(std::size_t(64) << 20, 1); // must not count
  before = std::vector<char>();
  Run run;
  Meter meter;
  {
    const std::vector<char> all(std::size_t(32) << 20, 1);
    run.hash = std::to_string(all[all.size() / 2]);
  }
  run.peak_bytes = meter.peak_bytes();
  run.finished = true;
  return run;
}

Run fall(const Ply_cloud&, const Task&, const Run&)
{
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  std::raise(SIGSEGV);
  return {};
}

Run wait_for_ever(const Ply_cloud&, const Task&, const Run&)
{
  for(;;)
    pause();
}

Run complain(const Ply_cloud&, const Task&, const Run&) { throw std::runtime_error("no, \"thanks\""); }

Contestant make(const std::string& name, Run (*step)(const Ply_cloud&, const Task&, const Run&),
                const std::string& base = "")
{
  Contestant c;
  c.name = name;
  c.base = base;
  c.step = step;
  c.run = [](const Ply_cloud&, const Task&) {
    Run run;
    run.finished = true;
    run.hash = "base was run";
    return run;
  };
  return c;
}

} // namespace

Contestant contestant(const std::string& name)
{
  for(const Contestant& c : {make("echo", echo), make("second", echo, "first"), make("memory", spend_memory),
                             make("fall", fall), make("wait", wait_for_ever), make("complain", complain)})
    if(c.name == name)
      return c;
  throw std::invalid_argument("there is no contestant " + name);
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

BOOST_AUTO_TEST_SUITE(processes)

using namespace CGAL::Tandem::benchmark;

// The main function is that of Boost.Test: what is started again is this, before.
[[gnu::constructor]] void run_child(int argc, char** argv)
{
  if(is_isolated_call(argc, argv))
    std::_Exit(isolated_main(argv));
}

const Ply_cloud cloud{{{1, 2, 3}, {4, 5, 6}}, {{0, 0, 1}, {0, 1, 0}}, {}, false};

BOOST_AUTO_TEST_CASE(what_comes_back)
{
  Task task;
  task.maximum_distance = 0.1;
  task.seed = 5;
  task.k_neighbors = 17;
  task.simplicity = 33;
  const Run run = run_isolated(contestant("echo"), cloud, task, 20);
  CHECK(run.finished && run.error.empty());
  BOOST_TEST((run.detection.label == std::vector<std::int32_t>{7, -1, 2}));
  CHECK(run.detection.planes.size() == 1 && run.detection.planes[0].normal.y == 5);
  BOOST_TEST(run.detection.planes[0].offset == 0.1);
  CHECK(run.normals.size() == 2 && run.normals[1].y == 1);
  CHECK(run.normal_seconds == 5 && run.user == 33 && run.stages.growth == 0.25);
  CHECK(run.engine_bytes == 17 && run.hash == "+");
}

// A given base is continued; without one it is run first.
BOOST_AUTO_TEST_CASE(base)
{
  Run base;
  base.finished = true;
  base.hash = "base";
  base.detection_seconds = 3;
  base.detection.label.assign(11, 0);
  const Run given = run_isolated(contestant("second"), cloud, Task(), 20, &base);
  CHECK(given.hash == "base+" && given.detection_seconds == 3 && given.regularization_seconds == 11);
  BOOST_TEST(run_isolated(contestant("second"), cloud, Task(), 20).hash == "base was run");
}

BOOST_AUTO_TEST_CASE(memory)
{
  const double mebibytes = double(run_isolated(contestant("memory"), cloud, Task(), 20).peak_bytes) / 1048576;
  CHECK(mebibytes > 31 && mebibytes < 40);
}

BOOST_AUTO_TEST_CASE(failures)
{
  const Run fallen = run_isolated(contestant("fall"), cloud, Task(), 20);
  CHECK(!fallen.finished && fallen.error.find("signal") != std::string::npos);
  const Run late = run_isolated(contestant("wait"), cloud, Task(), 0.2);
  CHECK(!late.finished && late.error.find("longer than") != std::string::npos);
  const Run unhappy = run_isolated(contestant("complain"), cloud, Task(), 20);
  CHECK(!unhappy.finished && unhappy.error == "no, \"thanks\"");
}

// What is written can be read, whatever the text.
BOOST_AUTO_TEST_CASE(table)
{
  const std::string path = "test_run_isolated.csv";
  write_csv(path, {{{"a", "1"}, {"b", "no, \"thanks\""}}, {{"c", "3"}, {"a", ""}}});
  const std::vector<Row> rows = read_csv(path);
  std::remove(path.c_str());
  CHECK(rows.size() == 2 && columns_of(rows) == (std::vector<std::string>{"a", "b", "c"}));
  CHECK(cell(rows[0], "b") == "no, \"thanks\"" && cell(rows[0], "c").empty());
  CHECK(cell(rows[1], "c") == "3" && cell(rows[1], "a").empty() && cell(rows[1], "d").empty());
}

BOOST_AUTO_TEST_SUITE_END()
