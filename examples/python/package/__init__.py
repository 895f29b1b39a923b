# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Planes of point clouds, with parallel, orthogonal and coplanar ones exactly so.

    import numpy as np
    import tandem
    shapes = tandem.detect_planes(points)         # points: an array of shape (n, 3)
    for s, (a, b, c, d) in enumerate(shapes.planes):
        print(a, b, c, d, len(shapes.points_of(s)), shapes.parallel_groups[s])

The result is the same, bit for bit, for every back end, number of threads and order of the points, and the same as that
of the C++ package and of the program detect_planes.
"""

from __future__ import annotations

from typing import Callable, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _tandem
from ._arguments import (_count, _direction, _directions, _labels, _normals, _number, _points, _rows, _set, _switch,
                         _tolerances)
from ._selection import _check_result, label_points, select_shapes
from ._tandem import ParameterError, PlanarShapes, __version__

__all__ = ["EstimatedParameters", "ParameterError", "PlanarShapes", "PlaneRelations", "__version__", "backends",
           "detect_planes", "estimate_local_distances", "estimate_parameters", "find_violation", "label_points",
           "regularize_planes", "select_shapes"]

Progress = Callable[[float], Optional[bool]]


class EstimatedParameters(NamedTuple):
    """Parameters for detect_planes(). Lengths are in units of the points."""

    maximum_distance: float
    maximum_offset: float
    minimum_region_size: int


class PlaneRelations(NamedTuple):
    """The m planes that regularize_planes() returns, and how they are related."""

    planes: npt.NDArray[np.float64]  #: (m, 4): a, b, c, d; those that are related or were changed have a unit normal
    parallel_groups: npt.NDArray[np.int32]  #: (m,): those of a group have the same unit normal, up to its sign
    coplanar_groups: npt.NDArray[np.int32]  #: (m,): those of a group are the same plane, up to its sign
    orthogonal_pairs: npt.NDArray[np.int32]  #: (p, 2): pairs of parallel groups, the smaller one first, sorted
    is_changed: npt.NDArray[np.bool_]  #: (m,)
    is_rolled_back: npt.NDArray[np.bool_]  #: (m,): whether a direction is near, but would cost the points too much
    angles: npt.NDArray[np.float64]  #: (m,): how far each plane was turned, in degrees
    largest_distances: npt.NDArray[np.float64]  #: (m,): of the points of each plane to it
    maximum_distance: float  #: the distance that losses were measured by


def detect_planes(
    points: npt.ArrayLike,
    normals: Optional[npt.ArrayLike] = None,
    *,
    maximum_distance: Optional[float] = None,
    maximum_distance_map: Optional[npt.ArrayLike] = None,
    maximum_angle: Optional[float] = None,
    angle_tolerance: Optional[float] = None,
    maximum_offset: Optional[float] = None,
    minimum_region_size: Optional[int] = None,
    simplicity: Optional[float] = None,
    regularity: Optional[float] = None,
    surfel_size: Optional[float] = None,
    k_neighbors: Optional[int] = None,
    cell_size: Optional[int] = None,
    regularize_parallelism: bool = True,
    regularize_orthogonality: bool = True,
    regularize_coplanarity: bool = True,
    fixed_directions: Optional[npt.ArrayLike] = None,
    symmetry_direction: Optional[npt.ArrayLike] = None,
    ignore_zeros: bool = False,
    backend: str = "auto",
    threads: Optional[int] = None,
    progress: Optional[Progress] = None,
) -> PlanarShapes:
    """Detects planar shapes and makes those that are nearly parallel, orthogonal or coplanar exactly so.

    Each point of a shape is within maximum_distance and maximum_angle of the final plane of its shape. Points with a
    coordinate that is not finite, or a given normal that is null or not finite, belong to no shape: their label is -1,
    and the statistics count them. Masked numbers of a masked array count as not finite.

    Arguments
        points               (n, 3) numbers. A C-contiguous array of float64 is read where it is, others are converted.
                             Do not change it during the call.
        normals              (n, 3) numbers, of any length and orientation, which are copied; None: estimated
        maximum_distance     largest distance of a point to the plane of its shape, in units of the points; None: what
                             nearly all of maximum_distance_map do not exceed, else estimated, as estimate_parameters()
                             does. More than the largest of maximum_distance_map is the same as that
        maximum_distance_map (n,) numbers, which are copied: the same for each point, at most maximum_distance. Points
                             where it is not positive have no shape, and the statistics count them. None: it is
                             maximum_distance for all. estimate_local_distances() estimates one
        maximum_angle        largest angle between the normal of a point and that of its shape, in degrees, in
                             [0.05, 90); None: 25
        angle_tolerance      angle within which planes are made parallel or orthogonal, in degrees, in [0, 45); None: 8
        maximum_offset       largest distance of parallel planes that are made coplanar, in units of the points; None:
                             maximum_distance
        minimum_region_size  smallest number of points of a shape, at least 3; None: estimated
        simplicity           what the size of a shape is worth, in [0, 1]: smaller, more layers and details; larger, fewer
                             and larger shapes; None: 0.04
        regularity           what a degree of freedom is worth in minimum_region_size, in [0, 10]: larger, more
                             relations; None: 0.1
        surfel_size          edge of the cells whose points are taken as one while shapes grow, as a share of
                             maximum_distance, in [0, 0.55]; 0: each point by itself; None: 0.55
        k_neighbors          number of neighbors of a point, in [3, 64]; None: 12
        cell_size            largest number of points of an octree cell, in [64, 65536]; None: 8192
        regularize_parallelism, regularize_orthogonality, regularize_coplanarity
                             which relations are made exact
        fixed_directions     (d, 3) numbers: directions known beforehand, such as the vertical, of any length. Shapes
                             within angle_tolerance become exactly parallel or orthogonal to them if their points allow
                             it. Opposite ones, and those less than 1e-9 radians apart, are one. None: there are none
        symmetry_direction   three numbers: such a direction, too; and shapes that make nearly the same angle with it,
                             such as the sides of a roof, make exactly the same. None: there is none
        ignore_zeros         whether points exactly at 0 0 0, as invalid pixels of depth cameras are, have no shape, and
                             nothing depends on them. The points are copied then
        backend              "sequential", "parallel" or "cuda"; "auto" takes the fastest of backends(). All of them
                             give the same result.
        threads              largest number of threads; None: all processors
        progress             a function that gets the progress, in [0, 1], and cancels by returning False: the result
                             has the shapes found until then, and is_cancelled is True. An exception of the function
                             ends the call. So does Ctrl-C, with or without a function, at the next report of progress.

    Other threads of Python run during the call.

    Returns PlanarShapes.

    Raises ParameterError, a ValueError with the texts name, value and range: a value is outside of its range, or the
    extent of the points is more than 2^24 times maximum_distance; ValueError, which names the argument: an array has
    the wrong shape or type, or there are too many points; TypeError: an argument is no number; MemoryError;
    RuntimeError: the back end cannot be used here.
    """
    rows, zeros = _points(points, ignore_zeros)
    given = _tandem.given(_normals(normals, rows), _tolerances(maximum_distance_map, len(rows)), zeros)
    settings = _tandem.default_settings()
    _set(settings, _number, maximum_distance=maximum_distance, maximum_angle=maximum_angle,
         angle_tolerance=angle_tolerance, maximum_offset=maximum_offset, simplicity=simplicity, regularity=regularity,
         surfel_size=surfel_size)
    _set(settings, _count, minimum_region_size=minimum_region_size, k_neighbors=k_neighbors, cell_size=cell_size,
         threads=threads)
    if threads is not None and threads < 1:
        raise ValueError(f"threads is {threads}, allowed is 1 or more")
    settings.backend = _backend(backend)
    _set(settings, _switch, regularize_parallelism=regularize_parallelism,
         regularize_orthogonality=regularize_orthogonality, regularize_coplanarity=regularize_coplanarity)
    _set(settings, _directions, fixed_directions=fixed_directions)
    _set(settings, _direction, symmetry_direction=symmetry_direction)
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function, not {type(progress).__name__}")
    return _tandem.detect_planes(rows, given, settings, progress)


def estimate_parameters(
    points: npt.ArrayLike, normals: Optional[npt.ArrayLike] = None, *, ignore_zeros: bool = False
) -> EstimatedParameters:
    """Estimates the parameters that detect_planes() uses where they are not given.

    Arguments and errors are those of detect_planes(). The estimate follows from the noise and spacing of the points; a
    stray point far away from all others spoils it.
    """
    rows, _ = _points(points, ignore_zeros)
    return EstimatedParameters(*_tandem.estimate_parameters(rows, _normals(normals, rows)))


def estimate_local_distances(
    points: npt.ArrayLike, normals: Optional[npt.ArrayLike] = None, *, ignore_zeros: bool = False
) -> npt.NDArray[np.float64]:
    """Estimates a largest distance for each point from the noise around it, for maximum_distance_map of detect_planes().

    Returns an array of shape (n,), NaN for points that are not valid. Arguments and errors are those of detect_planes().
    """
    rows, _ = _points(points, ignore_zeros)
    return _tandem.estimate_local_distances(rows, _normals(normals, rows))


def regularize_planes(
    points: npt.ArrayLike,
    labels: npt.ArrayLike,
    planes: npt.ArrayLike,
    *,
    maximum_angle: Optional[float] = None,
    maximum_offset: Optional[float] = None,
    maximum_distance: Optional[float] = None,
    regularity: Optional[float] = None,
    regularize_parallelism: bool = True,
    regularize_orthogonality: bool = True,
    regularize_coplanarity: bool = True,
    fixed_directions: Optional[npt.ArrayLike] = None,
    symmetry_direction: Optional[npt.ArrayLike] = None,
) -> PlaneRelations:
    """Makes given planes exactly parallel, orthogonal and coplanar where their points allow it.

    For planes of any other detector. The arguments are not changed. Planes that are parallel, orthogonal, coplanar or
    symmetric to another, or have a fixed direction, get a unit normal, also where they had that relation before. The
    others are returned as they are, with normals of any length. Planes keep their orientation. One that has no normal,
    or a number that is not finite, or whose points determine no plane, is neither turned nor moved.

    Arguments
        points            (n, 3) numbers, as those of detect_planes()
        labels            (n,) integers: the plane of each point, -1 or masked if it has none
        planes            (m, 4) numbers: a, b, c, d of each plane a x + b y + c z + d = 0. Masked ones are NaN.
        maximum_angle     angle within which planes are made parallel or orthogonal, in degrees, in [0, 45); None: 25
        maximum_offset    largest distance of parallel planes that are made coplanar, in units of the points; None: 0.01
        maximum_distance  distance that losses are measured by: larger, more relations; None: 2.5 times the root mean
                          square distance of the points to the given planes, at least maximum_offset
        regularity        what a degree of freedom is worth, in numbers of points of the smallest plane, in [0, 10]:
                          larger, more relations; None: 0.1
        regularize_parallelism, regularize_orthogonality, regularize_coplanarity
                          which relations are made exact
        fixed_directions, symmetry_direction
                          as those of detect_planes(), within maximum_angle

    Raises ValueError and TypeError as detect_planes().
    """
    rows = _rows("points", points)
    settings = _tandem.default_settings()
    _set(settings, _number, maximum_distance=maximum_distance, maximum_angle=maximum_angle,
         maximum_offset=maximum_offset, regularity=regularity)
    _set(settings, _switch, regularize_parallelism=regularize_parallelism,
         regularize_orthogonality=regularize_orthogonality, regularize_coplanarity=regularize_coplanarity)
    _set(settings, _directions, fixed_directions=fixed_directions)
    _set(settings, _direction, symmetry_direction=symmetry_direction)
    given = _rows("planes", planes, 4)
    return PlaneRelations(*_tandem.regularize_planes(rows, _labels(labels, len(rows), len(given)), given, settings))


def find_violation(points: npt.ArrayLike, shapes: PlanarShapes) -> Optional[str]:
    """Checks a result against the points that it was detected in; takes a good part of the time of the detection.

    Returns None if the shapes have all that is guaranteed, otherwise the first violation. Raises ValueError as
    detect_planes().
    """
    _check_result(shapes)
    rows, _ = _points(points, shapes.statistics["number_of_ignored_zeros"] > 0)
    if len(rows) != len(shapes.labels):
        raise ValueError(f"points has {len(rows)} rows, but shapes were detected in {len(shapes.labels)} points")
    return _tandem.find_violation(rows, shapes) or None


def backends() -> List[str]:
    """Returns the back ends that can be used here, of "sequential", "parallel" and "cuda"."""
    return _tandem.backends()


def _backend(name: str) -> str:
    names: Tuple[str, ...] = ("auto", "sequential", "parallel", "cuda")
    if not isinstance(name, str) or name not in names:
        raise ValueError(f"backend is {name!r}, allowed are {', '.join(names)}")
    return name
