// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_MADE_FOLDERS_H
#define DETECT_PLANES_MADE_FOLDERS_H

#include "signals.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace program {

// The folders that a run has made. They go with it if it fails, also by a signal, unless something is in them.
class Made_folders {
public:
  Made_folders() = default;
  Made_folders(const Made_folders&) = delete;
  Made_folders& operator=(const Made_folders&) = delete;

  ~Made_folders()
  {
    for(auto folder = made.rbegin(); folder != made.rend(); ++folder) {
      std::error_code error;
      std::filesystem::remove(folder->path, error);
    }
    keep();
  }

  // With the folders above it. Other processes may make the same ones.
  void make(const std::filesystem::path& path)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    std::vector<fs::path> missing;
    for(fs::path p = path; !p.empty() && !fs::exists(p, error); p = p.parent_path())
      missing.push_back(p);
    for(auto p = missing.rbegin(); p != missing.rend(); ++p) {
      made.push_back({*p, nullptr});
      if(fs::create_directory(*p, error))
        made.back().entry = remove_at_signal(p->string());
      else
        made.pop_back();
    }
    fs::create_directories(path, error);
    if(error)
      throw std::runtime_error(path.string() + ": cannot be made (" + error.message() + ")");
  }

  void keep()
  {
    for(const Folder& folder : made)
      if(folder.entry != nullptr)
        folder.entry->is_set = false;
    made.clear();
  }

private:
  struct Folder {
    std::filesystem::path path;
    Removed_name* entry;
  };
  std::vector<Folder> made; // each after the one that it is in
};

} // namespace program

#endif // DETECT_PLANES_MADE_FOLDERS_H
