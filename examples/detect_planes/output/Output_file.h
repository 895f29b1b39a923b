// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that appear under their names only when they are complete, and the folders that are made for them.

#ifndef DETECT_PLANES_OUTPUT_FILE_H
#define DETECT_PLANES_OUTPUT_FILE_H

#include "errors.h"
#include "file_names.h"

#include <array>
#include <fcntl.h>
#include <list>
#include <optional>
#include <ostream>
#include <random>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace program {

// Writes to a descriptor, from where that stands, and closes it in the end.
class Descriptor_buffer : public std::streambuf {
public:
  explicit Descriptor_buffer(int descriptor = -1) : descriptor(descriptor) { reset(); }
  ~Descriptor_buffer() override { close(); }
  Descriptor_buffer(const Descriptor_buffer&) = delete;
  Descriptor_buffer& operator=(const Descriptor_buffer&) = delete;

  bool is_open() const { return descriptor >= 0; }

  bool open(const char* path, int flags, int mode)
  {
    descriptor = ::open(path, O_WRONLY | O_CREAT | flags, mode);
    return is_open();
  }

  bool close() { return !is_open() || ::close(std::exchange(descriptor, -1)) == 0; }

protected:
  int_type overflow(int_type c) override
  {
    if(sync() != 0)
      return traits_type::eof();
    if(!traits_type::eq_int_type(c, traits_type::eof()))
      sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }

  int sync() override
  {
    for(const char* next = pbase(); next != pptr();) {
      const ssize_t n = ::write(descriptor, next, std::size_t(pptr() - next));
      if(n < 0 && errno != EINTR)
        return -1;
      next += n < 0 ? 0 : n;
    }
    reset();
    return 0;
  }

private:
  void reset() { setp(buffer.data(), buffer.data() + buffer.size()); }

  int descriptor;
  std::array<char, 65536> buffer;
};

// Writes to the buffer by write(out), and closes it. A stream that has no exceptions tells that it has failed, but not
// why, and maybe much later, when errno has another value.
template <class Write>
void write_completely(const std::string& name, std::ostream& out, Descriptor_buffer& buffer, const Write& write)
try {
  errno = 0;
  out.exceptions(std::ios::badbit);
  write(out);
  out.flush();
  if(!out || !buffer.close())
    out.setstate(std::ios::badbit);
} catch(const std::ios_base::failure&) {
  throw_error(name, ": cannot be written completely", reason_of(errno));
}

// The file as the shell has opened it for writing: /dev/stdout, /dev/fd/3, or a name that is also the target of a
// redirection. To open it once more would start at its beginning, and overwrite what was or will be written there.
// Below 0 if it has not.
inline int opened_by_shell(const std::string& path)
{
  constexpr int largest_descriptor_of_shells = 255;
  struct stat file, opened;
  if(stat(path.c_str(), &file) != 0)
    return -1;
  for(int d = 0; d <= largest_descriptor_of_shells; ++d)
    if(fstat(d, &opened) == 0 && opened.st_dev == file.st_dev && opened.st_ino == file.st_ino &&
       (fcntl(d, F_GETFL) & O_ACCMODE) != O_RDONLY)
      return dup(d);
  return -1;
}

// A file or folder that is removed at the end, however that comes, unless it is kept.
class Temporary_path {
public:
  explicit Temporary_path(const std::filesystem::path& path) : path(path), entry(remove_at_signal(path.string())) {}

  Temporary_path(const Temporary_path&) = delete;
  Temporary_path& operator=(const Temporary_path&) = delete;

  ~Temporary_path()
  {
    std::error_code error;
    if(!is_kept)
      std::filesystem::remove(path, error);
    keep();
  }

  const std::filesystem::path& name() const { return path; }

  void keep()
  {
    is_kept = true;
    if(entry != nullptr)
      std::exchange(entry, nullptr)->is_set = false;
  }

private:
  std::filesystem::path path;
  Removed_name* entry;
  bool is_kept = false;
};

// The name of a file that is being written: one of its own, since one that is longer than that of the complete file may
// be too long.
inline std::filesystem::path partial_name(const std::filesystem::path& directory)
{
  return directory / ("detect_planes_" + std::to_string(std::random_device()()) + ".part");
}

// A file that appears under its name only when it is complete: it is written beside
// it and renamed by commit(). Devices, pipes, and what the shell has opened are written to directly.
class Output_file {
public:
  explicit Output_file(const std::string& path) : name(path), buffer(opened_by_shell(path)), out(&buffer)
  {
    namespace fs = std::filesystem;
    if(buffer.is_open())
      return;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if(fs::is_directory(status))
      throw_error(path, ": is a directory");
    if(status.type() == fs::file_type::none)
      fail(error.value());
    if(!fs::exists(status) || fs::is_regular_file(status)) {
      target = follow_links(path);
      part.emplace(partial_name(target.parent_path()));
    }
    errno = 0;
    const int mode = part && fs::exists(status) ? 0600 : 0666; // not everybody may read what is replaced
    if(!buffer.open((part ? part->name() : fs::path(path)).c_str(), part ? O_EXCL : O_TRUNC, mode))
      fail(errno);
    // That of the file that is replaced, before anything is in the new one.
    const fs::perms kept = status.permissions() & fs::perms::all;
    if(fs::is_regular_file(status) && (fs::status(part->name(), error).permissions() & fs::perms::all) != kept &&
       !error)
      fs::permissions(part->name(), kept, error);
    if(fs::is_regular_file(status) && error)
      fail(error.value());
  }

  // Whether it is written beside the file that it becomes, and so does not follow what was written there.
  bool replaces_file() const { return part.has_value(); }

  // Everything is on its way to the disk, or it throws.
  template <class Write>
  void write(const Write& write)
  {
    write_completely(name, out, buffer, write);
  }

  void commit()
  {
    if(!part)
      return;
    std::error_code error;
    std::filesystem::rename(part->name(), target, error);
    if(error)
      fail(error.value());
    part->keep();
  }

private:
  [[noreturn]] void fail(int error) const { throw_error(name, ": cannot be written", reason_of(error)); }

  std::string name;
  std::filesystem::path target;
  std::optional<Temporary_path> part;
  Descriptor_buffer buffer; // closed before the partial file is removed
  std::ostream out;
};

// The folders that a run has made. They go with it if it fails, also by a signal, unless something is in them.
class Made_folders {
public:
  ~Made_folders()
  {
    while(!made.empty())
      made.pop_back();
  }

  // With the folders above it. Other processes may make the same ones.
  void make(const std::filesystem::path& path)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    std::vector<fs::path> missing;
    for(fs::path p = path; !p.empty() && !fs::exists(p, error); p = p.parent_path())
      missing.push_back(p);
    for(auto p = missing.rbegin(); p != missing.rend(); ++p)
      if(fs::create_directory(*p, error))
        made.emplace_back(*p);
    fs::create_directories(path, error);
    if(error)
      throw_error(path.string(), ": cannot be made (", error.message(), ")");
  }

  void keep()
  {
    for(Temporary_path& folder : made)
      folder.keep();
    made.clear();
  }

private:
  std::list<Temporary_path> made; // each after the one that it is in
};

} // namespace program

#endif // DETECT_PLANES_OUTPUT_FILE_H
