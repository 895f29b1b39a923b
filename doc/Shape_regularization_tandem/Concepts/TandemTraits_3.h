// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgShapeRegularizationTandemConcepts
\cgalConcept

What `CGAL::Tandem::Planar_shape_detection_3` needs to know: the geometry of a kernel at the border, and what executes.

The geometry is used only where points come in and planes go out. Everything between works on an integer grid, is a
template on `Backend`, and is defined without reference to it: with the same types of geometry, the results of two
models have to be the same, bit for bit.

\cgalHasModel `CGAL::Tandem::Tandem_traits_3<GeomTraits, PointRange, PointMap, NormalMap, ConcurrencyTag>`
*/
class TandemTraits_3 {
public:
  /// \name Types
  /// @{

  /// a model of `Kernel`, from which the types below come
  typedef unspecified_type Geom_traits;

  /// the number type of the coordinates; `CGAL::to_double()` converts it
  typedef unspecified_type FT;
  /// a point; the points of the range, through the point map
  typedef unspecified_type Point_3;
  /// a vector; the normals of the points, through the normal map
  typedef unspecified_type Vector_3;
  /// a plane of the result
  typedef unspecified_type Plane_3;

  /// a model of `ConstRange` whose iterators are random access
  typedef unspecified_type Point_range;

  /// a model of `ReadablePropertyMap` from the value type of `Point_range` to `Point_3`
  typedef unspecified_type Point_map;

  /// a model of `ReadablePropertyMap` from the value type of `Point_range` to `Vector_3`, or `CGAL::Default` if the
  /// normals are to be estimated
  typedef unspecified_type Normal_map;

  /// what executes at the border to the caller: memory, loops over points, bodies on the cells of the cloud, sorting
  typedef unspecified_type Backend;

  /// what executes the method: starts the engine of this package, on `Backend` or on a device
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

  /// the kernel, which constructs the planes of the result from four numbers of type `Geom_traits::RT`
  const Geom_traits& geom_traits() const;

  /// a new back end
  Backend backend() const;

  /// @}
};
