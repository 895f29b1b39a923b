// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Buffers of any back end, from and to the host. A copy to the host waits for the work that was started.

#ifndef CGAL_TANDEM_INTERNAL_BACKEND_BUFFERS_H
#define CGAL_TANDEM_INTERNAL_BACKEND_BUFFERS_H

#include <CGAL/Tandem/internal/base/types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL::Tandem::internal {

// The memory of a back end.
template <class Backend, class T>
using Buffer_of = typename Backend::template Buffer<T>;

// The scratch memory of bodies whose lanes share nothing.
struct No_scratch {};

template <class T>
struct Fill {
  T* target;
  T value;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { target[i] = value; }
};

template <class T, class Backend>
Buffer_of<Backend, T> filled_buffer(Backend& backend, std::size_t n, T value)
{
  Buffer_of<Backend, T> buffer(n);
  backend.for_each(n, Fill<T>{buffer.data(), value});
  return buffer;
}

template <class Backend, class T>
Buffer_of<Backend, T> to_buffer(Backend& backend, const std::vector<T>& table)
{
  return backend.template make_buffer<T>(table.size(), [&](std::size_t i) { return table[i]; });
}

// The first n items.
template <class T, class Backend>
std::vector<T> to_vector(Backend& backend, const T* items, std::size_t n)
{
  std::vector<T> table(n);
  backend.to_host(items, n, table.data());
  return table;
}

template <class Backend, class Buffer>
auto to_vector(Backend& backend, const Buffer& buffer)
{
  return to_vector(backend, buffer.data(), buffer.size());
}

template <class T>
struct Copy_items {
  const T* source;
  T* target;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { target[i] = source[i]; }
};

// From the host to a table where the functors run.
template <class Backend, class T>
void write_to(Backend& backend, const std::vector<T>& values, T* table)
{
  const auto buffer = to_buffer(backend, values);
  backend.for_each(values.size(), Copy_items<T>{buffer.data(), table});
}

// The first items, and room for others.
template <class T, class Backend>
Buffer_of<Backend, T> resized(Backend& backend, const Buffer_of<Backend, T>& table, std::size_t kept, std::size_t size)
{
  Buffer_of<Backend, T> other(size);
  backend.for_each(kept, Copy_items<T>{table.data(), other.data()});
  return other;
}

// The items, and room for more.
template <class T, class Backend>
Buffer_of<Backend, T> extended(Backend& backend, const Buffer_of<Backend, T>& table, std::size_t size)
{
  return resized<T>(backend, table, table.size(), size);
}

// The items at these places.
template <class T>
struct Gather_items {
  const T* source;
  const std::uint32_t* place;
  T* target;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { target[i] = source[place[i]]; }
};

// Successive numbers.
struct Fill_ascending {
  std::uint32_t* target;
  std::uint32_t first = 0;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { target[i] = first + std::uint32_t(i); }
};

// A predicate of compactions.
struct Is_marked {
  const std::uint8_t* mark;

  CGAL_TANDEM_HD bool operator()(std::uint32_t i) const { return mark[i] != 0; }
};

struct Write_place {
  const std::uint32_t* id;
  std::uint32_t* place;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { place[id[i]] = std::uint32_t(i); }
};

// For each of n ids its place in the list, or no_index. No id is listed twice.
template <class Backend>
Buffer_of<Backend, std::uint32_t> places_of(Backend& backend, std::size_t n,
                                            const Buffer_of<Backend, std::uint32_t>& ids)
{
  auto place = filled_buffer(backend, n, no_index);
  backend.for_each(ids.size(), Write_place{ids.data(), place.data()});
  return place;
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BACKEND_BUFFERS_H
