// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many processes have the bits of one: on all scenes, in random cases, wherever the points are, on any communicator, and
// after each round.
//   mpirun -n N test_mpi_bits [few | SEED NUMBER]   a choice of the cases, or so many random ones, from this seed on

#undef NDEBUG

#include "testing/mpi_support.h"
#include "testing/tolerances.h"

#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

#include <cstdlib>

// A difference is reported with the round in which it comes up.
void test_rounds(const Ranks& ranks)
{
  const Dealt_case c = {{"house", make_cloud("house", 2500), with_cells(make_parameters(.2, 30), 128), Given::nothing},
                        Deal::random};
  using One_traits = CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>>;
  using Many_traits =
    CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, CGAL::Default, Mpi_tag<CGAL::Sequential_tag>>;
  const auto list = CGAL::Tandem::parameters::settings(c.parameters).point_map(First<Kernel>());
  // Each rank has the result of one process.
  CGAL::Tandem::Planar_shape_detection_3<One_traits> one(c.whole(ranks), list);
  CGAL::Tandem::Planar_shape_detection_3<Many_traits> many(c.part(ranks), list, Many_traits(Kernel(), ranks));
  const auto compare = [&](const std::string& where) {
    const Shapes expected = one.shapes();
    check_same_on_ranks(ranks, many.shapes(), expected, 0, c.text(ranks) + where);
  };
  compare(", before the first round");
  bool goes_on = true;
  for(int round = 0; goes_on; ++round) {
    goes_on = many.iterate();
    CHECK_AT(one.iterate() == goes_on, c.text(ranks) + ": one of them has ended");
    compare(", round " + std::to_string(round));
  }
  many.finish();
  one.finish();
  compare(", after the end game");
  CHECK_AT(!many.iterate(), c.text(ranks));
  many.finish();
  compare(", finished twice");
  CHECK_AT(many.shapes().number_of_shapes() >= 2, c.text(ranks));
}

// Messages of the caller that are under way while the ranks work.
class Pending_messages {
public:
  explicit Pending_messages(const Ranks& ranks)
    : ranks_(ranks), next_((ranks.rank() + 1) % ranks.size()), last_((ranks.rank() + ranks.size() - 1) % ranks.size())
  {
    MPI_Irecv(&received_[0], 1, MPI_INT, MPI_ANY_SOURCE, MPI_ANY_TAG, ranks_, &requests_[0]);
    MPI_Irecv(&received_[1], 1, MPI_INT, MPI_ANY_SOURCE, 1, ranks_, &requests_[1]);
    for(int i : {0, 2}) // nobody receives the second one meanwhile
      MPI_Isend(&sent_[i], 1, MPI_INT, next_, i, ranks_, &requests_[2 + i]);
    MPI_Iallreduce(&one_, &all_, 1, MPI_INT, MPI_SUM, ranks_, &requests_[5]);
  }

  void check_received(const std::string& name)
  {
    MPI_Isend(&sent_[1], 1, MPI_INT, next_, 1, ranks_, &requests_[3]);
    MPI_Recv(&received_[2], 1, MPI_INT, last_, 2, ranks_, MPI_STATUS_IGNORE);
    MPI_Waitall(6, requests_, MPI_STATUSES_IGNORE);
    for(int i : {0, 1, 2})
      check_equal(received_[i], sent_[i], name + ": message " + std::to_string(i));
    check_equal(all_, ranks_.size(), name + ": sum over the ranks");
  }

private:
  const Ranks& ranks_;
  int next_, last_;
  const int sent_[3] = {101, 102, 103}, one_ = 1;
  int received_[3] = {0, 0, 0}, all_ = 0;
  MPI_Request requests_[6];
};

