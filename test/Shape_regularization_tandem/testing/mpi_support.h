// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of many processes share. Every rank makes the same clouds and takes its part of them. What it finds is
// compared with the result of one process for the parts of all ranks, one after the other: all bits, exact duplicates
// included.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_SUPPORT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_SUPPORT_H

#include "border_clouds.h"
#include "property_case.h"
#include "same_result.h"

#include <CGAL/Shape_regularization_tandem/mpi.h>

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>

namespace CGAL::Tandem::internal {

// What the library has compiled is tested, although the precompiled header defines it, too.
using Sequential_ranks = Mpi_backend<Sequential_backend>;
extern template Distance_estimate complete_parameters(Sequential_ranks&, const Import&, bool, Parameters&);
extern template std::string set_scale(Sequential_ranks&, Import&, bool, Parameters&);
extern template Shapes_data export_shapes(Sequential_ranks&, const Import&, const Parameters&, const Engine_result&);
#ifdef CGAL_LINKED_WITH_TBB
using Tbb_ranks = Mpi_backend<Tbb_backend>;
extern template Distance_estimate complete_parameters(Tbb_ranks&, const Import&, bool, Parameters&);
extern template std::string set_scale(Tbb_ranks&, Import&, bool, Parameters&);
extern template Shapes_data export_shapes(Tbb_ranks&, const Import&, const Parameters&, const Engine_result&);
#endif

} // namespace CGAL::Tandem::internal

using Ranks = boost::mpi::communicator;
using CGAL::Tandem::Mpi_tag;

// Which rank has which points.
enum class Deal { random, blocks, reversed, cyclic, last, odd };
constexpr std::size_t number_of_deals = 6;

// A cloud, and which of its points each rank has.
struct Dealt_case : Property_case {
  Deal deal;

  // For each rank, the positions of its points in the cloud.
  std::vector<std::vector<std::size_t>> parts(int ranks) const
  {
    const std::size_t n = cloud.size(), size = std::size_t(ranks);
    scenes::Random random(n);
    std::vector<std::vector<std::size_t>> list(size);
    for(std::size_t i = 0; i < n; ++i) {
      const std::size_t block = i * size / n, any = random.bits() % size;
      const std::size_t rank[] = {any, block, block, i % size, size - 1, (std::min)(block | 1, size - 1)}; // by deal
      list[rank[int(deal)]].push_back(deal == Deal::reversed ? n - 1 - i : i);
    }
    return list;
  }

  Cloud part(const Ranks& ranks) const { return points_at(parts(ranks.size())[std::size_t(ranks.rank())]); }

  // The parts of all ranks.
  Cloud whole(const Ranks& ranks) const
  {
    std::vector<std::size_t> positions;
    for(const auto& list : parts(ranks.size()))
      positions.insert(positions.end(), list.begin(), list.end());
    return points_at(positions);
  }

  std::string text(const Ranks& ranks) const
  {
    return name + (given == Given::normals ? "" : ", own normals") + ", deal " + std::to_string(int(deal)) + ", " +
           std::to_string(ranks.size()) + " ranks";
  }

private:
  Cloud points_at(const std::vector<std::size_t>& positions) const
  {
    Cloud points;
    for(const std::size_t i : positions)
      points.push_back(cloud[i]);
    return points;
  }
};

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
                     Deal((i + std::size_t(ranks.size())) % number_of_deals)});
  }
  return cases;
}

// With so many points that of the largest shapes only a sample is counted, or with fewer.
inline std::vector<Dealt_case> random_cases(std::uint64_t seed, std::size_t number, std::size_t more_points = 15000)
{
  std::vector<Dealt_case> cases;
  for(std::uint64_t s = seed; s < seed + number; ++s)
    cases.push_back({Case_maker(s).make_scene(more_points), Deal(s % number_of_deals)});
  return cases;
}

