# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions on a result of detect_planes(): they select shapes, and label other points by the planes."""

from __future__ import annotations

from typing import Dict, List, Optional, Sequence

import numpy as np
import numpy.typing as npt

from . import _tandem
from ._arguments import _count, _direction, _normals, _number, _numbers, _rows, _set, _switch, _tolerances
from ._tandem import PlanarShapes

_CLASSES = ("floor", "ceiling", "wall", "roof", "ground", "slanted")


def select_shapes(
    shapes: PlanarShapes,
    indices: Optional[npt.ArrayLike] = None,
    *,
    largest: Optional[int] = None,
    minimum_area: Optional[float] = None,
    minimum_extent: Optional[float] = None,
    minimum_width: Optional[float] = None,
    flat_only: bool = False,
    classes: Optional[Sequence[str]] = None,
    near_direction: Optional[npt.ArrayLike] = None,
    orthogonal_direction: Optional[npt.ArrayLike] = None,
    near_angle: Optional[float] = None,
    viewpoint: Optional[npt.ArrayLike] = None,
) -> PlanarShapes:
    """Returns a result with some of the shapes: the shapes of the indices, in their order, or all that fit the criteria.

    Points of other shapes get the label -1, and count as "unselected" in statistics["free_points"]. Planes and relations
    stay as they are. The function numbers groups again and counts shapes and points again, so all guarantees hold. The
    score, the mean distance and the times of the statistics describe the detection. The function measures areas and
    extents on the array of points of the detection: do not change that array before.

    Arguments
        shapes                a result of detect_planes(), which does not change
        indices               integers, or a mask with a truth value for each shape; not together with criteria
        largest               number of shapes: those with most points, of those that fit the other criteria
        minimum_area          smallest area that the points of a shape cover
        minimum_extent        smallest length of a shape: the longer side of the smallest rectangle around points and
                              outline
        minimum_width         smallest width of a shape: the shorter side
        flat_only             whether to leave out facets of curved surfaces: shapes with table()["curved"] above 0.5
        classes               shapes of these classes of table(): any of floor, ceiling, wall, roof, ground, slanted
        near_direction        three numbers: selects shapes with a normal within near_angle of this direction or its
                              opposite. With the vertical, these are level shapes
        orthogonal_direction  three numbers: selects shapes with a normal within near_angle of a right angle to this
                              direction. With the vertical, these are walls
        near_angle            in degrees, in [0, 90]; None: 10
        viewpoint             the place of the sensor, or (n, 3) numbers, a place for each point: leaves out veils, which
                              are no surfaces, but points between a near and a far one. nan: the place is not known

    Raises ValueError and TypeError as detect_planes() does, and ValueError for an index that is not that of a shape, or
    occurs twice.
    """
    _check_result(shapes)
    criteria = (largest, minimum_area, minimum_extent, minimum_width, classes, near_direction, orthogonal_direction,
                near_angle, viewpoint)
    if indices is not None:
        if _switch("flat_only", flat_only) or any(criterion is not None for criterion in criteria):
            raise ValueError("indices are not together with criteria: select twice")
        return _tandem.select_shapes(shapes, _indices(indices, len(shapes)))
    sizes = {"minimum_area": minimum_area, "minimum_extent": minimum_extent, "minimum_width": minimum_width}
    shapes = _measured(shapes, sizes, _switch("flat_only", flat_only), classes)
    selection = _tandem.default_selection()
    _set(selection, _count, largest=largest)
    _set(selection, _number, near_angle=near_angle)
    _set(selection, _direction, near_direction=near_direction, orthogonal_direction=orthogonal_direction)
    return _tandem.select_shapes_by(shapes, selection, viewpoint)


def label_points(
    shapes: PlanarShapes,
    points: npt.ArrayLike,
    normals: Optional[npt.ArrayLike] = None,
    *,
    maximum_distance: Optional[float] = None,
    maximum_distance_map: Optional[npt.ArrayLike] = None,
    maximum_angle: Optional[float] = None,
    reach: Optional[float] = None,
) -> npt.NDArray[np.int32]:
    """Labels other points by the planes of a result: all points of a cloud, for example, after a detection in some.

    A point gets the shape with the nearest plane, of those within maximum_distance and, if you pass normals,
    maximum_angle, that have a point within reach. Points of a shape need not be connected, and may be few. The labels do
    not depend on the order of the points.

    Arguments
        shapes                a result of detect_planes()
        points                (n, 3) numbers
        normals               (n, 3) numbers, of any length and orientation; None: only distances count
        maximum_distance, maximum_angle
                              as those of detect_planes(); None: the values of the detection
        maximum_distance_map  as that of detect_planes(), for these points
        reach                 largest distance from a point to the nearest point of its shape in the detection; None: four
                              times the median spacing of the points of the detection. If their density varies much, pass
                              more. Infinite: planes are unbounded, and the first of coplanar shapes gets all points

    Returns an array of shape (n,), int32: -1 for points that no shape takes, and for points that are not valid.

    Raises ValueError and TypeError as detect_planes() does. Unless reach is infinite, the function reads the points of the
    detection again, and raises ValueError if one of them is no longer on its plane.
    """
    _check_result(shapes)
    rows = _rows("points", points)
    labeling = _tandem.default_labeling()
    _set(labeling, _number, maximum_distance=maximum_distance, maximum_angle=maximum_angle, reach=reach)
    given = _tandem.given(_normals(normals, rows), _tolerances(maximum_distance_map, len(rows)), 0)
    return _tandem.label_points(shapes, rows, given, labeling)


def _measured(
    shapes: PlanarShapes, sizes: Dict[str, Optional[float]], flat_only: bool, classes: Optional[Sequence[str]]
) -> PlanarShapes:
    """Those that fit criteria on columns of their table."""
    least = {name: _number(name, size) for name, size in sizes.items() if size is not None}
    for name, number in least.items():
        if number is None or not 0 <= number < float("inf"):
            raise ValueError(f"{name} is {number}, must be at least 0 and finite")
    if classes is not None and (isinstance(classes, str) or not set(classes) <= set(_CLASSES)):
        raise ValueError(f"classes must be a list of any of {', '.join(_CLASSES)}, not {classes!r}")
    if not least and not flat_only and classes is None:
        return shapes
    table = shapes.table()
    is_kept = np.full(len(shapes), True)
    columns = {"minimum_area": "area", "minimum_extent": "length", "minimum_width": "width"}
    for name, number in least.items():
        if number:  # what has no size is at least 0
            is_kept &= table[columns[name]] >= number
    if flat_only:
        is_kept &= ~(table["curved"] > 0.5)
    if classes is not None:
        is_kept &= np.isin(table["class"], list(classes))
    return _tandem.select_shapes(shapes, np.flatnonzero(is_kept).tolist())


def _check_result(shapes: PlanarShapes) -> None:
    if not isinstance(shapes, PlanarShapes):
        raise TypeError(f"shapes must be a result of detect_planes(), not {type(shapes).__name__}")


def _indices(values: npt.ArrayLike, shapes: int) -> List[int]:
    if np.size(values) == 0:
        return []
    array = _numbers("indices", values, "iub", "integers or truth values")
    if array.ndim != 1 or (array.dtype.kind == "b" and len(array) != shapes):
        raise ValueError(f"indices must be a list of integers, or a truth value for each of the {shapes} shapes, but its "
                         f"shape is {array.shape}")
    return (np.flatnonzero(array) if array.dtype.kind == "b" else array).tolist()
