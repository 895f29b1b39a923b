// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What goes wrong on one rank ends all of them, with the same exception, and nobody waits: a parameter out of its range,
// a property map or a callback that throws, memory that is not there. Where the callback of one rank cancels, all have
// the result of one process that is cancelled there. A result is refused on all ranks, for the same reason, where one of
// them has another one.
//   mpirun -n N test_mpi_failures [few | memory | killed]
// A choice; or a large cloud in little memory, without a sanitizer; or the last rank is killed: mpirun has to end the others.

#undef NDEBUG

#include "testing/corruptions.h"
#include "testing/measure.h"
#include "testing/mpi_support.h"

#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>
#include <CGAL/Shape_regularization_tandem/is_valid_result.h>

#include <CGAL/Point_set_3.h>

#include <boost/core/demangle.hpp>

#include <atomic>
#include <cmath>
#include <csignal>
#include <set>
#include <typeinfo>

namespace np = CGAL::Tandem::parameters;
using CGAL::Tandem::Callback;
using Data = Shapes::Data;

// How many tables can still be had before one cannot. Negative: all.
std::atomic<long> tables_left(-1);

// The tables of the engine are from here; Open MPI calls other functions.
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t bytes)
{
  if(tables_left >= 0 && tables_left-- == 0)
    return nullptr;
  void* memory = nullptr;
  return posix_memalign(&memory, alignment, bytes) == 0 ? memory : nullptr;
}

// Not of the standard library.
struct Stop {};

// The exception of f() by type and message.
template <class F>
std::string failure_of(F f)
{
  try {
    f();
  } catch(const std::exception& e) {
    return boost::core::demangle(typeid(e).name()) + ": " + e.what();
  } catch(const Stop&) {
    return "Stop";
  }
  return "nothing";
}

// The same text on all ranks, which has the words.
void check_failure(const Ranks& ranks, const std::string& text, std::initializer_list<const char*> words,
                   const std::string& name)
{
  for(const char* word : words)
    CHECK_AT(text.find(word) != std::string::npos, name + ": " + word + " is not in: " + text);
  const Words own(text.begin(), text.end());
  CHECK_AT(own == broadcast(ranks, own, 0), name + ": the ranks do not agree on: " + text);
}

Dealt_case make_case()
{
  Parameters parameters = make_parameters(.01, 30);
  parameters.cell_size = 64;
  return {{"cube", to_cloud(scenes::make_scene("cube", scene_options(1200, .001, .1))), parameters, Given::normals},
          Deal::random};
}

std::set<int> first_and_last(const Ranks& ranks) { return {0, ranks.size() - 1}; }

template <class List>
auto detect_with(const Ranks& ranks, const Cloud& part, const List& list)
{
  return CGAL::Tandem::detect_planes<Mpi_tag<CGAL::Sequential_tag>>(
    part, list.point_map(First<Kernel>()).normal_map(Second<Kernel>()).communicator(ranks));
}

// The reason is the same on all ranks, and has the words.
template <class List>
void check_refused(const Ranks& ranks, const List& list, std::initializer_list<const char*> words)
{
  const Cloud part = make_case().part(ranks);
  check_failure(ranks, failure_of([&] { detect_with(ranks, part, list); }), words, *words.begin());
}

// The others have none.
Callback callback_of(const Ranks& ranks, int calling, Callback callback)
{
  return ranks.rank() == calling ? callback : Callback();
}

std::string failure_with_callback(const Ranks& ranks, int calling, const Callback& callback)
{
  const Cloud part = make_case().part(ranks);
  const auto list = np::settings(make_case().parameters).callback(callback_of(ranks, calling, callback));
  return failure_of([&] { detect_with(ranks, part, list); });
}

void test_parameters(const Ranks& ranks, int)
{
  const Cloud part = make_case().part(ranks);
  for(const int bad : first_and_last(ranks)) {
    const bool is_bad = ranks.rank() == bad;
    const auto check = [&](const auto& list, const char* name, const char* value) {
      check_refused(ranks, list, {name, "Parameter_error", value});
      const auto both = list.point_map(First<Kernel>()).communicator(ranks);
      const auto estimate = [&] { CGAL::Tandem::estimate_parameters<Mpi_tag<CGAL::Sequential_tag>>(part, both); };
      check_failure(ranks, failure_of(estimate), {name, "Parameter_error", value}, "estimate_parameters");
    };
    Parameters parameters = make_parameters(.01, 30);
    parameters.maximum_angle = is_bad ? 95 : 25;
    check(np::settings(parameters), "maximum_angle", "95");
    parameters.maximum_angle = 25;
    parameters.fixed_directions = {{0, 0, is_bad ? 0. : 1.}};
    check(np::settings(parameters), "fixed_directions", "");
    check(np::maximum_distance(is_bad ? -1. : .01), "maximum_distance", "-1");
    check(np::k_neighbors(is_bad ? 2 : 12), "k_neighbors", "2");
  }
  // Of several failures, that of the first rank counts.
  check_refused(ranks, np::maximum_distance(.01).k_neighbors(1000 + ranks.rank()), {"k_neighbors", "1000"});
}

