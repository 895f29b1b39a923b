# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later

from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._models import ClosedSurface, Lines, Polygons

__version__: str

class ParameterError(ValueError):
    name: str
    value: str
    range: str

class PlanarShapes:
    @property
    def planes(self) -> npt.NDArray[np.float64]: ...
    @property
    def labels(self) -> npt.NDArray[np.int32]: ...
    @property
    def parallel_groups(self) -> npt.NDArray[np.int32]: ...
    @property
    def coplanar_groups(self) -> npt.NDArray[np.int32]: ...
    @property
    def orthogonal_pairs(self) -> npt.NDArray[np.int32]: ...
    @property
    def fixed_directions(self) -> npt.NDArray[np.int32]: ...
    @property
    def symmetry_groups(self) -> npt.NDArray[np.int32]: ...
    @property
    def is_flipped(self) -> npt.NDArray[np.bool_]: ...
    @property
    def normals(self) -> npt.NDArray[np.float64]: ...
    @property
    def statistics(self) -> Dict[str, Any]: ...
    @property
    def uncertainties(self) -> Dict[str, npt.NDArray[np.float64]]: ...
    @property
    def parameters(self) -> Dict[str, Any]: ...
    @property
    def maximum_distance(self) -> float: ...
    @property
    def minimum_region_size(self) -> int: ...
    @property
    def is_cancelled(self) -> bool: ...
    @property
    def hash(self) -> int: ...
    def table(self, viewpoint: Optional[npt.ArrayLike] = None) -> Dict[str, npt.NDArray[Any]]: ...
    def points_of(self, shape: int) -> npt.NDArray[np.uint32]: ...
    def polygons(self, one_for_each_plane: bool = False) -> Polygons: ...
    def closed_surface(
        self,
        *,
        maximum_number_of_planes: Optional[int] = None,
        maximum_number_of_components: Optional[int] = None,
        symmetry_direction: Optional[npt.ArrayLike] = None,
        base_height: Optional[float] = None,
        footprints: Optional[Sequence[Sequence[npt.ArrayLike]]] = None,
    ) -> ClosedSurface: ...
    def lines(self) -> Lines: ...
    def upward_direction(self) -> Tuple[float, float, float]: ...
    def __len__(self) -> int: ...

class Settings:
    maximum_distance: Optional[float]
    maximum_angle: Optional[float]
    angle_tolerance: Optional[float]
    maximum_offset: Optional[float]
    minimum_region_size: Optional[int]
    simplicity: Optional[float]
    regularity: Optional[float]
    fixed_regularity: Optional[float]
    surfel_size: Optional[float]
    k_neighbors: Optional[int]
    cell_size: Optional[int]
    threads: Optional[int]
    regularize_parallelism: bool
    regularize_orthogonality: bool
    regularize_coplanarity: bool
    fixed_directions: List[Tuple[float, float, float]]
    symmetry_direction: Optional[Tuple[float, float, float]]
    backend: str

class Selection:
    largest: Optional[int]
    near_angle: Optional[float]
    near_direction: Optional[Tuple[float, float, float]]
    orthogonal_direction: Optional[Tuple[float, float, float]]

class Labeling:
    maximum_distance: Optional[float]
    maximum_angle: Optional[float]
    reach: Optional[float]

class Given: ...

def given(
    normals: Optional[npt.NDArray[np.float64]], tolerances: Optional[npt.NDArray[np.float64]], zeros: int
) -> Given: ...
def default_settings() -> Settings: ...
def detect_planes(
    points: npt.NDArray[np.float64],
    given: Given,
    settings: Settings,
    progress: Optional[Callable[[float], Optional[bool]]],
) -> PlanarShapes: ...
def warnings(
    points: npt.NDArray[np.float64], given: Given, settings: Settings, shapes: PlanarShapes
) -> List[str]: ...
def estimate_parameters(
    points: npt.NDArray[np.float64], normals: Optional[npt.NDArray[np.float64]]
) -> Tuple[float, float, int]: ...
def estimate_local_distances(
    points: npt.NDArray[np.float64], normals: Optional[npt.NDArray[np.float64]]
) -> npt.NDArray[np.float64]: ...
def regularize_planes(
    points: npt.NDArray[np.float64],
    labels: npt.NDArray[np.int32],
    planes: npt.NDArray[np.float64],
    settings: Settings,
) -> Tuple[Any, ...]: ...
def default_selection() -> Selection: ...
def default_labeling() -> Labeling: ...
def select_shapes(shapes: PlanarShapes, indices: List[int]) -> PlanarShapes: ...
def select_shapes_by(
    shapes: PlanarShapes, selection: Selection, viewpoint: Optional[npt.ArrayLike]
) -> PlanarShapes: ...
def label_points(
    shapes: PlanarShapes, points: npt.NDArray[np.float64], given: Given, labeling: Labeling
) -> npt.NDArray[np.int32]: ...
def polygons(shapes: PlanarShapes, one_for_each_plane: bool) -> Tuple[Any, ...]: ...
def closed_surface(
    shapes: PlanarShapes,
    planes: Optional[int],
    components: Optional[int],
    upward: Optional[Tuple[float, float, float]],
    base: Optional[float],
    footprints: List[List[List[Tuple[float, float]]]],
) -> Tuple[Any, ...]: ...
def lines(shapes: PlanarShapes) -> Tuple[Any, ...]: ...
def upward_direction(shapes: PlanarShapes) -> Tuple[float, float, float]: ...
def state_of(shapes: PlanarShapes) -> Tuple[Any, ...]: ...
def result_of(
    bytes: bytes,
    points: npt.NDArray[np.float64],
    normals: Optional[npt.NDArray[np.float64]],
    tolerances: Optional[npt.NDArray[np.float64]],
    zeros: int,
) -> PlanarShapes: ...
def find_violation(points: npt.NDArray[np.float64], shapes: PlanarShapes) -> str: ...
def backends() -> List[str]: ...
