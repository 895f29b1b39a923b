// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// In which many processes are compared with one: scenes, random cases, and clouds at the border of what there can be.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_CASES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_CASES_H

#include "border_clouds.h"
#include "mpi_support.h"

const Deal deals[] = {Deal::blocks, Deal::random, Deal::reversed};

inline Parameters with_cells(Parameters parameters, std::size_t cell_size)
{
  parameters.cell_size = cell_size;
  return parameters;
}

// Every scene, with and without normals. Options change from scene to scene, and the points are elsewhere for each number
// of ranks.
inline std::vector<Dealt_case> scene_cases(const Ranks& ranks, std::size_t stride)
{
  std::vector<Dealt_case> cases;
  const std::vector<std::string>& names = scenes::scene_names();
  for(std::size_t i = 0; i < 2 * names.size(); i += stride) {
    const std::string& name = names[i / 2];
    const scenes::Scene scene = scenes::make_scene(name, scene_options(1500 + 50 * i, .001, .1));
    Parameters p = i % 5 == 0 ? Parameters() : make_parameters(.006 * scene.diagonal, 25);
    p.cell_size = std::size_t(64) << i % 3;
    p.k_neighbors = 8 + i % 9;
    if(i % 4 >= 2)
      p.fixed_directions = {{0, 0, 1}, {1, .1, 0}};
    p.regularize_axis_symmetry = i % 7 == 0;
    cases.push_back({{name, to_cloud(scene), p, i % 2 == 0 ? Given::normals : Given::nothing},
                     deals[(i + std::size_t(ranks.size())) % 3]});
  }
  return cases;
}

// With so many points that of the largest shapes only a sample is counted, or with fewer.
inline std::vector<Dealt_case> random_cases(std::uint64_t seed, std::size_t number, std::size_t more_points = 15000)
{
  std::vector<Dealt_case> cases;
  for(std::uint64_t s = seed; s < seed + number; ++s)
    cases.push_back({make_random_case(s, more_points), deals[s % 3]});
  return cases;
}

// One wall, so long that it has parts on all ranks.
inline Cloud wall(std::size_t n, double length)
{
  scenes::Random random(3);
  Cloud cloud;
  for(std::size_t i = 0; i < n; ++i)
    cloud.emplace_back(Kernel::Point_3(length * random.uniform(), .003 * random.uniform(), random.uniform()),
                       Kernel::Vector_3(.05 * random.uniform(), 1, 0));
  return cloud;
}

// Two walls of equal distances everywhere, so that ties decide who is a neighbor.
inline Cloud lattice(int n)
{
  Cloud cloud;
  for(int i = 0; i < n; ++i)
    for(int j = 0; j < n; ++j) {
      cloud.emplace_back(Kernel::Point_3(i * 0x1p-6, j * 0x1p-6, 0), Kernel::Vector_3(0, 0, 1));
      cloud.emplace_back(Kernel::Point_3(0, i * 0x1p-6, (j + 1) * 0x1p-6), Kernel::Vector_3(1, 0, 0));
    }
  return cloud;
}

// Clouds, and distributions of them, that are at the border of what there can be.
inline std::vector<Dealt_case> border_cases(const Ranks& ranks, std::size_t stride)
{
  const std::size_t size = std::size_t(ranks.size());
  const Cloud cube = make_cloud("cube", 1500), house = make_cloud("house", 2000);
  Cloud twice = joined(cube, cube), close = joined(cube, moved(cube, 1e-9, 0, 0));
  shuffle(twice, 1);
  struct Named {
    const char* name;
    Cloud cloud;
    std::size_t cell_size;
    Deal deal;
  };
  const std::vector<Named> list = {
    {"nothing", {}, 64, Deal::blocks},
    {"a point", repeated(1), 64, Deal::last},
    {"two points for each rank", make_cloud("cube", 2 * size), 64, Deal::blocks},
    {"equal points", repeated(700), 64, Deal::cyclic},
    {"all on one rank", house, 128, Deal::last},
    {"ranks without points", house, 64, Deal::odd},
    {"one leaf", cube, 8192, Deal::random},
    {"a leaf for each rank", make_cloud("cube", 60 * size), 64, Deal::blocks},
    {"duplicates on other ranks", joined(cube, cube), 64, Deal::blocks},
    {"duplicates anywhere", twice, 100, Deal::cyclic},
    {"close twins", close, 64, Deal::blocks},
    {"a wall", wall(3000, 30), 64, Deal::random},
    {"a strip", wall(2000, 3000), 64, Deal::blocks},
    {"a lattice", lattice(30), 64, Deal::random},
    {"two places", joined(cube, moved(cube, 900, -400, 200)), 64, Deal::random},
    {"a far point", joined(cube, moved(repeated(1), 30000, 0, 0)), 64, Deal::blocks},
    {"a huge offset", moved(cube, 4e6, -5e6, 300), 64, Deal::reversed},
    {"bad points on one rank", spoiled(cube, cube.size() / size), 64, Deal::blocks},
    {"nothing but bad points", spoiled(cube, cube.size()), 64, Deal::cyclic},
    {"fewer than a shape needs", make_cloud("cube", 20), 64, Deal::cyclic},
  };
  std::vector<Dealt_case> cases;
  for(std::size_t i = 0; i < 2 * list.size(); i += stride) {
    const Named& n = list[i / 2];
    const Given given = i % 2 == 0 ? Given::normals : Given::nothing;
    cases.push_back({{n.name, n.cloud, with_cells(make_parameters(.01, 24), n.cell_size), given}, n.deal});
  }
  return cases;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_CASES_H