// Valid on each rank, but not the same.
void test_different_parameters(const Ranks& ranks, int)
{
  const auto check = [&](const char* name, auto change) {
    Parameters parameters = make_parameters(.01, 30);
    if(ranks.rank() == ranks.size() - 1)
      change(parameters);
    if(ranks.size() > 1)
      check_refused(ranks, np::settings(parameters), {name, "invalid_argument", "the same on all ranks"});
  };
  check("maximum_distance", [](Parameters& p) { p.maximum_distance = .02; });
  check("cell_size", [](Parameters& p) { p.cell_size = 100; });
  check("regularize_coplanarity", [](Parameters& p) { p.regularize_coplanarity = false; });
  check("fixed_directions", [](Parameters& p) { p.fixed_directions = {{0, 0, 1}}; });
}

// A point set knows at run time only whether it has normals. One without points need not have them.
void test_normals_of_some_ranks(const Ranks& ranks, int)
{
  const Dealt_case c = make_case();
  const bool is_last = ranks.rank() == ranks.size() - 1;
  const auto list = np::settings(c.parameters).communicator(ranks);
  const auto detect = [&](bool has_points) {
    CGAL::Point_set_3<Kernel::Point_3> points(!is_last);
    for(const auto& item : c.part(ranks))
      if(has_points && is_last)
        points.insert(item.first);
      else if(!is_last)
        points.insert(item.first, item.second);
    return CGAL::Tandem::detect_planes<Mpi_tag<CGAL::Sequential_tag>>(points, list);
  };
  if(ranks.size() == 1)
    return;
  check_failure(ranks, failure_of([&] { detect(true); }), {"invalid_argument", "normal_map", "some ranks"}, "normals");
  const Shapes shapes = detect(false);
  CHECK(!shapes.has_estimated_normals() && shapes.number_of_shapes() >= 6);
}

void test_maps(const Ranks& ranks, int)
{
  using Tag = Mpi_tag<CGAL::Parallel_if_available_tag>;
  const Cloud part = make_case().part(ranks);
  const auto check = [&](const char* expected, const std::function<void()>& fail) {
    for(const int bad : first_and_last(ranks)) {
      const Failing_map map = {ranks.rank() == bad ? &part[part.size() / 2] : nullptr, fail};
      const auto list = np::maximum_distance(.01).point_map(map).normal_map(Second<Kernel>()).communicator(ranks);
      const std::string found = failure_of([&] { CGAL::Tandem::detect_planes<Tag>(part, list); });
      check_failure(ranks, found, {expected}, "a property map");
    }
  };
  check("runtime_error: lost", [] { throw std::runtime_error("lost"); });
  check("invalid_argument: lost", [] { throw std::invalid_argument("lost"); });
  check("range_error: lost", [] { throw std::range_error("lost"); });
  check("length_error: lost", [] { throw std::length_error("lost"); });
  check("logic_error: lost", [] { throw std::logic_error("lost"); });
  check("bad_alloc", [] { throw std::bad_alloc(); });
}

// All have the extent of the points of all ranks.
void test_extent(const Ranks& ranks, int)
{
  Dealt_case c = make_case();
  c.cloud.insert(c.cloud.end(), c.cloud.size() / 10, {Kernel::Point_3(1e9, 0, 0), Kernel::Vector_3(0, 0, 1)});
  check_failure(ranks, failure_of([&] { detect_with(ranks, c.part(ranks), np::maximum_distance(.01)); }),
                {"Parameter_error"}, "extent");
}

Shapes detect_alone(const Cloud& cloud, const Callback& callback)
{
  const auto list = np::settings(make_case().parameters).point_map(First<Kernel>()).normal_map(Second<Kernel>());
  return CGAL::Tandem::detect_planes<CGAL::Sequential_tag>(cloud, list.callback(callback));
}

// How often the callback is called in the case of these tests.
int number_of_calls()
{
  int calls = 0;
  detect_alone(make_case().cloud, [&](double) { return ++calls > 0; });
  return calls;
}

