// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The closed surface of --mesh, where its solver is there.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_SURFACE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_SURFACE_H

#include "testing/checks.h"

#include "mesh/mesh_methods.h"

#ifdef __unix__
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#endif

#include <cmath>
#include <stdexcept>
#include <string>

inline void check_surface(const program::Surface& surface, const std::string& name)
{
  CHECK_AT(program::is_closed(surface), name + ": an edge that is open");
  for(const auto& p : surface.points)
    CHECK_AT(std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()), name + ": a corner of the mesh");
}

// Returns whether there is one. A scene may have none: that is an exception, which says so, or an assertion of CGAL.
inline bool check_mesh(const program::Point_set& points, const program::Shapes& shapes, const std::string& name)
{
  constexpr std::size_t largest_number_of_planes = 8;
  const program::Mesh_input input =
    program::largest_planes(program::mesh_input(points, shapes), largest_number_of_planes);
  if(input.planes.size() < 4)
    return false;
  try {
    const program::Surface surface = program::polygonal_mesh(input, 1);
    check_surface(surface, name);
    return !surface.faces.empty();
  } catch(const std::runtime_error&) {
  } catch(const CGAL::Failure_exception&) {
  }
  return false;
}

// The same in a process of its own, which ends after some seconds: for some scenes CGAL does not.
inline bool check_mesh_apart(const program::Point_set& points, const program::Shapes& shapes, const std::string& name)
{
  if(!program::has_polygonal_mesh || shapes.number_of_coplanar_groups() < 4)
    return false;
#ifdef __unix__
  constexpr int is_made = 10, is_wrong = 20;
  const pid_t child = fork();
  if(child == 0) {
    const rlimit seconds = {10, 10};
    setrlimit(RLIMIT_CPU, &seconds);
    alarm(60); // it may wait for a lock that another thread had at the fork
    const int before = failures();
    const bool has_mesh = check_mesh(points, shapes, name);
    _exit(failures() > before ? is_wrong : has_mesh ? is_made : 0);
  }
  int status = 0;
  CHECK_AT(child > 0 && waitpid(child, &status, 0) == child, name);
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  const bool is_too_long = signal == SIGXCPU || signal == SIGKILL || signal == SIGALRM;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  CHECK_AT(is_too_long || code == 0 || code == is_made, name + ": the process of the mesh, " + std::to_string(code));
  return code == is_made;
#else
  return check_mesh(points, shapes, name);
#endif
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_CHECK_SURFACE_H