// Half of the ranks, in reversed order, do something else than the others; then each rank by itself.
void test_communicators(const Ranks& world)
{
  const Ranks half = world.split(world.rank() % 2, -world.rank());
  Pending_messages in_world(world), in_half(half);
  compare_with_one(half, random_cases(std::uint64_t(20 + world.rank() % 2), std::size_t(1 + world.rank() % 2), 1500));
  const Ranks self(MPI_COMM_SELF, boost::mpi::comm_attach);
  compare_with_one(self, random_cases(std::uint64_t(30 + world.rank()), 1, 1500));
  in_half.check_received("half of the ranks");
  in_world.check_received("all ranks");

  // The default is the world.
  const Dealt_case c = {Case_maker(1).make_scene(2000), Deal::blocks};
  const Shapes shapes = detect<Mpi_tag<CGAL::Sequential_tag>>(c.part(world), c.parameters, c.given);
  const Shapes expected = detect(c.whole(world), c.parameters, c.given);
  check_same_on_ranks(world, shapes, expected, 0, c.text(world) + ", without a communicator");
}

// So many points that a sample of their cells is measured.
void test_estimates(const Ranks& ranks, std::size_t points)
{
  const Dealt_case c = {{"wall", wall(points, 50), Parameters(), Given::nothing}, Deal::cyclic};
  const auto list = CGAL::Tandem::parameters::point_map(First<Kernel>());
  const Parameters estimated =
    CGAL::Tandem::estimate_parameters<Mpi_tag<CGAL::Sequential_tag>>(c.part(ranks), list.communicator(ranks));
  Words own, expected;
  add_parameters(own, estimated);
  add_parameters(expected, CGAL::Tandem::estimate_parameters<CGAL::Sequential_tag>(c.cloud, list));
  CHECK_AT(own == expected, c.text(ranks) + ": estimated parameters");
}

// Points with tolerances of their own: the results of a single process, and few points that are too far for the grid.
void test_tolerances(const Ranks& ranks)
{
  scenes::Random random(4);
  Cloud cloud = Corridor(80, 60, 5, random).cloud;
  cloud[5].first = Kernel::Point_3(1e9, 1e9, 0);
  cloud[9].first = Kernel::Point_3(0, 0, 0);
  const Range_tolerance map = {0, .0065};
  for(const Deal deal : {Deal::random, Deal::odd})
    for(const Given given : {Given::normals, Given::nothing}) {
      Parameters parameters = with_cells(Parameters(), 200);
      parameters.minimum_region_size = 30;
      const Dealt_case c = {{"tolerances", cloud, parameters, given}, deal};
      const Cloud part = c.part(ranks);
      const auto detect_part = [&](const auto& list) {
        const auto with_ranks = list.communicator(ranks);
        Shapes shapes = CGAL::Tandem::detect_planes<Mpi_tag<CGAL::Sequential_tag>>(part, with_ranks);
        std::string why;
        CHECK_AT(CGAL::Tandem::is_valid_result(part, shapes, with_ranks, &why), c.text(ranks) + ": " + why);
        return shapes;
      };
      const Shapes shapes = with_tolerances(parameters, map, given, detect_part);
      const Shapes expected = detect_with_tolerances(c.whole(ranks), parameters, map, given);
      check_same_on_ranks(ranks, shapes, expected, 0, c.text(ranks));
      CHECK_AT(expected.number_of_shapes() >= 4 && expected.statistics().number_of_far_points == 1, c.text(ranks));
    }
}

int main(int argc, char** argv)
{
  const boost::mpi::environment environment(argc, argv, boost::mpi::threading::funneled);
  const Ranks world;
  if(argc > 2) {
    compare_with_one(world, random_cases(std::strtoull(argv[1], nullptr, 10), std::strtoull(argv[2], nullptr, 10)));
    return report_on(world);
  }
  const bool are_few = argc > 1;
  const std::size_t stride = are_few ? 11 : 1;
  const std::size_t shapes = compare_with_one(world, scene_cases(world, stride)) +
                             compare_with_one(world, random_cases(1, 20 / stride, are_few ? 1500 : 15000));
  CHECK(sum_over(world, shapes) > 150 / stride);
  compare_with_one(world, border_cases(world, stride));
  compare_with_one<CGAL::Parallel_if_available_tag>(world, scene_cases(world, 11));
  test_communicators(world);
  test_tolerances(world);
  if(!are_few) {
    test_estimates(world, 2000);
    test_estimates(world, 150000);
    test_rounds(world);
  }
  return report_on(world);
}