// Whatever stage the callback of one rank ends by an exception.
void test_throwing_callbacks(const Ranks& ranks, int stride)
{
  const int calls = number_of_calls();
  for(int call = calls; call > 0; call -= stride)
    for(const int bad : first_and_last(ranks)) {
      int count = 0;
      const std::string name = "call " + std::to_string(call), found = failure_with_callback(ranks, bad, [&](double) {
                                                                 if(++count == call)
                                                                   throw std::runtime_error("enough");
                                                                 return true;
                                                               });
      check_failure(ranks, found, {"runtime_error: enough"}, name);
      CHECK_AT(count == (ranks.rank() == bad ? call : 0), name + ", " + std::to_string(count));
    }
  // A type that other ranks do not know.
  const std::string found = failure_with_callback(ranks, 0, [](double) -> bool { throw Stop(); });
  CHECK_AT(found == (ranks.rank() == 0 ? "Stop" : "std::runtime_error: another rank has failed"), found);
}

// There are no shapes on any rank after that.
void test_class_after_exception(const Ranks& ranks, int)
{
  using Traits =
    CGAL::Tandem::Tandem_traits_3<Kernel, Cloud, First<Kernel>, Second<Kernel>, Mpi_tag<CGAL::Sequential_tag>>;
  bool is_complete = false;
  const Callback callback = callback_of(ranks, ranks.size() - 1, [&](double) {
    if(is_complete)
      throw std::invalid_argument("enough");
    return true;
  });
  const auto list = np::settings(make_case().parameters).callback(callback);
  CGAL::Tandem::Planar_shape_detection_3<Traits> detection(make_case().part(ranks), list, Traits(Kernel(), ranks));
  is_complete = true;
  check_failure(ranks, failure_of([&] { detection.iterate(); }), {"invalid_argument: enough"}, "iterate");
  check_failure(ranks, failure_of([&] { detection.iterate(); }), {"logic_error"}, "iterate again");
  check_failure(ranks, failure_of([&] { detection.finish(); }), {"logic_error"}, "finish");
  check_failure(ranks, failure_of([&] { detection.shapes(); }), {"logic_error"}, "shapes");
}

// The callback of one rank cancels for all: the shapes found until then are those of one process.
void test_cancellation(const Ranks& ranks, int stride)
{
  const Dealt_case c = make_case();
  const Cloud part = c.part(ranks), whole = c.whole(ranks);
  const auto list = np::settings(c.parameters);
  const int calls = number_of_calls();
  for(int call = 1; call < calls; call += stride) {
    int left = call;
    const Callback cancel = [&](double) { return --left > 0; };
    const Shapes own = detect_with(ranks, part, list.callback(callback_of(ranks, call % ranks.size(), cancel)));
    const std::string name = "cancelled by call " + std::to_string(call);
    CHECK_AT(own.is_cancelled(), name);
    Shapes expected;
    if(ranks.rank() == 0) {
      left = call;
      expected = detect_alone(whole, cancel);
      check_valid(whole, expected, name);
    }
    check_same_on_ranks(ranks, own, expected, 0, name);
  }
}

// mpirun ends the others, so none of them writes.
void be_killed(const Ranks& ranks)
{
  failure_with_callback(ranks, ranks.size() - 1, [](double fraction) {
    if(CGAL::Tandem::stage_at(fraction) == CGAL::Tandem::Detection_stage::rounds)
      std::raise(SIGKILL);
    return true;
  });
  std::cout << "a rank has gone on" << std::endl;
}

// Whatever table one rank cannot have.
void test_lost_tables(const Ranks& ranks, int stride)
{
  const Cloud part = make_case().part(ranks);
  const auto list = np::settings(make_case().parameters);
  constexpr long all = 1000000;
  tables_left = all;
  detect_with(ranks, part, list);
  long tables = all - tables_left.exchange(-1);
  MPI_Allreduce(MPI_IN_PLACE, &tables, 1, MPI_LONG, MPI_MIN, ranks);
  CHECK_AT(tables > 200, std::to_string(tables) + " tables");
  for(long lost = 0; lost < tables; lost += 1 + stride * tables / 40)
    for(const int bad : first_and_last(ranks)) {
      tables_left = ranks.rank() == bad ? lost : -1;
      const std::string found = failure_of([&] { detect_with(ranks, part, list); });
      tables_left = -1;
      check_failure(ranks, found, {"bad_alloc"}, "table " + std::to_string(lost));
    }
}

