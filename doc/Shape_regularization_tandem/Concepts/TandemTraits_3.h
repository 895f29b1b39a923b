// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgShapeRegularizationTandemConcepts
\cgalConcept

The traits of `CGAL::Tandem::Planar_shape_detection_3`: the geometry of a kernel, and the back end that executes the detection.

The class uses the geometry only to read points and to return planes. All other computations use an integer grid. They
are templates on `Backend`, but their results do not depend on it: two models with the same types of geometry must give
the same results, bit for bit.

\cgalHasModel `CGAL::Tandem::Tandem_traits_3<GeomTraits, PointRange, PointMap, NormalMap, ConcurrencyTag>`
*/
class TandemTraits_3 {
public:
  /// \name Types
  /// @{

  /// a model of `Kernel`, which has the types below
  typedef unspecified_type Geom_traits;

  /// the number type of the coordinates; `CGAL::to_double()` converts it
  typedef unspecified_type FT;
  /// the type of the points that the point map returns
  typedef unspecified_type Point_3;
  /// the type of the normals that the normal map returns
  typedef unspecified_type Vector_3;
  /// the type of the planes of the result
  typedef unspecified_type Plane_3;

  /// a model of `ConstRange` whose iterators are random access
  typedef unspecified_type Point_range;

  /// a model of `ReadablePropertyMap` from the value type of `Point_range` to `Point_3`
  typedef unspecified_type Point_map;

  /// a model of `ReadablePropertyMap` from the value type of `Point_range` to `Vector_3`, or `CGAL::Default`: then the
  /// detection estimates the normals
  typedef unspecified_type Normal_map;

  /// the back end that reads the points of the caller: it owns memory, runs loops over points and cells, and sorts
  typedef unspecified_type Backend;

  /// starts the engine of this package, on `Backend` or on a device
  typedef unspecified_type Execution;

  /// `true` if `Normal_map` is not `CGAL::Default`
  static constexpr bool has_normal_map;

  /// @}

  /// \name Functors
  /// @{

  /// `FT operator()(const Point_3&)` and `FT operator()(const Vector_3&)`: the first coordinate
  typedef unspecified_type Compute_x_3;
  /// the second coordinate
  typedef unspecified_type Compute_y_3;
  /// the third coordinate
  typedef unspecified_type Compute_z_3;

  /// the functor of the first coordinate
  Compute_x_3 compute_x_3_object() const;
  /// the functor of the second coordinate
  Compute_y_3 compute_y_3_object() const;
  /// the functor of the third coordinate
  Compute_z_3 compute_z_3_object() const;

  /// @}

  /// \name Access
  /// @{

  /// the kernel; it constructs the planes of the result from four numbers of type `Geom_traits::RT`
  const Geom_traits& geom_traits() const;

  /// a new back end
  Backend backend() const;

  /// @}
};
