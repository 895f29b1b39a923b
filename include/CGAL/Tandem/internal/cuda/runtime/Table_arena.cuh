// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the small tables of the host lie while functors use them: pinned memory, and
// the same places in memory of the device. All tables that were put there since the
// last launch travel in one copy.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_TABLE_ARENA_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_TABLE_ARENA_CUH

#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

class Table_arena {
public:
  static constexpr std::size_t bytes = Pinned_block::bytes;

  struct Piece {
    char* host = nullptr; // null: there was no room
    char* device = nullptr;
  };

  // That of the current device.
  static Table_arena& of_thread()
  {
    thread_local std::map<int, Table_arena> arenas;
    return arenas[current_device()];
  }

  Table_arena() : device_(bytes), device_number_(current_device()) {}

  ~Table_arena()
  {
    const Device_guard guard(device_number_, std::nothrow);
    static_cast<void>(cudaStreamSynchronize(stream_of_thread()));
    device_.release();
  }

  Table_arena(const Table_arena&) = delete;
  Table_arena& operator=(const Table_arena&) = delete;

  // To be returned by give_back().
  Piece take(std::size_t size)
  {
    prepare();
    const std::size_t room = (size + 255) / 256 * 256;
    if(used_ + room > bytes)
      return {};
    const Piece piece = {host_.data() + used_, device_.data() + used_};
    used_ += room;
    ++pieces_;
    return piece;
  }

  void give_back() { --pieces_; }

  // Before functors run: what has been filled goes to the device.
  void flush()
  {
    if(sent_ == used_)
      return;
    CGAL_TANDEM_CUDA(cudaMemcpyAsync(device_.data() + sent_, host_.data() + sent_, used_ - sent_,
                                     cudaMemcpyHostToDevice, stream_of_thread()));
    sent_ = used_;
    is_sending_ = true;
  }

  // What functors wrote is there on the host, too.
  void fetch(const Piece& piece, std::size_t size)
  {
    flush(); // there may have been nothing to run
    CGAL_TANDEM_CUDA(cudaMemcpyAsync(piece.host, piece.device, size, cudaMemcpyDeviceToHost, stream_of_thread()));
    synchronize();
    is_sending_ = false;
  }

private:
  // Starts anew when no table is in use and the last copy has ended.
  void prepare()
  {
    if(pieces_ > 0 || used_ < bytes / 2)
      return;
    if(is_sending_)
      synchronize();
    is_sending_ = false;
    used_ = sent_ = 0;
  }

  Pinned_block host_;
  Device_buffer<char> device_;
  int device_number_;
  std::size_t used_ = 0, sent_ = 0; // bytes
  std::size_t pieces_ = 0;          // in use
  bool is_sending_ = false;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_TABLE_ARENA_CUH
