// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fits of moments that all ranks have. A fit costs an eigenvalue problem, so each rank makes a share of them, and gets
// the others. Changes nothing but these fits.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_MAKE_FITS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_MAKE_FITS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>

namespace CGAL {
namespace Tandem {
namespace internal {

// The own share of the fits, and the scatter of all moments, which costs less than to send it.
template <class Fits>
struct Make_fit {
  Fits fits;
  Own_share own;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    if(!fits.has(i))
      return;
    fits[i].scatter = make_scatter(fits[i].moments);
    if(!own.has(i))
      return;
    set_fit(fits[i], fit_plane(fits[i].scatter));
    if(own.ranks == 1)
      fits.set_made(i);
  }
};

struct Numbered_fit {
  std::uint64_t number; // wide, so that all bytes are defined
  Fit fit;
};

template <class Fits>
struct Take_fit {
  Fits fits;
  Own_share own;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return own.has(i) && fits.has(i); }
  CGAL_TANDEM_HD Numbered_fit take(std::uint32_t i) const { return {i, fits[i].fit}; }
};

template <class Fits>
struct Put_fit {
  Fits fits;
  const Numbered_fit* of_all;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const std::size_t number = std::size_t(of_all[i].number);
    set_fit(fits[number], of_all[i].fit);
    fits.set_made(number);
  }
};

// After the own share has been made: the fits of all ranks.
template <class Backend, class Fits>
void spread_fits(Backend& backend, const Ranks<Backend>& ranks, std::size_t n, const Fits& fits)
{
  if constexpr(Ranks<Backend>::are_many) {
    const auto all = collect_of_all<Numbered_fit>(backend, ranks, n, Take_fit<Fits>{fits, ranks.share()});
    backend.for_each(all.size(), Put_fit<Fits>{fits, all.data()});
  }
}

// fits.has(i): one is to be made for fits[i] of the n moments; fits.set_made(i): it has been made.
template <class Backend, class Fits>
void make_fits(Backend& backend, const Ranks<Backend>& ranks, std::size_t n, const Fits& fits)
{
  backend.for_each(n, Make_fit<Fits>{fits, ranks.share()}, shapes_per_thread);
  spread_fits(backend, ranks, n, fits);
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_MAKE_FITS_H
