// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages that the device replaces, with the signatures that Stage_overrides.h defines. Each returns the same bits
// as the generic form.

#ifndef CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_STAGES_CUH
#define CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_STAGES_CUH

#include <CGAL/Tandem/internal/backend/Stage_overrides.h>
#include <CGAL/Tandem/internal/base/keys.h>
#include <CGAL/Tandem/internal/cloud/choose_grid.h>
#include <CGAL/Tandem/internal/cuda/execution/Cuda_backend.cuh>
#include <CGAL/Tandem/internal/cuda/interface/cuda_api.h>
#include <CGAL/Tandem/internal/cuda/neighbors/Cuda_neighbors.cuh>
#include <CGAL/Tandem/internal/cuda/runtime/copy.cuh>
#include <CGAL/Tandem/internal/result/Engine_result.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace CGAL::Tandem::internal {

// --- The tables of the size of the cloud at both ends. These are points on the grid, from the caller's values, and lists
// of points, from the shapes of the points. They are defined by their contents, so the device may compute them in its
// own way.

// The caller's values on the device, in their type and order. Threads send pieces of them in any order, while the range
// is read. The tables of the import stay empty until bring(), but their memory has to exist.
class Values_on_device : public Uploaded_values {
public:
  using Piece = Cuda_upload::Piece;

  // Makes all pairs of pieces at once, so that missing memory shows before values are read. The stream of the thread is
  // waited for, since other streams use the memory.
  Values_on_device(Vector_table& coordinates, Vector_table& normals, std::size_t n)
    : device_(current_device()), size_(n),
      vector_bytes_(coordinates.vector_bytes()), table_{coordinates.bytes(), normals.bytes()},
      value_{Device_buffer<char>(n * vector_bytes_), Device_buffer<char>(normals.bytes() ? n * vector_bytes_ : 0)}
  {
    wait_for_stream();
    const std::size_t threads = (std::max)(std::size_t(1), std::size_t(std::thread::hardware_concurrency()));
    for(std::size_t i = 0; i < (std::min)({threads, maximum_copying_threads, n / maximum_points() + 1}); ++i)
      free_.put(make_pair());
  }

  ~Values_on_device() override
  {
    const Device_guard guard(device_, std::nothrow);
    close();
    for(Device_buffer<char>& value : value_)
      value.release();
  }

  int device() const { return device_; }
  const char* coordinates() const { return value_[0].data(); }
  const char* normals() const { return value_[1].data(); } // null if there are none
  std::size_t bytes() const { return value_[0].size() + value_[1].size(); }
  bool are_in_tables() const { return are_in_tables_; }

  // begin() and end() of a piece: those of Cuda_upload.
  Piece begin(std::size_t maximum)
  {
    const Device_guard guard(device_);
    Pinned_pair* pair;
    if(!free_.take(pair))
      pair = make_pair();
    return {(std::min)(maximum, maximum_points()), pair->next(), pair};
  }

  void end(const Piece& piece, std::size_t first)
  {
    const Device_guard guard(device_);
    const std::size_t bytes = piece.size * vector_bytes_;
    for(std::size_t t = 0; t < number_of_tables(); ++t)
      CGAL_TANDEM_CUDA(cudaMemcpyAsync(value_[t].data() + first * vector_bytes_, piece.values + t * bytes, bytes,
                                       cudaMemcpyHostToDevice, piece.pair->stream()));
    piece.pair->end_piece();
    free_.put(piece.pair);
  }

  // Where the values were read to the tables: sends them all, by several threads.
  void send_tables()
  {
    are_in_tables_ = true;
    Parallel_host().for_each_piece(size_, maximum_points(), [&](std::size_t first, std::size_t last) {
      const Piece piece = begin(last - first);
      const std::size_t bytes = piece.size * vector_bytes_;
      for(std::size_t t = 0; t < number_of_tables(); ++t)
        std::memcpy(piece.values + t * bytes, table_[t] + first * vector_bytes_, bytes);
      end(piece, first);
    });
    close();
  }

  // All values have been sent; waits until they have arrived.
  void close()
  {
    free_.clear();
    pairs_.clear(); // waits for what they copy
  }

  // Copies the values back to the tables of the import, once.
  void download() override
  {
    if(are_in_tables_)
      return;
    const Device_guard guard(device_);
    const std::size_t bytes = size_ * vector_bytes_;
    empty_pinned_pieces({{value_[0].data(), table_[0], bytes}, {value_[1].data(), table_[1], value_[1].size()}});
    are_in_tables_ = true;
  }

private:
  // Points of a piece: their coordinates, then their normals, fill it.
  std::size_t maximum_points() const { return Pinned_pair::bytes / (number_of_tables() * vector_bytes_); }

  // Coordinates, and normals if they are given.
  std::size_t number_of_tables() const { return table_[1] != nullptr ? 2 : 1; }

  // More pairs are made if more threads read than were expected.
  Pinned_pair* make_pair()
  {
    auto pair = std::make_unique<Pinned_pair>();
    std::lock_guard<std::mutex> lock(mutex_);
    pairs_.push_back(std::move(pair));
    return pairs_.back().get();
  }

  const int device_;
  const std::size_t size_, vector_bytes_;
  // Coordinates and normals, on the host and on the device.
  char* const table_[2];
  Device_buffer<char> value_[2];
  std::mutex mutex_;
  std::vector<std::unique_ptr<Pinned_pair>> pairs_; // destroyed before the memory to which they copy
  Kept_items<Pinned_pair*> free_;
  bool are_in_tables_ = false;
};

