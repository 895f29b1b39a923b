// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What tandem_python::Shapes share.

#ifndef TANDEM_PYTHON_PLANAR_SHAPES_H
#define TANDEM_PYTHON_PLANAR_SHAPES_H

#include "detection.h"
#include "maps.h"

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>

#include <memory>
#include <utility>

namespace tandem_python {

using Planar_shapes = CGAL::Tandem::Planar_shapes_3<Kernel>;

struct Shapes::Data {
  Planar_shapes shapes;
};

inline Shapes share(Planar_shapes shapes)
{
  return Shapes(std::make_shared<Shapes::Data>(Shapes::Data{std::move(shapes)}));
}

} // namespace tandem_python

#endif // TANDEM_PYTHON_PLANAR_SHAPES_H
