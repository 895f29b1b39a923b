// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_DETECT_PLANES_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_DETECT_PLANES_H

#include <CGAL/Shape_regularization_tandem/Planar_shape_detection_3.h>
#include <CGAL/Shape_regularization_tandem/estimate_parameters.h>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief detects planar shapes and makes those that are nearly parallel, orthogonal or coplanar exactly so.

The range is neither changed nor reordered, and each of its points is read once; unless the tag is
`CGAL::Sequential_tag`, several threads read through the property maps at the same time. The result is the same for
every concurrency tag, number of threads and order of the points. Points with a coordinate that is not finite, or with a
given normal that is null or not finite, belong to no shape and are counted in the statistics of the result.

The method is that of sections 3 and 4 of \cgalCite{OLA16}. The user manual lists
\ref Tandem_algorithm_paper "what differs" and describes \ref Tandem_method "each stage". Time and memory are about
linear in the number of points.

\tparam ConcurrencyTag `CGAL::Sequential_tag`, `CGAL::Parallel_tag`, `CGAL::Parallel_if_available_tag` (the default),
`Cuda_tag`, `Cuda_if_available_tag` or `Mpi_tag`
\tparam PointRange a model of `ConstRange` whose iterators are random access; also `CGAL::Point_set_3`, whose maps are
the defaults then

\param points the points
\param np a sequence of named parameters, of `CGAL::Tandem::parameters` or of `CGAL::parameters`; see
`parameters::combine()` for a mixture of both

