// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_OUTPUT_FILE_H
#define DETECT_PLANES_OUTPUT_FILE_H

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

namespace program {

// A file that appears under its name only when it is complete: it is written beside
// it and renamed by commit(). Devices and pipes are written to directly.
class Output_file {
public:
  explicit Output_file(const std::string& path) : name(path)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if(fs::is_directory(status))
      throw std::runtime_error(path + ": is a directory");
    const bool is_device = fs::exists(status) && !fs::is_regular_file(status);
    // A link stays a link.
    target = fs::exists(status) ? fs::canonical(path) : fs::path(path);
    written = target;
    if(!is_device)
      written += ".part" + std::to_string(std::random_device()());
    errno = 0;
    out.open(written, std::ios::binary);
    if(!out)
      fail("cannot be written");
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  ~Output_file() { remove_part(); }

  std::ostream& stream() { return out; }

  // Everything is on its way to the disk; throws if some of it could not be written.
  void close()
  {
    errno = 0;
    out.flush();
    if(!out)
      fail("cannot be written completely");
    out.close();
    if(!out)
      fail("cannot be written completely");
  }

  void commit()
  {
    if(written == target)
      return;
    std::error_code error;
    std::filesystem::rename(written, target, error);
    if(error)
      throw std::runtime_error(name + ": cannot be written (" + error.message() + ")");
    written = target;
  }

private:
  void fail(const std::string& what)
  {
    const std::string reason = errno != 0 ? std::string(" (") + std::strerror(errno) + ")" : std::string();
    remove_part();
    throw std::runtime_error(name + ": " + what + reason);
  }

  void remove_part()
  {
    if(written == target)
      return;
    out.close();
    std::error_code error;
    std::filesystem::remove(written, error);
    written = target;
  }

  std::string name;
  std::filesystem::path target, written;
  std::ofstream out;
};

} // namespace program

#endif // DETECT_PLANES_OUTPUT_FILE_H
