// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where memory ends, no partial file is left, and the error is reported all the same.

#include "testing/checks.h"

#include "output/Output_file.h"
#include "messages.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <random>
#include <sstream>
#include <streambuf>
#include <string>
#include <string_view>

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

BOOST_NOINLINE void operator delete(void* memory) noexcept { std::free(memory); }
BOOST_NOINLINE void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

BOOST_AUTO_TEST_SUITE(test_output_file)

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

// Of the test.
struct Folder {
  std::filesystem::path folder =
    std::filesystem::temp_directory_path() / ("test_output_file_" + std::to_string(std::random_device()()));

  Folder() { std::filesystem::create_directory(folder); }
  ~Folder() { std::filesystem::remove_all(folder); }
};

BOOST_FIXTURE_TEST_CASE(no_memory, Folder)
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

BOOST_FIXTURE_TEST_CASE(complete_files, Folder)
{
  {
    program::Output_file file((folder / "complete").string());
    file.write([](std::ostream& out) { out << "text"; });
    CHECK(!std::filesystem::exists(folder / "complete"));
    file.commit();
  }
  CHECK(std::filesystem::file_size(folder / "complete") == 4);
  CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
}

// Folders that were made go again, in whatever way they are named, unless they are kept or something is in them.
BOOST_FIXTURE_TEST_CASE(made_folders, Folder)
{
  namespace fs = std::filesystem;
  fs::create_directory(folder / "old");
  for(const char* name : {"new", "new/", "old/new/one", "old/../new/one/two/", "old/./new", "old"}) {
    {
      program::Made_folders folders;
      folders.make(folder / name);
      CHECK_AT(fs::is_directory(folder / name), name);
    }
    CHECK_AT(!fs::exists(folder / "new") && fs::is_empty(folder / "old"), name);
  }
  {
    program::Made_folders folders;
    folders.make(folder / "new/kept");
    folders.keep();
    folders.make(folder / "new/kept/file/none");
    program::Output_file file((folder / "new/kept/file/text").string());
    file.write([](std::ostream&) {});
    file.commit();
  }
  CHECK(fs::exists(folder / "new/kept/file/text") && !fs::exists(folder / "new/kept/file/none"));
}

// A file that is replaced keeps its mode, also as long as it is written.
BOOST_FIXTURE_TEST_CASE(modes, Folder)
{
  namespace fs = std::filesystem;
  const fs::path path = folder / "private";
  for(int mode : {0600, 0640, 0400, 0777}) {
    program::Output_file first(path.string());
    first.write([](std::ostream&) {});
    first.commit();
    fs::permissions(path, fs::perms(mode));
    program::Output_file file(path.string());
    for(const fs::directory_entry& entry : fs::directory_iterator(folder))
      CHECK_AT(entry.status().permissions() == fs::perms(mode), entry.path().string());
    file.write([](std::ostream&) {});
    file.commit();
    CHECK_AT(fs::status(path).permissions() == fs::perms(mode), std::to_string(mode));
  }
}

// Shows what was written without memory.
class Fixed_buffer : public std::streambuf {
public:
  Fixed_buffer() { setp(text_.data(), text_.data() + text_.size()); }
  std::string written() const { return std::string(pbase(), pptr()); }

private:
  std::array<char, 256> text_;
};

BOOST_AUTO_TEST_CASE(message_without_memory)
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
             "detect_planes: a message of two lines,\\x0awhich is too long for a short string (and advice)\n",
           buffer.written());
}

std::string visible(std::string_view text)
{
  std::ostringstream out;
  program::write_visible(out, text);
  return out.str();
}

BOOST_AUTO_TEST_CASE(visible_text)
{
  using namespace std::string_literals;
  for(const char* text :
      {"", "cloud.ply", "W\u00e4nde", "\u20ac \u4e2d \U0001f600", "\u00a0\u07ff\u0800\ud7ff\ue000\U0010ffff"})
    CHECK_AT(visible(text) == text, text);
  CHECK(visible("\0\x1b[31m\a\r\n\t\x7f"s) == "\\x00\\x1b[31m\\x07\\x0d\\x0a\\x09\\x7f");
  CHECK(visible("\xc2\x9b[31m") == "\\xc2\\x9b[31m"); // U+009B, which begins a sequence as ESC [ does
  // Bytes of no character: continuations, forms that are too long, surrogates, beyond the last one, cut off
  for(std::string text :
      {"\x80", "\x9b", "\xff", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf",
       "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xc3", "\xe2\x82", "\xf0\x9f\x98"}) {
    const std::string shown = visible("a" + text + "b");
    CHECK_AT(shown.size() == 4 * text.size() + 2 && shown.front() == 'a' && shown.back() == 'b', shown);
  }
}

BOOST_AUTO_TEST_SUITE_END()
