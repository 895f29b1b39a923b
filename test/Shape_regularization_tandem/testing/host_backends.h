// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All back ends of the host, for tests of what each of them has to do.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_HOST_BACKENDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_HOST_BACKENDS_H

#include "Reverse_backend.h"
#include "body_fixture.h"

#include <string>

namespace CGAL {
namespace Tandem {
namespace internal {

// f(backend, name) for each of them.
template <class F>
void on_host_backends(F f)
{
  f(Sequential_backend(), std::string("sequential"));
  f(Reverse_backend(), std::string("reverse"));
  for(unsigned threads : {2u, 4u, 8u})
    f(Thread_backend(threads), std::to_string(threads) + " threads");
#ifdef CGAL_LINKED_WITH_TBB
  f(Tbb_backend(), std::string("parallel"));
#endif
  for(std::uint64_t seed : {1, 2, 3})
    f(Shuffled_backend(seed), "shuffled " + std::to_string(seed));
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_HOST_BACKENDS_H
