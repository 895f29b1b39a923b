// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_OUTPUT_FILE_H
#define DETECT_PLANES_OUTPUT_FILE_H

#include "output/Descriptor_buffer.h"
#include "output/Partial_file.h"
#include "output/Write_error.h"
#include "file_names.h"

#include <cerrno>
#include <filesystem>
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
      fail("cannot be written", error.value());
    if(!fs::exists(status) || fs::is_regular_file(status)) {
      target = follow_links(path);
      part.emplace(target.parent_path());
    }
    errno = 0;
    if(part && fs::exists(status) && !create_private(part->name().c_str()))
      fail("cannot be written", errno);
    if(!file.open(part ? part->name() : fs::path(path), std::ios::out | std::ios::binary))
      fail("cannot be written", errno);
    if(fs::is_regular_file(status))
      keep_mode(status.permissions() & fs::perms::all);
    out.rdbuf(&file);
  }

  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  std::ostream& stream() { return out; }

  // Everything is on its way to the disk; throws if some of it could not be written.
  void close()
  {
    errno = 0;
    if(!out.flush() || (file.is_open() && !file.close())) {
      const int kept = opened ? opened->error() : file.error();
      fail("cannot be written completely", kept != 0 ? kept : errno);
    }
  }

  void commit()
  {
    if(!part)
      return;
    std::error_code error;
    part->rename(target, error);
    if(error)
      fail("cannot be written", error.value());
  }

private:
  [[noreturn]] void fail(const char* what, int error) const
  {
    throw std::runtime_error(name + ": " + what + reason_of(error));
  }

  // That of the file that is replaced, before anything is in the new one: not everybody may read it.
  void keep_mode(std::filesystem::perms mode) const
  {
    namespace fs = std::filesystem;
    std::error_code error;
    if((fs::status(part->name(), error).permissions() & fs::perms::all) != mode && !error)
      fs::permissions(part->name(), mode, error);
    if(error)
      fail("cannot be written", error.value());
  }

  std::string name;
  std::filesystem::path target;
  std::optional<Partial_file> part;
  File_buffer file; // closed before the partial file is removed
  std::unique_ptr<Descriptor_buffer> opened;
  std::ostream out;
};

} // namespace program

#endif // DETECT_PLANES_OUTPUT_FILE_H
