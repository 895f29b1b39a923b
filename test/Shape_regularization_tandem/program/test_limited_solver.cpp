// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The limit of the solver of --mesh is processor time: a process that has to wait does not lose any of it.

#include "testing/checks.h"

#include "mesh/Limited_solver.h"

#include <csignal>
#include <ctime>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

BOOST_AUTO_TEST_SUITE(test_limited_solver)

// Four equations of 40 binary variables, of which minutes find no solution.
void add_problem(program::Limited_solver& solver)
{
  using Solver = program::Limited_solver;
  unsigned random = 1;
  solver.create_objective(CGAL::Linear_objective<double>::MINIMIZE);
  std::vector<Solver::Variable*> variables;
  for(int i = 0; i < 40; ++i) {
    variables.push_back(solver.create_variable(Solver::Variable::BINARY));
    solver.objective()->add_coefficient(variables.back(), 1);
  }
  for(int row = 0; row < 4; ++row) {
    double sum = 0;
    std::vector<double> coefficients;
    for(std::size_t i = 0; i < variables.size(); ++i) {
      random = random * 1103515245 + 12345;
      coefficients.push_back(double(random >> 16 & 1023));
      sum += coefficients.back();
    }
    Solver::Linear_constraint* constraint = solver.create_constraint(double(int(sum / 2)), double(int(sum / 2)));
    for(std::size_t i = 0; i < variables.size(); ++i)
      constraint->add_coefficient(variables[i], coefficients[i]);
  }
}

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

// The exit code of the process that solves: 0 if it had its time, and ended by it.
int solve()
{
  program::Limited_solver solver;
  program::Limited_solver::seconds = 1;
  add_problem(solver);
  const double before = processor_seconds();
  const bool is_solved = solver.solve();
  const double used = processor_seconds() - before;
  std::fprintf(stderr, "%g seconds\n", used);
  return is_solved ? 2 : !program::Limited_solver::is_out_of_time ? 3 : used < 1 ? 4 : used > 5 ? 5 : 0;
}

BOOST_AUTO_TEST_CASE(all_cases)
{
  const pid_t solving = fork();
  if(solving == 0)
    _exit(solve());
  timespec moment = {0, 300000000}, wait = {2, 0};
  nanosleep(&moment, nullptr);
  kill(solving, SIGSTOP);
  nanosleep(&wait, nullptr);
  kill(solving, SIGCONT);
  int status = 0;
  CHECK(waitpid(solving, &status, 0) == solving);
  CHECK_AT(WIFEXITED(status) && WEXITSTATUS(status) == 0, std::to_string(WEXITSTATUS(status)));
}

BOOST_AUTO_TEST_SUITE_END()
