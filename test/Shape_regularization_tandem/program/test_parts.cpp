// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts of the program of which no run tells: what it does where memory ends, what it says where it was built without
// something, and how it shares files among processes and leaves points out of the page.

#include "testing/checks.h"

#include "../cloud_warnings.h"
#include "messages.h"
#include "output/Output_file.h"
#include "program_options.h"
#include "ranks/Processes.h"
#include "view/write_points.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <vector>

// Of all tests of the folder; only these here set a limit.
constexpr int no_limit = std::numeric_limits<int>::max();
static int allocations_left = no_limit;

BOOST_NOINLINE void* operator new(std::size_t size)
{
  void* memory = allocations_left > 0 ? std::malloc(size) : nullptr;
  if(memory == nullptr)
    throw std::bad_alloc();
  if(allocations_left != no_limit)
    --allocations_left;
  return memory;
}

// Without a limit, but from where it is freed to.
BOOST_NOINLINE void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return std::malloc(size); }

BOOST_NOINLINE void operator delete(void* memory) noexcept { std::free(memory); }
BOOST_NOINLINE void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

BOOST_AUTO_TEST_SUITE(test_parts)

bool has(const std::string& text, const std::string& word) { return text.find(word) != text.npos; }

// --- Where memory ends

// Whether f() needs no more allocations than that.
template <class F>
bool are_enough(int allocations, const F& f)
{
  allocations_left = allocations;
  const bool are_too_few = throws<std::bad_alloc>(f);
  allocations_left = no_limit;
  return !are_too_few;
}

BOOST_AUTO_TEST_CASE(no_partial_file_is_left)
{
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("test_parts_" + std::to_string(std::random_device()()));
  fs::create_directory(folder);
  const std::string path = (folder / "a name that is too long to be stored within a string.ply").string();
  int n = 0;
  for(; n < 1000 && !are_enough(n, [&] { program::Output_file file(path); }); ++n)
    CHECK_AT(fs::is_empty(folder), std::to_string(n));
  CHECK_AT(n > 2 && n < 1000, std::to_string(n));
  CHECK(fs::is_empty(folder)); // not committed
  fs::remove_all(folder);
}

BOOST_AUTO_TEST_CASE(message_without_memory)
{
  std::stringbuf buffer(std::string(256, ' '), std::ios::out);
  std::streambuf* previous = std::cerr.rdbuf(&buffer);
  int code = 0;
  const bool is_written = are_enough(
    0, [&] { code = program::fail(7, "a message of two lines,\nwhich is too long for a short string", " (advice)"); });
  std::cerr.rdbuf(previous);
  CHECK(is_written && code == 7);
  CHECK_AT(buffer.str().find("detect_planes: a message of two lines,\\x0awhich is too long for a short string "
                             "(advice)\n") == 0,
           buffer.str());
}

// --- Help and messages do not offer what the program was built without; the options stay known, so
// that a run can say why they are refused.

std::string text_of(std::vector<const char*> words, const program::Built_with& built)
{
  words.insert(words.begin(), "detect_planes");
  try {
    return program::parse(int(words.size()), words.data(), built).help;
  } catch(const program::Usage_error& e) {
    return e.what();
  }
}

BOOST_AUTO_TEST_CASE(offers)
{
  const program::Built_with all, nothing = {false, false, false, false, false, false};
  const auto check = [&](const char* option, const char* input, const char* word) {
    CHECK_AT(has(text_of({input, option}, all), word), word);
    CHECK_AT(!has(text_of({input, option}, nothing), word), word);
  };
  for(const char* word :
      {"sequential, parallel", "cuda", "mpirun", "of each process", "processes", ".gz", ".laz", "--view ", "browser"})
    check("--help", "all", word);
  check("--backend=foo", "cloud.ply", "parallel");
  check("--backend=foo", "cloud.ply", "cuda");
  check("--output=a.foo", "cloud.ply", ".laz");
  check("--format=foo", "cloud.ply", "laz");
  check("--help", "cloud.ply", "--view ");
  CHECK(text_of({"cloud.ply", "--view=v.html"}, nothing) == text_of({"--help"}, nothing));
}

// --- Files are shared among processes by their sizes: they keep their order, and no process is off its part by more
// than the largest file.

