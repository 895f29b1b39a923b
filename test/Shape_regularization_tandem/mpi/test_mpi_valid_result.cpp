// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A result is refused on all ranks, for the same reason, where one of them has another one. Whatever that is, the ranks
// agree, and nobody waits.

#undef NDEBUG

#include "testing/corruptions.h"
#include "testing/mpi_failure.h"
#include "testing/mpi_support.h"

#include <CGAL/Shape_regularization_tandem/is_valid_result.h>

#include <algorithm>
#include <cmath>

namespace np = CGAL::Tandem::parameters;
using Data = Shapes::Data;

class Checked_result {
public:
  explicit Checked_result(const Ranks& ranks)
    : ranks_(ranks), part_(to_cloud(scenes::make_scene("cube", scene_options(1200, .001, .1)))), shapes_(detect(ranks))
  {}

  const Shapes& shapes() const { return shapes_; }
  const Ranks& ranks() const { return ranks_; }
  bool is_last() const { return ranks_.rank() == ranks_.size() - 1; }

  // Empty if the ranks accept the data; the same on all of them.
  std::string reason(const Data& data, const std::string& name) const
  {
    std::string why;
    const std::string failure = failure_of([&] { CGAL::Tandem::is_valid_result(part_, Shapes(data), list(), &why); });
    check_failure(ranks_, failure, {"nothing"}, name);
    check_failure(ranks_, why, {}, name);
    return why;
  }

private:
  decltype(np::point_map(First<Kernel>()).normal_map(Second<Kernel>()).communicator(Ranks())) list() const
  {
    return np::point_map(First<Kernel>()).normal_map(Second<Kernel>()).communicator(ranks_);
  }

  // Each rank has every so many points of the cloud.
  Shapes detect(const Ranks& ranks)
  {
    std::size_t kept = 0;
    for(std::size_t i = std::size_t(ranks.rank()); i < part_.size(); i += std::size_t(ranks.size()))
      part_[kept++] = part_[i];
    part_.resize(kept);
    return CGAL::Tandem::detect_planes<Mpi_tag<CGAL::Sequential_tag>>(part_, list().settings(make_parameters(.01, 30)));
  }

  const Ranks& ranks_;
  Cloud part_;
  Shapes shapes_;
};

void test_reasons(const Checked_result& result)
{
  const auto check = [&](const std::string& name, const char* word, auto corrupt) {
    Data data = result.shapes().data();
    if(result.is_last())
      corrupt(data);
    const std::string why = result.reason(data, name);
    CHECK_AT(why.find(word) != std::string::npos, name + " is refused because: " + why);
  };
  if(result.ranks().size() > 1) { // what one rank cannot see by itself
    check("another plane", "different",
          [](Data& d) { d.coefficients[0][3] = std::nextafter(d.coefficients[0][3], 9.); });
    check("other parameters", "different", [](Data& d) { ++d.parameters.k_neighbors; });
  }
  check("a point of no shape", "out of range",
        [](Data& d) { change_table(d.shape_of, [](std::vector<std::int32_t>& labels) { labels[0] = 1000; }); });
  check("a point freed", "size", [](Data& d) {
    change_table(d.shape_of, [](std::vector<std::int32_t>& labels) {
      *std::find_if(labels.begin(), labels.end(), [](std::int32_t s) { return s >= 0; }) = -1;
    });
  });
}

// Fields of the last rank: all but statistics and uncertainties, which are not checked.
void test_each_field(const Checked_result& result)
{
  std::size_t checked = 0, refused = 0;
  enum : int { none, other, promised };
  for(std::size_t number = 0;; ++number) {
    Data data = result.shapes().data(), corrupted = data;
    corrupted.points = result.shapes().point_groups();
    const Corruption corruption(corrupted, number);
    const std::string field = corruption.is_made() ? corruption.field() : "";
    int kind = field.empty()                                                       ? none
               : field.find("statistics.") == 0 || field.find("uncertainty[") == 0 ? other
                                                                                   : promised;
    MPI_Bcast(&kind, 1, MPI_INT, result.ranks().size() - 1, result.ranks());
    if(kind == none)
      break;
    if(result.is_last())
      data = corrupted;
    if(kind == promised) {
      ++checked;
      refused += !result.reason(data, "corruption " + std::to_string(number)).empty();
    }
  }
  CHECK_AT(checked > 200 && refused > checked * 7 / 10, std::to_string(refused) + " of " + std::to_string(checked));
}

// Other results are accepted: of estimated normals, where only the last rank has points, and of no points at all.
void test_other_results(const Ranks& ranks)
{
  Cloud cloud = to_cloud(scenes::make_scene("cube", scene_options(1200, .001, .1)));
  cloud.emplace_back(Kernel::Point_3(NAN, 0, 0), Kernel::Vector_3(0, 0, 1));
  const auto list = np::point_map(First<Kernel>()).communicator(ranks);
  for(const std::size_t size : {cloud.size(), std::size_t(0)}) {
    const std::ptrdiff_t own = ranks.rank() == ranks.size() - 1 ? std::ptrdiff_t(size) : 0;
    const Cloud part(cloud.begin(), cloud.begin() + own);
    const auto check = [&](const auto& maps) {
      const Shapes shapes =
        CGAL::Tandem::detect_planes<Mpi_tag<CGAL::Sequential_tag>>(part, maps.settings(make_parameters(.01, 30)));
      CHECK(shapes.number_of_shapes() >= (size > 0 ? 6 : 0));
      std::string why;
      CHECK_AT(CGAL::Tandem::is_valid_result(part, shapes, maps, &why), why);
    };
    check(list);
    check(list.normal_map(Second<Kernel>()));
  }
}

int main(int argc, char** argv)
{
  const boost::mpi::environment environment(argc, argv, boost::mpi::threading::funneled);
  const Ranks world;
  const Checked_result result(world);
  CHECK(result.reason(result.shapes().data(), "the result").empty());
  test_reasons(result);
  test_each_field(result);
  test_other_results(world);
  return report_on(world);
}
