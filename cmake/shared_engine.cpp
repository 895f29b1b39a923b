// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "shared_engine.h"

template class CGAL::Tandem::internal::Engine<CGAL::Tandem::internal::Sequential_backend>;
#ifdef CGAL_LINKED_WITH_TBB
template class CGAL::Tandem::internal::Engine<CGAL::Tandem::internal::Tbb_backend>;
#endif
