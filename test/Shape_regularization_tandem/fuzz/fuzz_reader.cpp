// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The readers of clouds: fuzz_ply takes the bytes for a file that ends in .ply, and so on. It ends where a cloud comes out
// that the bytes cannot hold, and in text other points than its rows.

#include "input/read_cloud.h"

#include <cassert>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <unistd.h>

namespace {

// Of the smallest point, in bytes.
const std::map<std::string, double> least_sizes = {{"las", 20}, {"off", 6}, {"pcd", 3. / 88},
                                                   {"ply", 6},  {"ptx", 5}, {"xyz", 4}};

// The file, in memory where there is such a folder. Targets that run at the same time have files of their own.
class Scratch_file {
public:
  ~Scratch_file() { std::remove(path.c_str()); }

  void name(const std::string& extension)
  {
    const std::filesystem::path memory = "/dev/shm";
    const bool has_memory = access(memory.c_str(), W_OK) == 0;
    path = (has_memory ? memory : std::filesystem::temp_directory_path()) /
           ("tandem_fuzz_" + std::to_string(getpid()) + '.' + extension);
    format = extension;
  }

  void write(const std::string& bytes) const
  {
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out << bytes << std::flush;
    assert(out);
  }

  std::string path, format;
};
Scratch_file file;

// The number of points, 0 if the file is rejected.
std::size_t read_with(const program::Input_settings& settings)
{
  program::Point_set points;
  program::Input_notes notes;
  try {
    program::read_cloud(file.path, settings, false, points, notes);
  } catch(const std::exception& e) {
    if(std::string(e.what()).compare(0, file.path.size(), file.path) != 0)
      throw; // it does not name the file, as of a small one that needs more memory than there is
    return 0;
  }
  assert(!points.empty());
  const bool has_tolerances = points.has_property_map<double>(program::tolerance_name);
  assert(has_tolerances == !settings.tolerance.empty());
  return points.size();
}

// --- Rows of text

// Without empty ones and comments.
std::vector<std::string> rows_of(const std::string& text)
{
  std::vector<std::string> rows;
  std::istringstream in(text);
  for(std::string row; std::getline(in, row);) {
    const std::size_t first = row.find_first_not_of(" \t\r\v\f");
    if(first != row.npos && row[first] != '#')
      rows.push_back(row);
  }
  return rows;
}

bool is_point(const std::string& row)
{
  std::istringstream in(row);
  double x, y, z;
  return bool(in >> x >> y >> z);
}

// After names and the number of points, each row is a point. Otherwise labels would belong to other rows.
void check_table(std::vector<std::string> rows, std::size_t points)
{
  const auto is_comment = [](const std::string& row) {
    return row.compare(row.find_first_not_of(" \t\r\v\f"), 2, "//") == 0;
  };
  rows.erase(std::remove_if(rows.begin(), rows.end(), is_comment), rows.end());
  assert(points <= rows.size());
  for(std::size_t i = 0; i < rows.size() - points; ++i)
    assert(!is_point(rows[i])); // although it is passed over
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** arguments)
{
  const std::string name = (*arguments)[0];
  file.name(name.substr(name.rfind('_') + 1));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string bytes(data, data + size);
  file.write(bytes);
  const std::size_t count = read_with({});
  program::Input_settings settings;
  settings.sample = 3;
  settings.has_decimal_commas = true;
  settings.keeps_records = [](const std::string&) { return true; };
  read_with(settings);
  settings = {};
  settings.tolerance = "shape";
  const std::size_t with_tolerance = read_with(settings);
  assert(with_tolerance == 0 || with_tolerance == count);
  assert(double(count) * least_sizes.at(file.format) <= double(size + 1)); // there is room for them
  if(count > 0 && file.format == "xyz")
    check_table(rows_of(bytes.compare(0, 3, "\xEF\xBB\xBF") == 0 ? bytes.substr(3) : bytes),
                count); // the mark of UTF-8
  return 0;
}
