// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_LINKS_H
#define DETECT_PLANES_LINKS_H

#include <filesystem>
#include <system_error>

namespace program {

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

} // namespace program

#endif // DETECT_PLANES_LINKS_H
