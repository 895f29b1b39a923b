// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables of the back end as MPI needs them: on the host.

#ifndef CGAL_TANDEM_INTERNAL_MPI_HOST_VIEW_H
#define CGAL_TANDEM_INTERNAL_MPI_HOST_VIEW_H

#include <CGAL/Tandem/internal/backend/buffers.h>
#include <CGAL/Tandem/internal/mpi/rank_functors.h>

#include <type_traits>

namespace CGAL {
namespace Tandem {
namespace internal {

// From the host to a table where the functors run.
template <class Backend, class T>
void write_to(Backend& backend, const std::vector<T>& values, T* table)
{
  const auto buffer = to_buffer(backend, values);
  backend.for_each(values.size(), Copy_items<T>{buffer.data(), table});
}

// The first n items of a table: itself where it is memory of the host, otherwise a copy.
template <class Backend, class T>
class Host_view {
  static constexpr bool is_host = std::is_base_of<Host_memory, Backend>::value;

public:
  Host_view(Backend& backend, T* table, std::size_t n) : backend_(backend), table_(table)
  {
    if(!is_host)
      copy_ = to_vector(backend, table, n);
  }

  T* data() { return is_host ? table_ : copy_.data(); }
  const T* data() const { return is_host ? table_ : copy_.data(); }

  // The table becomes what the view is.
  void write_back()
  {
    if constexpr(!is_host)
      write_to(backend_, copy_, table_);
  }

private:
  Backend& backend_;
  T* table_;
  std::vector<typename std::remove_const<T>::type> copy_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_HOST_VIEW_H
