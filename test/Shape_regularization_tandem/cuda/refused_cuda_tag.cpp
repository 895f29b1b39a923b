// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Must not compile without the library of the CUDA back end, and say why.

#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>

int main()
{
  return int(CGAL::Tandem::detect_planes<CGAL::Tandem::Cuda_tag>(std::vector<CGAL::Simple_cartesian<double>::Point_3>())
               .number_of_shapes());
}
