// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tables of the back end as MPI needs them: on the host.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_HOST_VIEW_H
#define CGAL_TANDEM_INTERNAL_BACKEND_HOST_VIEW_H

#include <CGAL/Tandem/internal/backend/Host_memory.h>
#include <CGAL/Tandem/internal/backend/buffers.h>

#include <type_traits>

namespace CGAL {
namespace Tandem {
namespace internal {

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

#endif // CGAL_TANDEM_INTERNAL_BACKEND_HOST_VIEW_H
