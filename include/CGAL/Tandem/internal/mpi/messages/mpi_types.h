// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How tables of items become messages of MPI.

#ifndef CGAL_TANDEM_INTERNAL_MPI_MESSAGES_MPI_TYPES_H
#define CGAL_TANDEM_INTERNAL_MPI_MESSAGES_MPI_TYPES_H

#include <mpi.h>

#include <algorithm>
#include <climits>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace CGAL {
namespace Tandem {
namespace internal {

// Sizes and places of the items of each rank, as MPI counts them.
struct Gathered_layout {
  explicit Gathered_layout(const std::vector<std::uint64_t>& sizes)
  {
    for(const std::uint64_t n : sizes) {
      first.push_back(int(total));
      size.push_back(int(n));
      total += n;
    }
    if(total > std::uint64_t(INT_MAX))
      throw std::length_error("the ranks share more than 2^31 items of one table");
  }

  std::vector<int> size, first;
  std::uint64_t total = 0;
};

// Items of so many bytes, so that counts of MPI are those of items.
class Item_type {
public:
  explicit Item_type(std::size_t bytes)
  {
    MPI_Type_contiguous(int(bytes), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  Item_type(const Item_type&) = delete;
  Item_type& operator=(const Item_type&) = delete;
  ~Item_type() { MPI_Type_free(&type_); }
  operator MPI_Datatype() const { return type_; }

private:
  MPI_Datatype type_;
};

// By width: some versions of Open MPI compare MPI_UNSIGNED_LONG as if it had a sign.
inline MPI_Datatype mpi_type_of(const std::int32_t*) { return MPI_INT32_T; }
inline MPI_Datatype mpi_type_of(const std::uint32_t*) { return MPI_UINT32_T; }
inline MPI_Datatype mpi_type_of(const std::int64_t*) { return MPI_INT64_T; }
inline MPI_Datatype mpi_type_of(const std::uint64_t*) { return MPI_UINT64_T; }

// In pieces, as MPI counts with int.
template <class F>
void for_each_message(std::size_t n, F f)
{
  constexpr std::size_t largest = std::size_t(1) << 24;
  for(std::size_t first = 0; first < n; first += largest)
    f(first, int((std::min)(largest, n - first)));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_MESSAGES_MPI_TYPES_H
