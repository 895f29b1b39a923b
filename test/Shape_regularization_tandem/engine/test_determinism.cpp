// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same points and parameters give the same bits: for every run, back end,
// number of threads and order of the points, with normals that are given or estimated.

#include "scenes/scene_normals.h"
#include "testing/same_result.h"

#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#include <CGAL/Tandem/internal/engine/connect_cloud.h>
#include <CGAL/Tandem/internal/engine/prepare.h>

#include <random>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

BOOST_AUTO_TEST_SUITE(test_determinism)

// f() with so many threads, which may be more than there are cores.
template <class F>
void with_threads([[maybe_unused]] int threads, F f)
{
#ifdef CGAL_LINKED_WITH_TBB
  tbb::global_control control(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  tbb::task_arena(threads).execute(f);
#else
  f();
#endif
}

void check_runs(const std::string& name, const Cloud& cloud, const Parameters& parameters)
{
  using Tag = CGAL::Parallel_if_available_tag;
  for(const Given given : {Given::normals, Given::nothing}) {
    const std::string full = name + (given == Given::normals ? "" : " without normals");
    const Shapes expected = detect_valid(full, cloud, parameters, given);
    CHECK_AT(expected.number_of_shapes() >= 3, full);
    for(const int threads : {1, 3, 8})
      with_threads(threads, [&] {
        check_equal(difference(expected, detect<Tag>(cloud, parameters, given)), "",
                    full + ", " + std::to_string(threads) + " threads");
      });
    Cloud reversed(cloud.rbegin(), cloud.rend()), shuffled = cloud;
    shuffle(shuffled, 2);
    for(const Cloud& permuted : {reversed, shuffled})
      check_equal(difference({cloud, expected}, {permuted, detect<Tag>(permuted, parameters, given)}, given), "",
                  full + ", permuted");
  }
}

BOOST_AUTO_TEST_CASE(test_scenes)
{
  scenes::Options options = scene_options(20000, .0005, .05);
  options.varies_density = true;
  options.normals = scenes::Normals::perturbed;
  const scenes::Scene indoor = scenes::make_scene("indoor", options);
  check_runs("indoor", to_cloud(indoor), make_parameters(.002 * indoor.diagonal, 50));
}

// Normals that are blended at edges keep about as many points out of shapes as estimated ones add. Exact ones keep few
// out, and of estimated ones nothing is said.
BOOST_AUTO_TEST_CASE(test_blended_normals)
{
  for(const std::uint64_t seed : {1, 2, 3}) {
    scenes::Options options = scene_options(10000, .0003, 0);
    options.seed = seed;
    scenes::Scene scene = scenes::make_scene("part", options);
    const std::string name = "blended normals, seed " + std::to_string(seed);
    const Parameters parameters = make_parameters(.0015 * scene.diagonal, 30);
    const auto exact = detect(to_cloud(scene), parameters).statistics();
    scenes::set_blended_normals(scene, 0, seed);
    const Cloud cloud = to_cloud(scene);
    check_runs(name, cloud, parameters);
    const auto blended = detect(cloud, parameters).statistics();
    const auto own = detect(cloud, parameters, Given::nothing).statistics();
    const double gain = double(own.number_of_assigned_points) - double(blended.number_of_assigned_points);
    const double misaligned = double(blended.free_points.misaligned);
    CHECK_AT(gain > 500 && misaligned > .7 * gain && misaligned < 1.3 * gain,
             name + ": " + std::to_string(misaligned) + " for " + std::to_string(gain));
    CHECK_AT(exact.free_points.misaligned < 50 && own.free_points.misaligned == 0, name);
  }
}

// Each point comes two or three times: equal in all bits, which no order can tell apart, or nearer to its twin than the
// grid resolves, with another normal.
Cloud make_copies(double distance)
{
  Cloud cloud = to_cloud(scenes::make_scene("house", scene_options(4000, .001, .1)));
  scenes::Random random(5);
  for(std::size_t i = 0, n = cloud.size(); i < n; ++i)
    for(std::uint64_t copies = 1 + random.bits() % 2; copies > 0; --copies) {
      const scenes::Vec d = distance * random.direction(), m = (distance > 0 ? .4 : 0.) * random.direction();
      cloud.emplace_back(cloud[i].first + Kernel::Vector_3(d.x, d.y, d.z),
                         cloud[i].second + Kernel::Vector_3(m.x, m.y, m.z));
    }
  return cloud;
}

BOOST_AUTO_TEST_CASE(test_copies)
{
  for(const double distance : {0., 1e-9})
    check_runs(distance > 0 ? "close twins" : "duplicates", make_copies(distance), make_parameters(.08, 60));
}

// Coordinates, normal and tolerance of a point.
using Values = std::array<double, 7>;

// In the order of the engine, from a range in any order.
std::vector<Values> ordered(std::vector<Values> points, std::mt19937& random)
{
  using namespace CGAL::Tandem::internal;
  using Traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, ::First<Kernel>, ::Second<Kernel>, CGAL::Sequential_tag>;
  std::shuffle(points.begin(), points.end(), random);
  Cloud cloud;
  for(const Values& v : points)
    add(cloud, {v[0], v[1], v[2]}, {v[3], v[4], v[5]});
  Sequential_backend backend;
  Import in = read_points(backend, cloud, Item_reader<Traits>(Traits(), ::First<Kernel>(), ::Second<Kernel>()));
  in.has_tolerances = true;
  for(const Values& v : points)
    in.tolerances.push_back(v[6]);
  Parameters parameters = make_parameters(.08, 60);
  parameters.surfel_size = 0; // the points of a surfel need no order
  choose_grid(in, parameters);
  Labeled_cloud<Sequential_backend> sorted(backend);
  sort_points(backend, in, parameters.cell_size, sorted.cloud, sorted.cells);
  std::vector<Values> list;
  for(const std::uint32_t i : sorted.cloud.order)
    list.push_back(points[i]);
  return list;
}

// Points that are one on the grid, and differ in a coordinate, a normal, or a tolerance: their order is always the
// same.
BOOST_AUTO_TEST_CASE(test_order_of_points)
{
  std::mt19937 random(3);
  for(int kind = 0; kind < 3; ++kind) {
    std::vector<Values> points;
    for(const auto& [p, n] : make_copies(0)) {
      Values v = {p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), .08};
      v[std::size_t(3 * kind)] -= 1e-9 * double(random() % 7);
      points.push_back(v);
    }
    const auto first = ordered(points, random), second = ordered(points, random);
    CHECK_AT(first == second, "points that differ in kind " + std::to_string(kind) + " are in other orders");
  }
}

BOOST_AUTO_TEST_SUITE_END()