\cgalNamedParamsBegin
  \cgalParamNBegin{point_map}
    \cgalParamDescription{a property map from the value type of the range to `Point_3`}
    \cgalParamDefault{`CGAL::Identity_property_map`}
  \cgalParamNEnd
  \cgalParamNBegin{normal_map}
    \cgalParamDescription{a property map from the value type of the range to `Vector_3`; the length does not matter, nor
    does the orientation. `CGAL::Default()` selects estimated normals for a range that has normals, as
    `CGAL::Point_set_3` may.}
    \cgalParamDefault{normals are estimated from the neighbors of each point}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_distance}
    \cgalParamDescription{the largest distance of a point to the plane of its shape, in units of the points, from 1e-270
    to 1e270}
    \cgalParamDefault{as `estimate_parameters()`}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_distance_map}
    \cgalParamDescription{a property map from the value type of the range to a number type: the largest distance of each
    point to the plane of its shape, in units of the points, for points whose noise differs, as that of a depth camera
    does with the range. Then `maximum_distance` is an upper bound of the tolerances; where it is larger than all of
    them, it becomes the largest one. Points whose tolerance is not positive belong to no shape, and are counted; see
    \ref Tandem_parameters_tolerances}
    \cgalParamDefault{all points have `maximum_distance`. With the map and without `maximum_distance`, the default of
    `maximum_distance` is the 95th percentile of the tolerances}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_angle}
    \cgalParamDescription{the largest angle between the normal of a point and that of its shape, in degrees, in [0.05,
    90). Normals are rounded by up to 0.004 degrees, so smaller angles would find nothing.}
    \cgalParamDefault{25}
  \cgalParamNEnd
  \cgalParamNBegin{angle_tolerance}
    \cgalParamDescription{the angle within which planes are made parallel or orthogonal, in degrees, in [0, 45). No
    plane is turned farther from the fit of the points that its shape has at that time; points may come and go
    afterwards.}
    \cgalParamDefault{8}
  \cgalParamNEnd
  \cgalParamNBegin{maximum_offset}
    \cgalParamDescription{the largest distance between parallel planes that are made coplanar, in units of the points,
    from 0 to 1e270}
    \cgalParamDefault{`maximum_distance`}
  \cgalParamNEnd
  \cgalParamNBegin{minimum_region_size}
    \cgalParamDescription{the smallest number of points of a shape, at least 3}
    \cgalParamDefault{as `estimate_parameters()`}
  \cgalParamNEnd
  \cgalParamNBegin{simplicity}
    \cgalParamDescription{what the size of a shape is worth, in [0, 1]: the smaller, the more layers and details are
    shapes of their own; the larger, the fewer and larger the shapes}
    \cgalParamDefault{0.08}
  \cgalParamNEnd
  \cgalParamNBegin{regularity}
    \cgalParamDescription{what a degree of freedom is worth, in `minimum_region_size`, in [0, 10]: the smaller, the
    closer planes stay to their points; the larger, the more of them are parallel, orthogonal or coplanar}
    \cgalParamDefault{0.1}
  \cgalParamNEnd
  \cgalParamNBegin{surfel_size}
    \cgalParamDescription{the width of the cubes whose points are one surfel while shapes grow, as a fraction of
    `maximum_distance`, in [0, 0.55]; 0: each point is a surfel. Points are checked one by one in any case}
    \cgalParamDefault{0.55}
  \cgalParamNEnd
  \cgalParamNBegin{k_neighbors}
    \cgalParamDescription{the number of nearest neighbors that are connected to a point, in [3, 64]}
    \cgalParamDefault{12}
  \cgalParamNEnd
  \cgalParamNBegin{cell_size}
    \cgalParamDescription{the largest number of points of an octree cell, in [64, 65536]}
    \cgalParamDefault{8192}
  \cgalParamNEnd
  \cgalParamNBegin{regularize_parallelism, regularize_orthogonality, regularize_coplanarity}
    \cgalParamDescription{which relations are made exact}
    \cgalParamDefault{`true`}
  \cgalParamNEnd
  \cgalParamNBegin{fixed_directions}
    \cgalParamDescription{a range of `Vector_3` or `std::array<double, 3>`, of any length: directions known beforehand,
    such as the vertical. Shapes within `angle_tolerance` become exactly parallel or orthogonal to them where their
    points allow it. Of directions that are opposite, or that make an angle of less than 1e-9 radians, only the first
    counts.}
    \cgalParamDefault{there are none}
  \cgalParamNEnd
  \cgalParamNBegin{symmetry_direction}
    \cgalParamDescription{a `Vector_3` or `std::array<double, 3>`, of any length: shapes that make nearly the same angle
    with this axis, such as the two sides of a roof, make exactly the same where their points and their right angles
    allow it. The axis is also a fixed direction.}
    \cgalParamDefault{(0, 0, 1) with `regularize_axis_symmetry`}
  \cgalParamNEnd
  \cgalParamNBegin{regularize_axis_symmetry}
    \cgalParamDescription{whether the axis of symmetry is used}
    \cgalParamDefault{`true` if `symmetry_direction` is given, otherwise `false`}
  \cgalParamNEnd
  \cgalParamNBegin{settings}
    \cgalParamDescription{a `Parameters` with values for all that is not given by its own name; a length or a size of 0
    is estimated}
    \cgalParamDefault{`Parameters()`}
  \cgalParamNEnd
  \cgalParamNBegin{callback}
    \cgalParamDescription{a `std::function<bool(double)>` that gets the progress, in [0, 1], on the calling thread,
    between the stages and several times in a round; `stage_at()` names the stage. The callback cancels the detection by
    returning `false`: then the shapes found until then are finished and verified, so that all guarantees hold; see
    `Planar_shapes_3::is_cancelled()`. What the callback throws ends the detection at once and reaches the caller.}
    \cgalParamDefault{none}
  \cgalParamNEnd
  \cgalParamNBegin{geom_traits}
    \cgalParamDescription{a model of `Kernel`}
    \cgalParamDefault{the kernel of the points}
  \cgalParamNEnd
  \cgalParamNBegin{communicator}
    \cgalParamDescription{a `boost::mpi::communicator`, for `Mpi_tag` only: the processes that work together}
    \cgalParamDefault{all processes}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the shapes as a `Planar_shapes_3`

\throw Parameter_error a parameter is outside of its range, or the extent of the cloud is more than 2^24 times
`maximum_distance` without few far points: up to one point in twenty that is far from the median on an axis, by a
quarter of that length, is left out and counted
\throw std::length_error more than 2^31 points in one process, or than the memory of the device holds (`Cuda_tag`)
\throw std::invalid_argument processes have different parameters or maps (`Mpi_tag`)
\throw std::logic_error MPI is not initialized (`Mpi_tag`)
\throw std::runtime_error there is no CUDA device (`Cuda_tag`), or it fails
\throw std::range_error the extent of the cloud is more than 2^24 times 1e270, about 1.7e277
*/
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class PointRange,
          class NamedParameters = CGAL::parameters::Default_named_parameters>
auto detect_planes(const PointRange& points, const NamedParameters& np = NamedParameters())
{
  return internal::with_traits<ConcurrencyTag>(points, np, [&](const auto& traits) {
    using Traits = typename std::decay<decltype(traits)>::type;
    Planar_shape_detection_3<Traits> detection(points, np, traits);
    detection.detect();
    return detection.shapes();
  });
}

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_DETECT_PLANES_H
