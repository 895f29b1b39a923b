// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// For the sources of the library Tandem::tandem_engine: defines what compiled_engine.h declares.

#ifndef CGAL_TANDEM_INTERNAL_ENGINE_COMPILED_ENGINE_IMPL_H
#define CGAL_TANDEM_INTERNAL_ENGINE_COMPILED_ENGINE_IMPL_H

#include <CGAL/Tandem/internal/engine/Engine.h>
#include <CGAL/Tandem/internal/engine/compiled_engine.h>
#include <CGAL/Tandem/internal/engine/complete_parameters.h>
#include <CGAL/Tandem/internal/finish/export_shapes.h>
#include <CGAL/Tandem/internal/regularity/relate_planes.h>

namespace CGAL {
namespace Tandem {
namespace internal {

template <class Backend>
Compiled_engine<Backend>::Compiled_engine(Backend& backend, Import& in, const Parameters& parameters,
                                          Progress& progress)
  : engine_(std::make_unique<Engine<Backend>>(backend, in, parameters, progress))
{}

template <class Backend>
Compiled_engine<Backend>::~Compiled_engine() = default;

template <class Backend>
bool Compiled_engine<Backend>::iterate()
{
  return engine_->iterate();
}

template <class Backend>
void Compiled_engine<Backend>::finish()
{
  engine_->finish();
}

template <class Backend>
Engine_result Compiled_engine<Backend>::result()
{
  return engine_->result();
}

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_ENGINE_COMPILED_ENGINE_IMPL_H
