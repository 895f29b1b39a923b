// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_PARTIAL_FILE_H
#define DETECT_PLANES_PARTIAL_FILE_H

#include "signals.h"

#include <filesystem>
#include <random>
#include <string>
#include <system_error>

namespace program {

// The name of a file that is being written. What has not been renamed is removed at the end, however that comes.
class Partial_file {
public:
  // A name of its own, since one that is longer than that of the complete file may be too long.
  explicit Partial_file(const std::filesystem::path& directory)
    : path(directory / ("detect_planes_" + std::to_string(std::random_device()()) + ".part")),
      entry(remove_at_signal(path.string()))
  {}

  Partial_file(const Partial_file&) = delete;
  Partial_file& operator=(const Partial_file&) = delete;

  ~Partial_file()
  {
    std::error_code error;
    if(!is_renamed)
      std::filesystem::remove(path, error);
    forget();
  }

  const std::filesystem::path& name() const { return path; }

  void rename(const std::filesystem::path& target, std::error_code& error)
  {
    std::filesystem::rename(path, target, error);
    is_renamed = !error;
    if(is_renamed)
      forget();
  }

private:
  void forget()
  {
    if(entry != nullptr)
      entry->is_set = false;
    entry = nullptr;
  }

  std::filesystem::path path;
  Removed_name* entry;
  bool is_renamed = false;
};

} // namespace program

#endif // DETECT_PLANES_PARTIAL_FILE_H
