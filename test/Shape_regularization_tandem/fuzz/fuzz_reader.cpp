// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "fuzz_reader.h"

#include "input/read_cloud.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>

#include <unistd.h>

namespace {

// In memory where there is such a folder. Targets that run at the same time have files of their own.
std::string make_path(const char* extension)
{
  const std::filesystem::path memory = "/dev/shm";
  std::error_code error;
  const bool has_memory = std::filesystem::is_directory(memory, error) && access(memory.c_str(), W_OK) == 0;
  const std::filesystem::path folder = has_memory ? memory : std::filesystem::temp_directory_path();
  return folder / ("tandem_fuzz_" + std::to_string(getpid()) + extension);
}

class Scratch_file {
public:
  explicit Scratch_file(const char* extension) : path_(make_path(extension)) {}
  ~Scratch_file() { std::remove(path_.c_str()); }
  Scratch_file(const Scratch_file&) = delete;
  Scratch_file& operator=(const Scratch_file&) = delete;

  const std::string& path() const { return path_; }

  void write(const std::uint8_t* bytes, std::size_t size) const
  {
    std::ofstream out(path_, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes), std::streamsize(size));
    expect(bool(out.flush()), "the file cannot be written");
  }

private:
  std::string path_;
};

} // namespace

void expect(bool is_true, const char* what)
{
  if(is_true)
    return;
  std::fprintf(stderr, "fuzz_reader: %s\n", what);
  std::abort();
}

namespace {

std::size_t read_with(const std::string& path, const program::Input_settings& settings)
{
  program::Point_set points;
  program::Input_notes notes;
  try {
    program::read_cloud(path, settings, false, points, notes);
  } catch(const std::bad_alloc&) {
    expect(false, "a small file needs more memory than there is");
  } catch(const std::exception& e) {
    expect(std::string(e.what()).compare(0, path.size(), path) == 0, e.what()); // names the file
    return 0;
  }
  expect(!points.empty(), "no points, and no exception");
  const bool has_tolerances = points.has_property_map<double>(program::tolerance_name);
  expect(has_tolerances == !settings.tolerance.empty(), "tolerances");
  return points.size();
}

} // namespace

// With a tolerance, as many points or none.
std::size_t read_as_file(const std::uint8_t* bytes, std::size_t size, const char* extension, double least_size)
{
  static const Scratch_file file(extension);
  file.write(bytes, size);
  const std::size_t count = read_with(file.path(), {});
  program::Input_settings settings;
  settings.sample = 3;
  settings.has_decimal_commas = true;
  read_with(file.path(), settings);
  settings = {};
  settings.tolerance = "shape";
  const std::size_t with_tolerance = read_with(file.path(), settings);
  expect(with_tolerance == 0 || with_tolerance == count, "points depend on the tolerance");
  expect(double(count) * least_size <= double(size + 1), "more points than the file has room for");
  return count;
}
