// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests of many processes share. Every rank makes the same clouds and takes its part of them. What it finds is
// compared with the result of one process for the parts of all ranks, one after the other: all bits, exact duplicates
// included.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_SUPPORT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_SUPPORT_H

#include "random_case.h"

#include <CGAL/Shape_regularization_tandem/mpi.h>

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>

namespace CGAL {
namespace Tandem {
namespace internal {

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

} // namespace internal
} // namespace Tandem
} // namespace CGAL

using Ranks = boost::mpi::communicator;
using CGAL::Tandem::Mpi_tag;
using Words = std::vector<std::uint64_t>;

// Which rank has which points.
enum class Deal { blocks, random, reversed, cyclic, last, odd };

inline std::string to_string(Deal deal)
{
  const char* const names[] = {"blocks", "random", "reversed", "cyclic", "all on the last rank", "on odd ranks"};
  return names[int(deal)];
}

// A cloud, and which of its points each rank has.
struct Dealt_case : Random_case {
  Deal deal;

  // For each rank, the positions of its points in the cloud.
  std::vector<std::vector<std::size_t>> parts(int ranks) const
  {
    const std::size_t n = cloud.size(), size = std::size_t(ranks);
    scenes::Random random(n);
    std::vector<std::vector<std::size_t>> list(size);
    for(std::size_t i = 0; i < n; ++i) {
      const std::size_t block = i * size / n, any = random.bits() % size;
      const std::size_t rank[] = {block, any, block, i % size, size - 1, (std::min)(block | 1, size - 1)}; // by deal
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
    return name + (given == Given::normals ? "" : ", own normals") + ", " + to_string(deal) + ", " +
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

inline std::uint64_t to_word(double x)
{
  std::uint64_t word;
  std::memcpy(&word, &x, sizeof word);
  return word;
}

template <class List>
void add_sized(Words& words, const List& list)
{
  words.push_back(list.size());
  for(const auto& value : list)
    words.push_back(std::uint64_t(std::int64_t(value)));
}

inline void add_parameters(Words& words, const Parameters& p)
{
  for(const double x : {p.maximum_distance, p.maximum_angle, p.angle_tolerance, p.maximum_offset, p.simplicity,
                        p.regularity, p.surfel_size})
    words.push_back(to_word(x));
  words.insert(words.end(), {p.minimum_region_size, p.k_neighbors, p.cell_size});
}

// All but times, work, memory, and the name of the back end.
inline void add_statistics(Words& words, const CGAL::Tandem::Statistics& s)
{
  words.insert(words.end(),
               {s.number_of_points, s.number_of_ignored_coordinates, s.number_of_ignored_normals,
                s.number_of_ignored_tolerances, s.number_of_far_points, s.number_of_assigned_points, s.number_of_shapes,
                s.number_of_directions, s.number_of_planes, s.number_of_orthogonal_pairs, s.degrees_of_freedom,
                s.number_of_rounds, s.is_grid_coarse, s.has_estimated_normals, s.is_cancelled});
  const CGAL::Tandem::Free_points& f = s.free_points;
  words.insert(words.end(),
               {f.without_normal, f.misfit, f.without_neighbors, f.in_small_regions, f.clutter, f.unselected});
  for(const double x : {s.coverage, s.mean_distance, s.complexity, s.grid_step, s.score.fit, s.score.links,
                        s.score.size, s.score.price, s.score.freedom})
    words.push_back(to_word(x));
}

// What a result says of the shapes. It is the same on all ranks.
inline Words common_words(const Shapes& shapes)
{
  const auto& data = shapes.data();
  Words words;
  add_parameters(words, data.parameters);
  add_statistics(words, data.statistics);
  words.push_back(data.coefficients.size());
  for(const auto& c : data.coefficients)
    for(const double x : c)
      words.push_back(to_word(x));
  add_sized(words, data.parallel_group);
  add_sized(words, data.coplanar_group);
  add_sized(words, data.fixed_direction);
  add_sized(words, data.symmetry_group);
  add_sized(words, data.is_flipped);
  for(const auto& u : data.uncertainty) {
    for(const double x : {u.centroid[0], u.centroid[1], u.centroid[2], u.noise, u.offset_deviation, u.angle_deg})
      words.push_back(to_word(x));
    for(const double x : u.normal_covariance)
      words.push_back(to_word(x));
  }
  words.push_back(data.orthogonal_groups.size());
  for(const auto& pair : data.orthogonal_groups)
    words.push_back(std::uint64_t(pair.first) << 32 | std::uint64_t(pair.second));
  return words;
}

// What it says of each point: its label and, if that was estimated, its normal.
inline Words point_words(const Shapes& shapes)
{
  Words words;
  for(std::size_t i = 0; i < shapes.number_of_points(); ++i)
    words.push_back(std::uint64_t(std::uint32_t(shapes.shape_index(i))) << 32 |
                    (shapes.has_estimated_normals() ? shapes.data().normal[i] : 0));
  return words;
}

// The words of all ranks, one after the other; on the root only.
inline Words gather(const Ranks& ranks, const Words& own, int root)
{
  const int size = int(own.size());
  std::vector<int> sizes(std::size_t(ranks.size())), first;
  MPI_Gather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, root, ranks);
  int total = 0;
  for(const int n : sizes) {
    first.push_back(total);
    total += n;
  }
  Words all(std::size_t(ranks.rank() == root ? total : 0));
  MPI_Gatherv(own.data(), size, MPI_UINT64_T, all.data(), sizes.data(), first.data(), MPI_UINT64_T, root, ranks);
  return all;
}

// Each rank lists its own points.
inline void check_own_points(const Shapes& shapes, std::size_t size, const std::string& name)
{
  check_equal(shapes.number_of_points(), size, name + ": points of a rank");
  std::size_t listed = 0, labeled = 0;
  for(std::size_t s = 0; s < shapes.number_of_shapes(); ++s)
    for(const std::size_t i : shapes.points(s)) {
      ++listed;
      CHECK_AT(i < size && shapes.shape_index(i) == int(s), name + ": point " + std::to_string(i));
    }
  for(std::size_t i = 0; i < shapes.number_of_points(); ++i)
    labeled += shapes.shape_index(i) >= 0;
  check_equal(listed, labeled, name + ": points of the shapes of a rank");
}

// The root knows what is expected; null on other ranks.
inline void check_same_on_ranks(const Ranks& ranks, const Shapes& own, const Shapes* expected, int root,
                                const std::string& name)
{
  const Words common = gather(ranks, common_words(own), root), points = gather(ranks, point_words(own), root);
  if(ranks.rank() != root)
    return;
  const Words of_one = common_words(*expected);
  Words of_all;
  for(int r = 0; r < ranks.size(); ++r)
    of_all.insert(of_all.end(), of_one.begin(), of_one.end());
  long at = first_difference(common, of_all);
  CHECK_AT(at < 0, name + ": the shapes differ, first in word " + std::to_string(at % long(of_one.size())) +
                     " of rank " + std::to_string(at / long(of_one.size())));
  at = first_difference(points, point_words(*expected));
  CHECK_AT(at < 0, name + ": the points differ, first the one at " + std::to_string(at));
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
    const Cloud part = c.part(ranks);
    const Shapes own = detect_on<Tag>(ranks, part, c.parameters, c.given);
    check_own_points(own, part.size(), c.text(ranks));
    check_same_on_ranks(ranks, own, &expected[i], root_of(i), c.text(ranks));
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

// As report(), but of all ranks.
inline int report_on(const Ranks& ranks)
{
  const int all = sum_over(ranks, failures());
  if(ranks.rank() == 0 && all > 0)
    std::cerr << all << " failures on all ranks" << std::endl;
  return all == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_MPI_SUPPORT_H