// Keys for the sort of points by shape. Points without a shape come last.
template <class Key>
struct Write_pairs {
  const std::int32_t* shape_of;
  std::uint32_t shapes;
  Key* key;
  std::uint32_t* position;

  __device__ void operator()(std::size_t i) const
  {
    key[i] = Key(min(std::uint32_t(shape_of[i]), shapes));
    position[i] = std::uint32_t(i);
  }
};

// Where the points of each shape begin; item `shapes` is where those of the last one end.
template <class Key>
struct Find_first {
  const Key* key;
  std::uint32_t size;
  std::uint32_t* first; // of each shape

  __device__ void operator()(std::size_t s) const
  {
    first[s] = partition_point(0, size, [&](std::uint32_t i) { return key[i] < s; });
  }
};

// Points by shape: where those of each begin, on the host, and all that have one, in f(positions, how many). By a
// stable sort, so points ascend within each shape. It has ended when f is called, whose copies have other streams.
template <class Key, class F>
void sort_by_shape(Cuda_backend& backend, const Device_buffer<std::int32_t>& shape_of,
                   std::vector<std::uint32_t>& first, F f)
{
  const std::size_t n = shape_of.size(), shapes = first.size() - 1;
  Device_buffer<Key> keys[2] = {Device_buffer<Key>(n), Device_buffer<Key>(n)};
  Device_buffer<std::uint32_t> positions[2] = {Device_buffer<std::uint32_t>(n), Device_buffer<std::uint32_t>(n)};
  backend.for_each(n, Write_pairs<Key>{shape_of.data(), std::uint32_t(shapes), keys[0].data(), positions[0].data()});
  cub::DoubleBuffer<Key> key(keys[0].data(), keys[1].data());
  cub::DoubleBuffer<std::uint32_t> position(positions[0].data(), positions[1].data());
  sort_pairs(key, position, n, bits_of(shapes));
  Device_buffer<std::uint32_t> found(first.size());
  backend.for_each(first.size(), Find_first<Key>{key.Current(), std::uint32_t(n), found.data()});
  backend.to_host(found.data(), first.size(), first.data());
  f(position.Current(), first.back());
}

// Import and grouping differ for their copies, neighbors for speed. The cells are used to start large ones
// first.
template <>
struct Stage_overrides<Cuda_backend> : No_stage_overrides {
  static constexpr bool imports_points = true, expects_cells = true, finds_neighbors = true, groups_points = true;

  // Rounds the values to the grid on the device. Values that were read to the tables are sent first, and freed here.
  // Uploaded ones stay until the search for neighbors has started. They return to the host while it runs, because the
  // exact check needs them and the search leaves the bus idle.
  static Device_buffer<Grid_point> import_points(Cuda_backend& backend, Import& in)
  {
    const auto values_of = [&]() -> const Values_on_device& { // no other back end uploads
      return static_cast<const Values_on_device&>(*in.uploaded);
    };
    if(in.uploaded != nullptr && values_of().device() != current_device()) // a callback has changed it
      in.drop_upload();
    Device_buffer<Grid_point> point(in.size());
    if(in.uploaded == nullptr) {
      const auto sent = std::make_shared<Values_on_device>(in.coordinates, in.normals, in.size());
      sent->send_tables();
      in.uploaded = sent;
    }
    const Values_on_device& values = values_of();
    Device_work::of_thread().bytes_copied += values.bytes(); // also if that was done while the range was read
    Place_on_grid place = place_on_grid(in, point.data());
    place.coordinates.data = values.coordinates();
    place.normals.data = values.normals();
    backend.for_each(in.size(), place);
    if(values.are_in_tables()) // else prepare() drops the upload during the search
      in.drop_upload();
    return point;
  }

  static void expect_cells(Cuda_backend& backend, const Device_buffer<Range>& cells) { backend.expect_cells(cells); }

  // Rows and scratch are memory of the device; the search has not ended when this returns.
  static void find_neighbors(Cuda_backend&, const Grid_point* point, std::uint32_t n, int k, std::uint32_t* out)
  {
    Device_buffer<unsigned char> scratch(neighbor_scratch_bytes(n));
    find_neighbors_cuda({point, n, k, out}, scratch.data(), stream_of_thread());
  }

  // Copies the lists and the labels to the host, by several threads. Short keys, where there are not too many shapes:
  // this is the stage that needs most memory.
  static void group_points(Cuda_backend& backend, Device_buffer<std::int32_t>&& shape_of, std::size_t shapes,
                           Engine_result& result)
  {
    const std::size_t n = shape_of.size();
    std::vector<std::uint32_t> first(shapes + 1);
    Host_buffer<std::uint32_t> grouped;
    Host_buffer<std::int32_t> table(n);
    table.keep_pages();
    const auto copy = [&](const std::uint32_t* positions, std::size_t size) {
      grouped.reset(size);
      grouped.keep_pages();
      empty_pinned_pieces({{positions, grouped.data(), size * sizeof(std::uint32_t)},
                           {shape_of.data(), table.data(), n * sizeof(std::int32_t)}});
    };
    if(shapes <= (std::numeric_limits<std::uint16_t>::max)())
      sort_by_shape<std::uint16_t>(backend, shape_of, first, copy);
    else
      sort_by_shape<std::uint32_t>(backend, shape_of, first, copy);
    result.points = {std::vector<std::size_t>(first.begin(), first.end()), std::move(grouped)};
    result.shape_of = std::move(table);
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_CUDA_STAGES_CUDA_STAGES_CUH
