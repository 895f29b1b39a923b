// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that appear under their names only when they are complete, and the folders that are made for them.

#ifndef DETECT_PLANES_OUTPUT_FILE_H
#define DETECT_PLANES_OUTPUT_FILE_H

#include "errors.h"
#include "file_names.h"
#include "signals.h"

#include <fstream>
#include <memory>
#include <optional>
#include <ostream>
#include <random>
#include <streambuf>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#define DETECT_PLANES_HAS_DESCRIPTORS
#endif

namespace program {

// --- Why something could not be written. A stream tells only that, and maybe much later, when errno has another value.

// In brackets, for the end of a message.
inline std::string reason_of(int error) { return std::string(" (") + std::strerror(error != 0 ? error : EIO) + ")"; }

// The value that errno had at the first failure.
class Write_error {
public:
  int error() const { return first; }

protected:
  void keep_error() { first = first != 0 ? first : errno; }

private:
  int first = 0;
};

// A file that keeps it.
class File_buffer : public std::filebuf, public Write_error {
protected:
  int_type overflow(int_type c) override
  {
    const int_type result = std::filebuf::overflow(c);
    if(traits_type::eq_int_type(result, traits_type::eof()))
      keep_error();
    return result;
  }

  std::streamsize xsputn(const char* text, std::streamsize size) override
  {
    const std::streamsize written = std::filebuf::xsputn(text, size);
    if(written < size)
      keep_error();
    return written;
  }

  int sync() override
  {
    const int result = std::filebuf::sync();
    if(result != 0)
      keep_error();
    return result;
  }
};

#ifdef DETECT_PLANES_HAS_DESCRIPTORS

// Writes to a descriptor that the shell has opened, from where that stands. To open the file once more would start at
// its beginning, and overwrite what was or will be written there.
class Descriptor_buffer : public std::streambuf, public Write_error {
public:
  explicit Descriptor_buffer(int opened) : descriptor(dup(opened)) { reset(); }
  ~Descriptor_buffer() override { ::close(descriptor); }
  Descriptor_buffer(const Descriptor_buffer&) = delete;
  Descriptor_buffer& operator=(const Descriptor_buffer&) = delete;

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
      if(n < 0 && errno != EINTR) {
        keep_error();
        return -1;
      }
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

// The file as the shell has opened it for writing: /dev/stdout, /dev/fd/3, or a name that is also the target of a
// redirection. Null if it has not.
inline std::unique_ptr<Descriptor_buffer> opened_by_shell(const std::string& path)
{
  constexpr int largest_descriptor_of_shells = 255;
  struct stat file, opened;
  if(stat(path.c_str(), &file) != 0)
    return nullptr;
  for(int d = 0; d <= largest_descriptor_of_shells; ++d)
    if(fstat(d, &opened) == 0 && opened.st_dev == file.st_dev && opened.st_ino == file.st_ino &&
       (fcntl(d, F_GETFL) & O_ACCMODE) != O_RDONLY)
      return std::make_unique<Descriptor_buffer>(d);
  return nullptr;
}

// A new file that only its owner may read.
inline bool create_private(const char* path)
{
  const int descriptor = ::open(path, O_WRONLY | O_CREAT | O_EXCL, S_IRUSR | S_IWUSR);
  return descriptor >= 0 && ::close(descriptor) == 0;
}

#else

class Descriptor_buffer : public std::streambuf, public Write_error {};

inline std::unique_ptr<Descriptor_buffer> opened_by_shell(const std::string&) { return nullptr; }

inline bool create_private(const char*) { return true; }

#endif

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
      throw_error(path, ": is a directory");
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
  [[noreturn]] void fail(const char* what, int error) const { throw_error(name, ": ", what, reason_of(error)); }

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
      throw_error(path.string(), ": cannot be made (", error.message(), ")");
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

#endif // DETECT_PLANES_OUTPUT_FILE_H
