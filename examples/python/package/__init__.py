# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the planes of point clouds; nearly parallel, orthogonal or coplanar planes become exactly so.

    import numpy as np
    import tandem
    shapes = tandem.detect_planes(points)         # points: an array of shape (n, 3)
    for s, (a, b, c, d) in enumerate(shapes.planes):
        print(a, b, c, d, len(shapes.points_of(s)), shapes.parallel_groups[s])

The result has the same bits for every back end, number of threads and order of the points, and in the C++ package and
the program detect_planes.
"""

from __future__ import annotations

import re
import warnings
from typing import Callable, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _tandem
from ._arguments import (_count, _direction, _directions, _labels, _normals, _number, _points, _rows, _set, _switch,
                         _tolerances)
from ._models import ClosedSurface, Lines, Polygons
from ._selection import _check_result, label_points, select_shapes
from ._tandem import ParameterError, PlanarShapes, __version__

__all__ = ["ClosedSurface", "EstimatedParameters", "Lines", "ParameterError", "PlanarShapes", "PlaneRelations", "Polygons",
           "TandemWarning", "__version__", "backends", "detect_planes", "estimate_local_distances", "estimate_parameters",
           "find_violation", "label_points", "regularize_planes", "select_shapes"]

Progress = Callable[[float], Optional[bool]]


class TandemWarning(UserWarning):
    """Something is wrong with a cloud or its shapes: the text says what, and which argument to change."""


class EstimatedParameters(NamedTuple):
    """Parameters for detect_planes(). Lengths are in units of the points."""

    maximum_distance: float
    maximum_offset: float
    minimum_region_size: int


class PlaneRelations(NamedTuple):
    """The m planes that regularize_planes() returns, and their relations."""

    planes: npt.NDArray[np.float64]  #: (m, 4): a, b, c, d; planes that are related or changed have a unit normal
    parallel_groups: npt.NDArray[np.int32]  #: (m,): planes of a group have the same unit normal, up to its sign
    coplanar_groups: npt.NDArray[np.int32]  #: (m,): planes of a group are the same plane, up to its sign
    orthogonal_pairs: npt.NDArray[np.int32]  #: (p, 2): pairs of parallel groups, the smaller number first, sorted
    is_changed: npt.NDArray[np.bool_]  #: (m,): whether the function turned or moved the plane
    is_rolled_back: npt.NDArray[np.bool_]  #: (m,): whether a direction is near, but would cost the points too much
    angles: npt.NDArray[np.float64]  #: (m,): the angle by which the function turned each plane, in degrees
    largest_distances: npt.NDArray[np.float64]  #: (m,): largest distance of the points of each plane to that plane
    maximum_distance: float  #: the distance by which the function measured costs


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
    fixed_regularity: Optional[float] = None,
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
    """Detects planar shapes and makes shapes that are nearly parallel, orthogonal or coplanar exactly so.

    Each point of a shape is within maximum_distance and maximum_angle of the final plane of its shape. Points with a
    coordinate that is not finite, or a given normal that is null or not finite, belong to no shape: their label is -1,
    and the statistics count them. Masked numbers of a masked array count as not finite.

    Arguments
        points               (n, 3) numbers. The function reads a C-contiguous array of float64 without a copy and
                             converts other arrays. Do not change the array during the call.
        normals              (n, 3) numbers, of any length and orientation; the function copies them. None: estimated
        maximum_distance     largest distance of a point to the plane of its shape, in units of the points; None: the
                             value that nearly all numbers of maximum_distance_map do not exceed, or, without that map,
                             the estimate of estimate_parameters(). The largest number of the map bounds this value
        maximum_distance_map (n,) numbers: the largest distance of each point, at most maximum_distance; the function
                             copies them. Points without a positive number have no shape, and the statistics count them.
                             None: maximum_distance for all points. estimate_local_distances() estimates such a map
        maximum_angle        largest angle between the normal of a point and that of its shape, in degrees, in
                             [0.05, 90); None: 25
        angle_tolerance      angle within which planes become parallel or orthogonal, in degrees, in [0, 45); None: 8
        maximum_offset       distance within which parallel planes become coplanar, in units of the points; None:
                             maximum_distance
        minimum_region_size  smallest number of points of a shape, at least 3; None: estimated
        simplicity           what the size of a shape is worth, in [0, 1]. Smaller: more layers and details. Larger: fewer
                             and larger shapes. None: 0.08
        regularity           what a degree of freedom is worth, in minimum_region_size, in [0, 10]. Larger: more
                             relations. None: 0.1
        fixed_regularity     the same for relations to fixed_directions and symmetry_direction, if that is more. With 2,
                             nearly all shapes within angle_tolerance become parallel or orthogonal to them. None: 0
        surfel_size          width of the cubes whose points are taken as one while shapes grow, divided by
                             maximum_distance, in [0, 0.55]; 0: each point by itself; None: 0.55
        k_neighbors          number of neighbors of a point, in [3, 64]; None: 12
        cell_size            largest number of points of an octree cell, in [64, 65536]; None: 8192
        regularize_parallelism, regularize_orthogonality, regularize_coplanarity
                             whether this relation becomes exact
        fixed_directions     (d, 3) numbers: directions known beforehand, such as the vertical, of any length. Shapes
                             within angle_tolerance become exactly parallel or orthogonal to them if their points allow
                             it. Directions that are opposite, or less than 1e-9 radians apart, count as one
        symmetry_direction   three numbers: another fixed direction. Shapes that make nearly the same angle with it, such
                             as the two sides of a roof, then make exactly the same angle. None: no direction
        ignore_zeros         whether to ignore points exactly at 0 0 0, such as invalid pixels of depth cameras: they
                             have no shape and change nothing. Then the function copies the points
        backend              "sequential", "parallel" or "cuda"; "auto" takes the fastest of backends(). All back ends
                             give the same result.
        threads              largest number of threads; None: all processors
        progress             a function that gets the progress, in [0, 1], and cancels by returning False: the result
                             has the shapes found until then, and is_cancelled is True. An exception of the function
                             ends the call. So does Ctrl-C, with or without a function, at the next report of progress.

    Other threads of Python run during the call.

    Returns PlanarShapes.

    Warns with TandemWarning of coordinates that are rounded or look like degrees, of points at 0 0 0, of no shapes or few
    points in shapes, of normals that keep points out of shapes, and of a maximum_distance or an angle that does not
    fit; not if progress has cancelled.

    Raises ParameterError, a ValueError with the texts name, value and range, for a value outside of its range, or an
    extent of the points of more than 2^24 times maximum_distance; ValueError, which names the argument, for an array of
    wrong shape or type, or too many points; TypeError for an argument that is no number; MemoryError; RuntimeError for a
    back end that cannot be used here.
    """
    rows, zeros = _points(points, ignore_zeros)
    given = _tandem.given(_normals(normals, rows), _tolerances(maximum_distance_map, len(rows)), zeros)
    settings = _tandem.default_settings()
    _set(settings, _number, maximum_distance=maximum_distance, maximum_angle=maximum_angle,
         angle_tolerance=angle_tolerance, maximum_offset=maximum_offset, simplicity=simplicity, regularity=regularity,
         fixed_regularity=fixed_regularity, surfel_size=surfel_size)
    _set(settings, _count, minimum_region_size=minimum_region_size, k_neighbors=k_neighbors, cell_size=cell_size,
         threads=threads)
    settings.backend = _backend(backend)
    _set(settings, _switch, regularize_parallelism=regularize_parallelism,
         regularize_orthogonality=regularize_orthogonality, regularize_coplanarity=regularize_coplanarity)
    _set(settings, _directions, fixed_directions=fixed_directions)
    _set(settings, _direction, symmetry_direction=symmetry_direction)
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function, not {type(progress).__name__}")
    shapes = _tandem.detect_planes(rows, given, settings, progress)
    for text in [] if shapes.is_cancelled else _tandem.warnings(rows, given, settings, shapes):
        text = text.replace("--estimate-normals", "normals=None")
        text = re.sub("--([a-z-]+)", lambda option: option[1].replace("-", "_"), text)
        warnings.warn(text, TandemWarning, stacklevel=2)
    return shapes


def estimate_parameters(
    points: npt.ArrayLike, normals: Optional[npt.ArrayLike] = None, *, ignore_zeros: bool = False
) -> EstimatedParameters:
    """Estimates the parameters that detect_planes() uses if you do not pass them.

    Arguments and errors are those of detect_planes(). The estimate uses the noise and the spacing of the points. Stray
    points far away from all others make it wrong.
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
    """Makes given planes exactly parallel, orthogonal and coplanar if their points allow it.

    The planes may come from any detector. The function does not change its arguments. Planes that are parallel,
    orthogonal, coplanar or symmetric to another plane, or have a fixed direction, get a unit normal, also if they had
    that relation before. The function returns the other planes unchanged. Planes keep their orientation. A plane with a
    null normal or a number that is not finite, or whose points determine no plane, neither turns nor moves.

    Arguments
        points            (n, 3) numbers, as those of detect_planes()
        labels            (n,) integers: the plane of each point, -1 or masked if it has none
        planes            (m, 4) numbers: a, b, c, d of each plane a x + b y + c z + d = 0. Masked numbers count as NaN.
        maximum_angle     angle within which planes become parallel or orthogonal, in degrees, in [0, 45); None: 25
        maximum_offset    distance within which parallel planes become coplanar, in units of the points; None: 0.01
        maximum_distance  distance by which the function measures costs. Larger: more relations. None: 2.5 times the
                          root mean square distance of the points to the given planes, at least maximum_offset
        regularity        what a degree of freedom is worth, in numbers of points of the smallest plane, in [0, 10].
                          Larger: more relations. None: 0.1
        regularize_parallelism, regularize_orthogonality, regularize_coplanarity
                          whether this relation becomes exact
        fixed_directions, symmetry_direction
                          as those of detect_planes(), within maximum_angle

    Raises ValueError and TypeError as detect_planes() does.
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
    """Checks all guarantees of a result, for the points of its detection. Takes nearly as long as the detection.

    Returns None if all guarantees hold, otherwise a text that describes the first violation. Raises ValueError as
    detect_planes() does.
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
