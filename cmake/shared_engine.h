// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Included before tests and examples: the engine, which takes longest to compile, is compiled once for all of them, in
// shared_engine.cpp.

#ifndef CGAL_TANDEM_SHARED_ENGINE_H
#define CGAL_TANDEM_SHARED_ENGINE_H

#include <CGAL/Shape_regularization_tandem/internal/Execution_of.h>
#include <CGAL/Tandem/internal/engine/Engine.h>

extern template class CGAL::Tandem::internal::Engine<CGAL::Tandem::internal::Sequential_backend>;
#ifdef CGAL_LINKED_WITH_TBB
extern template class CGAL::Tandem::internal::Engine<CGAL::Tandem::internal::Tbb_backend>;
#endif

#endif // CGAL_TANDEM_SHARED_ENGINE_H
