// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sequential engine on a generated scene, with access to its state between rounds.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_OPEN_ENGINE_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_OPEN_ENGINE_H

#include "test_support.h"

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>

namespace CGAL {
namespace Tandem {
namespace internal {

using State = Tandem_state<Sequential_backend>;

// The state is private; an explicit instantiation may name it nevertheless.
struct State_of_engine {
  using type = State Engine<Sequential_backend>::*;
  friend type reveal(State_of_engine);
};

template <class Tag, typename Tag::type Member>
struct Reveal {
  friend typename Tag::type reveal(Tag) { return Member; }
};

template struct Reveal<State_of_engine, &Engine<Sequential_backend>::state_>;

class Open_engine {
public:
  Open_engine(const std::string& scene, const scenes::Options& options, const Parameters& parameters)
    : cloud_(to_cloud(scenes::make_scene(scene, options))), in_(import(parameters)),
      engine_(backend_, in_, parameters, progress_)
  {}

  bool iterate() { return engine_.iterate(); }
  State& state() { return engine_.*reveal(State_of_engine()); }

private:
  Import import(const Parameters& parameters)
  {
    using Traits = Tandem_traits_3<Kernel, Cloud, ::First<Kernel>, ::Second<Kernel>, Sequential_tag>;
    Import in = read_points(backend_, cloud_, Item_reader<Traits>(Traits(), ::First<Kernel>(), ::Second<Kernel>()));
    choose_grid(in, parameters);
    return in;
  }

  Sequential_backend backend_;
  Cloud cloud_;
  Import in_;
  Progress progress_;
  Engine<Sequential_backend> engine_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_TEST_OPEN_ENGINE_H
