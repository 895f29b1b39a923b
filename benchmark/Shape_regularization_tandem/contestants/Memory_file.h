// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file in memory, by which a process hands values and vectors to another one of
// the same program.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_MEMORY_FILE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_MEMORY_FILE_H

#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

namespace CGAL {
namespace Tandem {
namespace benchmark {

class Memory_file {
public:
  Memory_file() : descriptor_(memfd_create("tandem_benchmark", 0)), owns_(true)
  {
    if(descriptor_ < 0)
      throw std::runtime_error("no file in memory can be made");
  }

  // Of the parent.
  explicit Memory_file(int descriptor) : descriptor_(descriptor), owns_(false) { rewind(); }

  Memory_file(const Memory_file&) = delete;
  Memory_file& operator=(const Memory_file&) = delete;
  ~Memory_file()
  {
    if(owns_)
      close(descriptor_);
  }

  int descriptor() const { return descriptor_; }
  void rewind() { lseek(descriptor_, 0, SEEK_SET); }

  template <class T>
  void put(const T& value)
  {
    static_assert(std::is_trivially_copyable<T>::value, "The value is copied as bytes.");
    put_bytes(&value, sizeof value);
  }
  template <class T>
  void put(const std::vector<T>& values)
  {
    put(values.size());
    put_bytes(values.data(), values.size() * sizeof(T));
  }
  void put(const std::string& text) { put(std::vector<char>(text.begin(), text.end())); }

  template <class T>
  void get(T& value)
  {
    get_bytes(&value, sizeof value);
  }
  template <class T>
  void get(std::vector<T>& values)
  {
    std::size_t size = 0;
    get(size);
    values.resize(size);
    get_bytes(values.data(), size * sizeof(T));
  }
  void get(std::string& text)
  {
    std::vector<char> characters;
    get(characters);
    text.assign(characters.begin(), characters.end());
  }

private:
  void put_bytes(const void* data, std::size_t size)
  {
    transfer(size,
             [&](std::size_t done) { return write(descriptor_, static_cast<const char*>(data) + done, size - done); });
  }
  void get_bytes(void* data, std::size_t size)
  {
    transfer(size, [&](std::size_t done) { return read(descriptor_, static_cast<char*>(data) + done, size - done); });
  }

  template <class Step>
  static void transfer(std::size_t size, Step step)
  {
    for(std::size_t done = 0; done < size;) {
      const ssize_t bytes = step(done);
      if(bytes <= 0)
        throw std::runtime_error("the file in memory ends early or is full");
      done += std::size_t(bytes);
    }
  }

  int descriptor_;
  bool owns_;
};

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_MEMORY_FILE_H