// Clouds at the border of what there can be, in cells of few points, dealt in all ways in turn.
inline std::vector<Dealt_case> border_cases(const Ranks& ranks, std::size_t stride)
{
  const auto clouds = border_clouds(std::size_t(ranks.size()));
  std::vector<Dealt_case> cases;
  for(std::size_t i = 0; i < 2 * clouds.size(); i += stride) {
    const auto& [name, cloud] = clouds[i / 2];
    Parameters parameters = with_cells(make_parameters(.01, 24), i % 5 == 4 ? 8192 : 64);
    parameters.k_neighbors = 10;
    cases.push_back({{name, cloud, parameters, i % 2 == 0 ? Given::normals : Given::nothing},
                     Deal((i / 2 + i % 2) % number_of_deals)});
  }
  return cases;
}

// What it says of each point.
inline Words point_words(const Shapes& shapes)
{
  Words words;
  for(std::size_t i = 0; i < shapes.number_of_points(); ++i)
    for(const std::uint64_t word : point_bits(shapes, i))
      words.push_back(word);
  return words;
}

// Those of the root.
inline Words broadcast(const Ranks& ranks, Words words, int root)
{
  std::uint64_t size = words.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, root, ranks);
  words.resize(size);
  MPI_Bcast(words.data(), int(size), MPI_UINT64_T, root, ranks);
  return words;
}

// The root knows what is expected: of the points of all ranks, one after the other.
inline void check_same_on_ranks(const Ranks& ranks, const Shapes& own, const Shapes& expected, int root,
                                const std::string& name)
{
  long at = first_difference(shape_bits(own), broadcast(ranks, shape_bits(expected), root));
  const std::string where = name + ", rank " + std::to_string(ranks.rank());
  CHECK_AT(at < 0, where + ": the shapes differ, first in word " + std::to_string(at));
  const Words all = broadcast(ranks, point_words(expected), root), points = point_words(own);
  std::uint64_t last = points.size(); // of the ranks up to this one
  MPI_Scan(MPI_IN_PLACE, &last, 1, MPI_UINT64_T, MPI_SUM, ranks);
  const bool is_complete = ranks.rank() + 1 < ranks.size() ? last <= all.size() : last == all.size();
  CHECK_AT(is_complete, where + ": another number of points");
  at = is_complete ? first_difference(points, Words(all.data() + last - points.size(), all.data() + last)) : -1;
  CHECK_AT(at < 0, where + ": the points differ, first the one at " + std::to_string(at / 4));
}

template <class Tag>
Shapes detect_on(const Ranks& ranks, const Cloud& part, const Parameters& parameters, Given given)
{
  const auto list = CGAL::Tandem::parameters::settings(parameters).point_map(First<Kernel>()).communicator(ranks);
  return given == Given::normals ? CGAL::Tandem::detect_planes<Mpi_tag<Tag>>(part, list.normal_map(Second<Kernel>()))
                                 : CGAL::Tandem::detect_planes<Mpi_tag<Tag>>(part, list);
}

// Each rank has the results of some of the cases, so that those of one process are computed beside each other. Returns
// the number of shapes, of these.
template <class Tag = CGAL::Sequential_tag>
std::size_t compare_with_one(const Ranks& ranks, const std::vector<Dealt_case>& cases)
{
  std::vector<Shapes> expected(cases.size());
  std::size_t shapes = 0;
  const auto root_of = [&](std::size_t i) { return int(i % std::size_t(ranks.size())); };
  for(std::size_t i = 0; i < cases.size(); ++i)
    if(root_of(i) == ranks.rank()) {
      expected[i] = detect(cases[i].whole(ranks), cases[i].parameters, cases[i].given);
      shapes += expected[i].number_of_shapes();
    }
  for(std::size_t i = 0; i < cases.size(); ++i) {
    const Dealt_case& c = cases[i];
    const Shapes own = detect_on<Tag>(ranks, c.part(ranks), c.parameters, c.given);
    check_same_on_ranks(ranks, own, expected[i], root_of(i), c.text(ranks));
  }
  return shapes;
}

template <class T>
T sum_over(const Ranks& ranks, T own)
{
  T sum = own;
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, boost::mpi::get_mpi_datatype(sum), MPI_SUM, ranks);
  return sum;
}

// The exit code, of all ranks.
inline int report_on(const Ranks& ranks)
{
  const int all = sum_over(ranks, failures());
  if(ranks.rank() == 0 && all > 0)
    std::cerr << all << " failures on all ranks" << std::endl;
  return all == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_SUPPORT_H
