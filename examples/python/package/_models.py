# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Methods of a result: models of the shapes as arrays, and pickling."""

from __future__ import annotations

from typing import Any, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from . import _tandem
from ._arguments import _count, _direction, _number, _rows, _switch
from ._tandem import PlanarShapes, __version__


class Polygons(NamedTuple):
    """The areas that the points of shapes cover: p polygons with holes, in new arrays."""

    vertices: npt.NDArray[np.float64]  #: (v, 3): the corners of all polygons, each once, in units of the points
    triangles: npt.NDArray[np.int32]  #: (t, 3): vertices, counterclockwise as seen from where the normal of the plane points
    triangle_shape: npt.NDArray[np.int32]  #: (t,): the shape, or with one_for_each_plane the coplanar group, of each
    loop_vertices: npt.NDArray[np.int32]  #: the vertices of all loops: outer boundaries counterclockwise, holes clockwise
    loop_starts: npt.NDArray[np.int32]  #: (l + 1,): loop i is loop_vertices[loop_starts[i]:loop_starts[i + 1]]
    polygon_starts: npt.NDArray[np.int32]  #: (p + 1,): loops of polygon i begin there: its outer boundary, then its holes
    polygon_shape: npt.NDArray[np.int32]  #: (p,): the shape, or the coplanar group, of each polygon, ascending

    def rings(self) -> List[List[npt.NDArray[np.float64]]]:
        """Returns the loops of each polygon as arrays of shape (k, 3), first the outer boundary, then the holes.

        The first corner is not there again as the last one.
        """
        loops = np.split(self.vertices[self.loop_vertices], self.loop_starts[1:-1])
        return [loops[first:last] for first, last in zip(self.polygon_starts[:-1], self.polygon_starts[1:])]


class Lines(NamedTuple):
    """The lines at which shapes meet: s segments where two do, and c corners where three do, in new arrays."""

    vertices: npt.NDArray[np.float64]  #: (v, 3): ends of segments and corners, each once, in units of the points
    segments: npt.NDArray[np.int32]  #: (s, 2): the vertices of both ends
    segment_shapes: npt.NDArray[np.int32]  #: (s, 2): the two shapes, ascending
    corners: npt.NDArray[np.int32]  #: (c,): the vertex of each corner, ascending
    corner_shapes: npt.NDArray[np.int32]  #: the shapes of all corners
    corner_starts: npt.NDArray[np.int32]  #: (c + 1,): corner i has corner_shapes[corner_starts[i]:corner_starts[i + 1]]


class ClosedSurface(NamedTuple):
    """A closed surface of f faces in the planes of shapes, in new arrays. It has no face if the planes enclose nothing."""

    vertices: npt.NDArray[np.float64]  #: (v, 3): the corners, in units of the points
    triangles: npt.NDArray[np.int32]  #: (t, 3): vertices, counterclockwise as seen from outside; they do not cross
    triangle_face: npt.NDArray[np.int32]  #: (t,): the face of each triangle, ascending
    face_vertices: npt.NDArray[np.int32]  #: the vertices of all faces, counterclockwise as seen from outside
    face_starts: npt.NDArray[np.int32]  #: (f + 1,): face i is face_vertices[face_starts[i]:face_starts[i + 1]]
    face_plane: npt.NDArray[np.int32]  #: (f,): the coplanar group; -1 for added walls and faces of the box of the points
    face_supported: npt.NDArray[np.float64]  #: (f,): the share of the area that outlines of shapes cover, in [0, 1]
    supported: float  #: the same share of the area of all faces
    number_of_points: int  #: the points of shapes whose plane is the surface where they are
    number_of_planes: int  #: the distinct planes that were considered
    number_of_omitted_planes: int  #: those that were not, which have fewer points


