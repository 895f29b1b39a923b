// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What names of files tell: the file itself, and its format.

#ifndef DETECT_PLANES_FILE_NAMES_H
#define DETECT_PLANES_FILE_NAMES_H

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <system_error>
#include <vector>

namespace program {

template <class Item, class Items = std::initializer_list<const char*>>
bool is_in(const Item& item, const Items& items)
{
  return std::find(items.begin(), items.end(), item) != items.end();
}

// The file that a chain of links leads to, whether that exists or not.
inline std::filesystem::path follow_links(std::filesystem::path path)
{
  namespace fs = std::filesystem;
  constexpr int largest_length = 40; // as in Linux; more are a loop
  std::error_code error;
  for(int i = 0; i < largest_length && fs::is_symlink(fs::symlink_status(path, error)); ++i)
    path = path.parent_path() / fs::read_symlink(path, error);
  return path;
}

// The same for all names of a file, or of a folder, whether that exists or not.
inline std::filesystem::path unique_name(const std::filesystem::path& path)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path name = fs::absolute(follow_links(path), error);
  const fs::path resolved = fs::weakly_canonical(name, error);
  const fs::path unique = error ? name.lexically_normal() : resolved; // a loop of links, for example
  return unique.has_filename() ? unique : unique.parent_path();       // without the slash that new/.. leaves
}

inline std::string lower_case_extension(const std::filesystem::path& path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

constexpr const char* city_json = ".city.json";

// Whether it has a name before the extension, which may have several parts.
inline bool ends_in(const std::filesystem::path& path, const std::string& extension)
{
  const std::string name = path.filename().string();
  return name.size() > extension.size() && boost::iends_with(name, extension);
}

inline bool is_geojson(const std::string& path) { return is_in(lower_case_extension(path), {".geojson", ".json"}); }

inline bool is_gzip(const std::string& path) { return lower_case_extension(path) == ".gz"; }

constexpr std::array<const char*, 8> table_extensions = {".xyz", ".txt",  ".csv",    ".pts",
                                                         ".pwn", ".xyzn", ".xyzrgb", ".asc"};
constexpr std::array<const char*, 7> output_extensions = {".ply", ".las", ".laz", ".pcd", ".xyz", ".txt", ".csv"};

// With commas between them.
inline std::string table_names()
{
  return boost::join(std::vector<std::string>(table_extensions.begin(), table_extensions.end()), ", ");
}

inline bool is_table(const std::string& extension) { return is_in(extension, table_extensions); }
inline bool is_las(const std::string& extension) { return is_in(extension, {".las", ".laz"}); }

// Whether files with these extensions can have the same points.
inline bool is_same_format(const std::string& a, const std::string& b)
{
  return a == b || (is_las(a) && is_las(b)) || (is_table(a) && is_table(b));
}

// Of a cloud that is read.
inline bool is_input_extension(const std::string& extension)
{
  return is_table(extension) || is_las(extension) || is_in(extension, {".ply", ".pcd", ".off", ".ptx"});
}

// The extension that a file is read by: that of --format, or its own, .ply of cloud.ply.gz.
inline std::string input_format(const std::filesystem::path& path, const std::string& format)
{
  return !format.empty() ? format : lower_case_extension(is_gzip(path.string()) ? path.stem() : path);
}

// Devices and pipes without an extension get PLY.
inline std::string output_extension(const std::string& path)
{
  namespace fs = std::filesystem;
  const std::string extension = lower_case_extension(path);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const bool is_special = fs::exists(status) && !fs::is_regular_file(status);
  return extension.empty() && (is_special || path.compare(0, 5, "/dev/") == 0) ? ".ply" : extension;
}

inline bool is_known_output(const std::string& path) { return is_in(output_extension(path), output_extensions); }

// Of --output-directory: the name of the input, without .gz, and with .ply in place of what is not written.
inline std::string output_of_input(const std::string& directory, const std::string& input)
{
  std::filesystem::path name = std::filesystem::path(input).filename();
  if(is_gzip(input))
    name = name.stem();
  if(!is_in(lower_case_extension(name), output_extensions))
    name.replace_extension(".ply");
  return (directory / name).string();
}

} // namespace program

#endif // DETECT_PLANES_FILE_NAMES_H
