// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory for small tables of the host while functors use them: pinned memory, and the same places on the device. All
// tables that were placed since the last launch are copied at once. They are copied rather than read in pinned memory,
// where each block would fetch them again over the bus.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_TABLE_ARENA_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_RUNTIME_TABLE_ARENA_CUH

#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>

namespace CGAL {
namespace Tandem {
namespace internal {

// Invariants: [0, sent_) of the pinned memory is on the device or on its way, and [sent_, used_) has been filled since.
// Places are used again only when no table is in use. An arena belongs to one thread and one device.
class Table_arena {
public:
  static constexpr std::size_t bytes = Pinned_block::bytes;

  struct Piece {
    char* host = nullptr; // null: there was no room
    char* device = nullptr;
  };

  // The arena of this thread for its current device.
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

  // A place for so many bytes, until release_piece(); null pointers if there is no room. Rounded up to 256 bytes, as
  // the runtime aligns its own memory.
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

  // Only counts: places are freed all at once.
  void release_piece() { --pieces_; }

  // Copies the tables that were filled since the last flush. Has to precede every launch.
  void flush()
  {
    if(sent_ == used_)
      return;
    CGAL_TANDEM_CUDA(cudaMemcpyAsync(device_.data() + sent_, host_.data() + sent_, used_ - sent_,
                                     cudaMemcpyHostToDevice, stream_of_thread()));
    sent_ = used_;
    is_sending_ = true;
  }

  // Copies a table back to its place in pinned memory, and waits. Flushes first, because there may have been no launch
  // since the table was filled.
  void fetch(const Piece& piece, std::size_t size)
  {
    flush();
    CGAL_TANDEM_CUDA(cudaMemcpyAsync(piece.host, piece.device, size, cudaMemcpyDeviceToHost, stream_of_thread()));
    synchronize();
    is_sending_ = false;
  }

private:
  // Starts at the beginning again if no table is in use. Waits for the last copy first, whose source would be
  // overwritten. Not before half of the room is used, so that this is rare.
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
