// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where memory ends, no partial file is left, and the error is reported all the same.

#undef NDEBUG

#include "testing/checks.h"

#include "output/Output_file.h"
#include "fail.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <random>
#include <streambuf>
#include <string>

constexpr int no_limit = std::numeric_limits<int>::max();
int allocations_left = no_limit;

void* operator new(std::size_t size)
{
  void* memory = allocations_left > 0 ? std::malloc(size) : nullptr;
  if(memory == nullptr)
    throw std::bad_alloc();
  if(allocations_left != no_limit)
    --allocations_left;
  return memory;
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

// Whether the file could be opened with this number of allocations.
bool opens(const std::string& path, int allocations)
{
  allocations_left = allocations;
  bool is_open = false;
  try {
    program::Output_file file(path);
    is_open = true;
  } catch(const std::bad_alloc&) {
  }
  allocations_left = no_limit;
  return is_open;
}

void test_constructor(const std::filesystem::path& folder)
{
  const std::string path = (folder / "a name that is too long to be stored within a string.ply").string();
  int n = 0;
  while(n < 1000 && !opens(path, n)) {
    CHECK_AT(std::filesystem::is_empty(folder), std::to_string(n));
    ++n;
  }
  CHECK_AT(n > 2 && n < 1000, std::to_string(n));
  CHECK(std::filesystem::is_empty(folder)); // not committed
}

void test_commit(const std::filesystem::path& folder)
{
  {
    program::Output_file file((folder / "complete").string());
    file.stream() << "text";
    file.close();
    CHECK(!std::filesystem::exists(folder / "complete"));
    file.commit();
  }
  CHECK(std::filesystem::file_size(folder / "complete") == 4);
  std::filesystem::remove(folder / "complete");
  CHECK(std::filesystem::is_empty(folder));
}

// Shows what was written without memory.
class Fixed_buffer : public std::streambuf {
public:
  Fixed_buffer() { setp(text.data(), text.data() + text.size()); }
  std::string written() const { return std::string(pbase(), pptr()); }

private:
  std::array<char, 256> text;
};

void test_fail()
{
  Fixed_buffer buffer;
  std::streambuf* previous = std::cerr.rdbuf(&buffer);
  allocations_left = 0;
  bool has_thrown = false;
  int code = 0;
  try {
    code = program::fail(7, "a message of two lines,\nwhich is too long for a short string", " (and advice)");
  } catch(const std::bad_alloc&) {
    has_thrown = true;
  }
  allocations_left = no_limit;
  std::cerr.rdbuf(previous);
  CHECK(!has_thrown && code == 7);
  CHECK_AT(buffer.written() ==
             "detect_planes: a message of two lines, which is too long for a short string (and advice)\n",
           buffer.written());
}

int main()
{
  const std::filesystem::path folder =
    std::filesystem::temp_directory_path() / ("test_output_file_" + std::to_string(std::random_device()()));
  std::filesystem::create_directory(folder);
  test_constructor(folder);
  test_commit(folder);
  std::filesystem::remove_all(folder);
  test_fail();
  return report();
}
