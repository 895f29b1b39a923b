// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Access of functors to tables of the host: copies on the device, as the access functions of Cuda_backend make them.
// The host gets changes only by copy_back().

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_ACCESS_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_ACCESS_CUH

#include <CGAL/Tandem/internal/cuda/runtime/Table_arena.cuh>

#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// The copy of one table: in the arena if it is small, else in memory of its own. The copy exists as long as this
// object.
template <class T>
class Table_on_device {
public:
  Table_on_device(const T* table, std::size_t size, bool is_read) : bytes_(size * sizeof(T))
  {
    piece_ = arena_.take(bytes_);
    if(piece_.host != nullptr && is_read && size > 0)
      copy_on_host(piece_.host, table, bytes_);
    if(piece_.host != nullptr)
      return;
    own_.reset(size);
    if(is_read)
      copy_to_device(table, size, own_.data());
  }

  ~Table_on_device()
  {
    if(piece_.host != nullptr)
      arena_.release_piece();
  }

  Table_on_device(const Table_on_device&) = delete;
  Table_on_device& operator=(const Table_on_device&) = delete;

  T* data() const { return piece_.host != nullptr ? reinterpret_cast<T*>(piece_.device) : const_cast<T*>(own_.data()); }

  // Copies the items back to a table of the same size, and waits for them.
  void fetch(T* table)
  {
    if(piece_.host == nullptr)
      return copy_to_host(own_.data(), own_.size(), table);
    if(bytes_ == 0)
      return;
    arena_.fetch(piece_, bytes_);
    copy_on_host(table, piece_.host, bytes_);
  }

private:
  Table_arena& arena_ = Table_arena::of_thread();
  std::size_t bytes_;
  Table_arena::Piece piece_;
  Device_buffer<T> own_;
};

// To read. The table may change after the construction: its items have been copied.
template <class T>
class Device_read_access {
public:
  Device_read_access(const T* table, std::size_t size) : table_(table, size, true) {}

  const T* data() const { return table_.data(); }

private:
  Table_on_device<T> table_;
};

// To write, or to read and write: then `is_read` is true. The host has the changes after copy_back().
template <class T>
class Device_write_access {
public:
  Device_write_access(std::vector<T>& table, bool is_read) : host_(table), table_(table.data(), table.size(), is_read)
  {}

  T* data() const { return table_.data(); }

  void copy_back() { table_.fetch(host_.data()); }

private:
  std::vector<T>& host_;
  Table_on_device<T> table_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_DEVICE_ACCESS_CUH