def polygons(self: PlanarShapes, one_for_each_plane: bool = False) -> Polygons:
    """Returns the areas that the points of the shapes cover, as polygons with holes in the planes of the shapes.

    Boundaries follow the points at their spacing. Where shapes meet, they have common vertices. A shape has any number of
    polygons, none if its points cover less than 20 squares of their spacing. Polygons of a shape are simple and apart.

    Arguments
        one_for_each_plane  whether coplanar shapes have their polygons together, instead of each its own

    The function reads the array of points of detect_planes() again, and raises ValueError if a point in the array has
    changed and is no longer on its plane. Other threads of Python run during the call.
    """
    return Polygons(*_tandem.polygons(self, _switch("one_for_each_plane", one_for_each_plane)))


def lines(self: PlanarShapes) -> Lines:
    """Returns the lines at which the shapes meet: segments in the outlines of two shapes, and corners of three.

    The function reads the array of points of detect_planes() again, and raises ValueError if a point in the array has
    changed and is no longer on its plane. Other threads of Python run during the call.
    """
    return Lines(*_tandem.lines(self))


def upward_direction(self: PlanarShapes) -> Tuple[float, float, float]:
    """Returns the unit vector upward, to which most points are level, as floors are, or upright, as walls are.

    It is z where that holds for z, or where the shapes do not tell.
    """
    return _tandem.upward_direction(self)


def closed_surface(
    self: PlanarShapes,
    *,
    maximum_number_of_planes: Optional[int] = None,
    maximum_number_of_components: Optional[int] = None,
    symmetry_direction: Optional[npt.ArrayLike] = None,
    base_height: Optional[float] = None,
    footprints: Optional[Sequence[Sequence[npt.ArrayLike]]] = None,
) -> ClosedSurface:
    """Returns a closed surface whose faces are in the planes of the shapes: each edge has two faces, oriented alike.

    Walls that have no points, as in airborne scans, are added below the borders of shapes. Exact predicates have checked
    that the surface does not cross itself. It has no faces if the planes enclose nothing.

    Arguments
        maximum_number_of_planes      how many distinct planes may bound the surface, those with most points, at least 4;
                                      None: all, if they do not cut the box of the points into more than 400,000 cells
        maximum_number_of_components  how many components the surface may have, those with the largest areas; None or 0:
                                      all that have at least a hundredth of the area of the largest
        symmetry_direction            three numbers: the direction upward; None: that of detect_planes(), or z
        base_height                   the height of the ground, in units of the points: nothing below is inside, and roofs
                                      are closed down to it. None: not known
        footprints                    polygons, each a sequence of rings: (k, 2) numbers, the outer boundary first, then
                                      the holes, as xy of the points. Each has a surface of its own, with walls on its
                                      edges, down to base_height or the lowest point of a shape near. None: one of all

    The function reads the array of points of detect_planes() again. Other threads of Python run during the call.

    Raises ParameterError for a value outside of its range; ValueError if a point in the array has changed and is no longer
    on its plane; TypeError for an argument that is no number; RuntimeError if the surface would cross itself as its
    vertices are rounded.
    """
    planes = _count("maximum_number_of_planes", maximum_number_of_planes)
    components = _count("maximum_number_of_components", maximum_number_of_components)
    upward = _direction("symmetry_direction", symmetry_direction)
    rings = [[_ring(ring) for ring in footprint] for footprint in footprints or []]
    base = _number("base_height", base_height)
    return ClosedSurface(*_tandem.closed_surface(self, planes, components, upward, base, rings))


def _ring(corners: npt.ArrayLike) -> List[List[float]]:
    return _rows("footprints", corners, 2).tolist()  # type: ignore[no-any-return]


def _unpickled(version: str, *state: Any) -> PlanarShapes:
    if version != __version__:
        raise ValueError(f"tandem {__version__} cannot read a pickle of tandem {version}: detect the planes again")
    return _tandem.result_of(*state)


def _reduced(self: PlanarShapes) -> Tuple[Any, ...]:
    return _unpickled, (__version__, *_tandem.state_of(self))


for _name, _method in {"polygons": polygons, "lines": lines, "closed_surface": closed_surface, "upward_direction": upward_direction,
                       "__reduce__": _reduced}.items():
    setattr(PlanarShapes, _name, _method)
