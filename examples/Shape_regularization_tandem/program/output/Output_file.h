// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_OUTPUT_FILE_H
#define DETECT_PLANES_OUTPUT_FILE_H

#include "output/Descriptor_buffer.h"
#include "output/Partial_file.h"
#include "links.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <ostream>
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
    if(!fs::exists(status) || fs::is_regular_file(status)) {
      target = follow_links(path);
      part.emplace(target.parent_path());
    }
    errno = 0;
    if(!file.open(part ? part->name() : fs::path(path), std::ios::out | std::ios::binary))
      fail("cannot be written");
    out.rdbuf(&file);
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

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
    if(!part)
      return;
    std::error_code error;
    part->rename(target, error);
    if(error)
      throw std::runtime_error(name + ": cannot be written (" + error.message() + ")");
  }

private:
  void fail(const std::string& what)
  {
    const std::string reason = errno != 0 ? std::string(" (") + std::strerror(errno) + ")" : std::string();
    throw std::runtime_error(name + ": " + what + reason);
  }

  std::string name;
  std::filesystem::path target;
  std::optional<Partial_file> part;
  std::filebuf file; // closed before the partial file is removed
  std::unique_ptr<std::streambuf> opened;
  std::ostream out;
};

} // namespace program

#endif // DETECT_PLANES_OUTPUT_FILE_H