BOOST_AUTO_TEST_CASE(shares_of_files)
{
  CHECK(program::share_files({}, 3).empty());
  CHECK(program::share_files({0, 0, 0, 0}, 2) == std::vector<int>({0, 0, 1, 1})); // not there
  std::vector<std::uint64_t> bytes;
  for(std::uint64_t i = 0; i < 100; ++i)
    bytes.push_back(1 + i * 7919 % 1000 * (i % 11 == 0 ? 1000 : 1));
  const double sum = double(std::accumulate(bytes.begin(), bytes.end(), std::uint64_t(0)));
  for(int processes = 1; processes < 120; processes += 7) {
    const std::vector<int> rank_of = program::share_files(bytes, processes);
    CHECK(std::is_sorted(rank_of.begin(), rank_of.end()));
    std::vector<double> load(std::size_t(processes), 0);
    for(std::size_t file = 0; file < bytes.size(); ++file)
      load.at(std::size_t(rank_of.at(file))) += double(bytes[file]);
    for(double part : load)
      CHECK_AT(std::fabs(part - sum / processes) <= double(*std::max_element(bytes.begin(), bytes.end())) + 100,
               std::to_string(processes));
  }
}

// --- The ratio of points in shapes, in which no point at 0 0 0 counts twice, and noise that cannot be measured

// Of 1000 points 100 are in shapes and 600 at 0 0 0, far from the others; zeros says where these are counted.
void check_ratio(std::size_t CGAL::Tandem::Statistics::*zeros)
{
  CGAL::Tandem::Statistics s;
  s.number_of_points = 1000;
  s.number_of_assigned_points = 100;
  s.number_of_ignored_coordinates = 50;
  s.free_points.clutter = 850;
  if(zeros != nullptr) {
    s.*zeros = 600;
    s.free_points.clutter = 250;
  }
  CHECK(tandem_examples::ratio_in_shapes(s, {{5, 5, 5, 9, 9, 9}, 600}) == 100. / 350);
  CHECK(tandem_examples::ratio_in_shapes(s, {{5, 5, 5, 9, 9, 9}, 0}) == 100. / double(100 + s.free_points.clutter));
}

// Another rank has measured .25.
struct Two_ranks : program::Processes {
  int size() const override { return 2; }
  double largest(double own) const override { return (std::max)(own, -.25); }
};

BOOST_AUTO_TEST_CASE(ratio_and_noise)
{
  using Statistics = CGAL::Tandem::Statistics;
  check_ratio(nullptr);
  for(auto zeros : {&Statistics::number_of_far_points, &Statistics::number_of_ignored_normals,
                    &Statistics::number_of_ignored_tolerances})
    check_ratio(zeros);
  CHECK(tandem_examples::smallest_noise([] { return .125; }, Two_ranks()) == .125);
  // It goes on, and takes part in what all ranks do.
  CHECK(tandem_examples::smallest_noise([]() -> double { throw std::bad_alloc(); }, Two_ranks()) == .25);
}

// --- The points of the page: one of every `stride` points of each shape, not always the same one, none twice.

BOOST_AUTO_TEST_CASE(thinned_points)
{
  constexpr std::size_t size = 30000, largest = 1000, stride = 30;
  program::Point_set points;
  std::vector<std::int32_t> shape_of;
  for(std::size_t i = 0; i < size; ++i) {
    const double x = i == 0 ? std::numeric_limits<double>::quiet_NaN() : double(i); // the first has no place
    points.insert(program::Kernel::Point_3(x, double(i % 1000), 0));
    shape_of.push_back(int(i % 3) - 1);
  }
  program::Shapes::Data data;
  data.shape_of = std::move(shape_of);
  data.coefficients = {{0, 0, 1, 0}, {0, 0, 1, -1}};
  data.parallel_group = {0, 0};
  data.coplanar_group = {0, 1};
  data.is_flipped = {0, 0};
  const program::Shapes shapes(data);
  const program::Thinned_points all(points, shapes, size), some(points, shapes, largest);
  CHECK_AT(all.stride == 1 && all.size() == size - 1, std::to_string(all.size()));
  CHECK_AT(some.stride == stride && some.size() <= largest && some.size() >= largest - 1, std::to_string(some.size()));
  std::size_t next = 0, as_first = 0;
  for(std::size_t first = 0; first + stride <= all.size(); first += stride, ++next) {
    const auto begin = all.positions.begin() + std::ptrdiff_t(first), end = begin + std::ptrdiff_t(stride);
    const auto found = std::find(begin, end, some.positions[next]);
    CHECK_AT(found != end, std::to_string(first));
    as_first += found == begin;
  }
  CHECK_AT(as_first > 5 && as_first < 100, std::to_string(as_first));
  for(std::size_t s = 0; s < 3; ++s)
    CHECK_AT(some.shown[s] >= 330 && some.shown[s] <= 336, std::to_string(some.shown[s]));
}

BOOST_AUTO_TEST_SUITE_END()