// Where each rank has memory for a quarter of the cloud, many ranks detect what one cannot.
void test_bounded_memory(const Ranks& ranks)
{
  Dealt_case c = make_case();
  c.cloud = to_cloud(scenes::make_scene("cube", scene_options(800000, .001, .1)));
  c.parameters = make_parameters(.01, 300);
  const Cloud part = c.part(ranks), whole = ranks.rank() == 0 ? c.whole(ranks) : Cloud();
  c.cloud = Cloud();
  CHECK(sum_over(ranks, compare_with_one(ranks, {make_case()})) >= 6); // MPI has taken its memory
  const Shapes expected = ranks.rank() == 0 ? detect(whole, c.parameters) : Shapes();
  const std::size_t bytes = sum_over(ranks, expected.statistics().peak_bytes) / 4;
  CHECK(bytes > 10000000);
  malloc_trim(0);
  rlimit before;
  getrlimit(RLIMIT_AS, &before);
  const rlimit limit = {CGAL::Tandem::benchmark::status_bytes("VmSize") + bytes, before.rlim_max};
  setrlimit(RLIMIT_AS, &limit);
  const std::string alone = ranks.rank() == 0 ? failure_of([&] { detect(whole, c.parameters); }) : "bad_alloc";
  CHECK_AT(alone.find("bad_alloc") != std::string::npos, alone);
  malloc_trim(0);
  Shapes own;
  const std::string found = failure_of([&] { own = detect_with(ranks, part, np::settings(c.parameters)); });
  setrlimit(RLIMIT_AS, &before);
  CHECK_AT(found == "nothing", found);
  check_same_on_ranks(ranks, own, expected, 0, "bounded memory");
}

// Refused for what one rank cannot see by itself, and for each field of the last rank, with the same reason on all ranks.
void test_corrupted_results(const Ranks& ranks, int)
{
  const Cloud part = make_case().part(ranks);
  const auto list = np::point_map(First<Kernel>()).normal_map(Second<Kernel>()).communicator(ranks);
  const Shapes shapes = detect_with(ranks, part, np::settings(make_case().parameters));
  const int last = ranks.size() - 1;
  const auto reason = [&](const Data& data, const std::string& name) {
    std::string why;
    const Shapes checked(ranks.rank() == last ? data : shapes.data());
    const std::string failure = failure_of([&] { CGAL::Tandem::is_valid_result(part, checked, list, &why); });
    check_failure(ranks, failure, {"nothing"}, name);
    check_failure(ranks, why, {}, name);
    return why;
  };
  CHECK(reason(shapes.data(), "the result").empty());
  Data plane = shapes.data(), neighbors = shapes.data();
  plane.coefficients[0][3] = std::nextafter(plane.coefficients[0][3], 9.);
  ++neighbors.parameters.k_neighbors;
  for(const Data& data : {plane, neighbors})
    CHECK(last == 0 || reason(data, "a field").find("different") != std::string::npos);
  std::size_t checked = 0, refused = 0;
  for(;; ++checked) {
    Data data = shapes.data();
    data.points = shapes.point_groups();
    int is_any = Corruption(data, checked).is_made();
    MPI_Bcast(&is_any, 1, MPI_INT, last, ranks);
    if(!is_any)
      break;
    refused += !reason(data, "corruption " + std::to_string(checked)).empty();
  }
  CHECK_AT(checked > 200 && refused > checked * 7 / 10, std::to_string(refused) + " of " + std::to_string(checked));
}

// Other results are accepted: of estimated normals, where only the last rank has points, and of no points at all.
void test_other_results(const Ranks& ranks, int)
{
  Cloud cloud = make_case().cloud;
  cloud.emplace_back(Kernel::Point_3(NAN, 0, 0), Kernel::Vector_3(0, 0, 1));
  const auto list = np::point_map(First<Kernel>()).communicator(ranks);
  for(const Cloud& all : {cloud, Cloud()}) {
    const Cloud part = ranks.rank() == ranks.size() - 1 ? all : Cloud();
    const Shapes shapes =
      CGAL::Tandem::detect_planes<Mpi_tag<CGAL::Sequential_tag>>(part, list.settings(make_parameters(.01, 30)));
    CHECK(shapes.number_of_shapes() >= (all.empty() ? 0 : 6));
    std::string why;
    CHECK_AT(CGAL::Tandem::is_valid_result(part, shapes, list, &why), why);
  }
}

int main(int argc, char** argv)
{
  check_throws<std::logic_error>([] { detect<Mpi_tag<CGAL::Sequential_tag>>(Cloud(), Parameters()); },
                                 {"MPI is not initialized"}, __LINE__);
  const boost::mpi::environment environment(argc, argv, boost::mpi::threading::funneled);
  const Ranks world;
  const std::string what = argc > 1 ? argv[1] : "";
  if(what == "killed")
    be_killed(world);
  else if(what == "memory")
    test_bounded_memory(world);
  else {
    const int stride = what == "few" ? 7 : 1;
    for(const auto test : {test_parameters, test_different_parameters, test_normals_of_some_ranks, test_maps,
                           test_extent, test_lost_tables, test_throwing_callbacks, test_class_after_exception,
                           test_cancellation, test_corrupted_results, test_other_results}) {
      test(world, stride);
      CHECK(sum_over(world, compare_with_one(world, {make_case()})) >= 6); // the ranks are as they were before
    }
  }
  return report_on(world);
}
