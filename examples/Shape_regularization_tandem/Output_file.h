// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_OUTPUT_FILE_H
#define DETECT_PLANES_OUTPUT_FILE_H

#include "Descriptor_buffer.h"
#include "links.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>

namespace program {

// A file that appears under its name only when it is complete: it is written beside
// it and renamed by commit(). Devices, pipes, and what the shell has opened are written to directly.
class Output_file {
public:
  explicit Output_file(const std::string& path) : name(path), opened(opened_by_shell(path)), out(opened.get())
  {
    namespace fs = std::filesystem;
    if(opened)
      return;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if(fs::is_directory(status))
      throw std::runtime_error(path + ": is a directory");
    if(status.type() == fs::file_type::none)
      throw std::runtime_error(path + ": cannot be written (" + error.message() + ")");
    target = path;
    written = target;
    if(!fs::exists(status) || fs::is_regular_file(status)) {
      target = follow_links(path);
      // A name of its own, since one that is longer than that of the file may be too long.
      written = target.parent_path() / ("detect_planes_" + std::to_string(std::random_device()()) + ".part");
    }
    errno = 0;
    if(!file.open(written, std::ios::out | std::ios::binary))
      fail("cannot be written");
    out.rdbuf(&file);
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  ~Output_file() { remove_part(); }

  std::ostream& stream() { return out; }

  // Everything is on its way to the disk; throws if some of it could not be written.
  void close()
  {
    errno = 0;
    if(!out.flush() || (file.is_open() && !file.close()))
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
    file.close();
    std::error_code error;
    std::filesystem::remove(written, error);
    written = target;
  }

  std::string name;
  std::filesystem::path target, written;
  std::filebuf file;
  std::unique_ptr<std::streambuf> opened;
  std::ostream out;
};

} // namespace program

#endif // DETECT_PLANES_OUTPUT_FILE_H
