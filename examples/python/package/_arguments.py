# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks and converts the arguments of the package. An error names the wrong argument."""

from __future__ import annotations

import operator
from typing import Any, Callable, List, Optional, Tuple

import numpy as np
import numpy.typing as npt


def _numbers(name: str, values: Any, kinds: str, what: str) -> npt.NDArray[Any]:
    """An array, which is masked if the values are, or rows of them."""
    has_masks = isinstance(values, (list, tuple)) and any(isinstance(v, np.ma.MaskedArray) for v in values)
    try:
        array = np.ma.array(values) if has_masks else np.asanyarray(values)
    except ValueError as error:  # rows of different lengths
        raise ValueError(f"{name} must be an array of {what}: {error}") from None
    if array.dtype.kind not in kinds:
        advice = f"; of a cloud of Open3D pass np.asarray(cloud.{name})" if hasattr(values, name) else ""
        raise ValueError(f"{name} must be an array of {what}, but its type is {array.dtype}{advice}")
    return array


def _rows(name: str, values: npt.ArrayLike, columns: int = 3) -> npt.NDArray[np.float64]:
    """Contiguous rows of float64: the array itself if it is like that. Masked numbers are NaN."""
    array = _numbers(name, values, "fiu", "numbers")
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name} must have the shape (n, {columns}), but it has {array.shape}")
    if np.ma.is_masked(array):
        array = np.ma.filled(array.astype(np.float64), np.nan)
    return np.require(array, np.float64, ["C", "A", "E"])


def _points(values: npt.ArrayLike, ignore_zeros: bool) -> Tuple[npt.NDArray[np.float64], int]:
    """Rows, and how many are at 0 0 0, where those are ignored: they are NaN in a copy."""
    rows = _rows("points", values)
    if not _switch("ignore_zeros", ignore_zeros):
        return rows, 0
    is_zero = ~rows.any(axis=1)
    return np.where(is_zero[:, None], np.nan, rows), int(np.count_nonzero(is_zero))


def _normals(values: Optional[npt.ArrayLike], points: npt.NDArray[np.float64]) -> Optional[npt.NDArray[np.float64]]:
    """A copy, since the result keeps it."""
    if values is None:
        return None
    normals = _rows("normals", values)
    if len(normals) != len(points):
        raise ValueError(f"normals must have a row for each of the {len(points)} points, but it has {len(normals)}")
    return normals.copy()


def _tolerances(values: Optional[npt.ArrayLike], points: int) -> Optional[npt.NDArray[np.float64]]:
    """A copy, since the result keeps it. Masked numbers are NaN."""
    if values is None:
        return None
    array = _numbers("maximum_distance_map", values, "fiu", "numbers")
    if array.shape != (points,):
        raise ValueError(f"maximum_distance_map must have a number for each of the {points} points, the shape "
                         f"({points},), but it has {array.shape}")
    return np.array(np.ma.filled(array.astype(np.float64), np.nan), np.float64, order="C")


def _labels(labels: npt.ArrayLike, points: int, planes: int) -> npt.NDArray[np.int32]:
    array = _numbers("labels", labels, "iu", "integers")
    if array.shape != (points,):
        raise ValueError(f"labels must have the shape ({points},), as the points, but it has {array.shape}")
    given = np.ma.compressed(array)
    if given.size > 0 and (given.min() < -1 or given.max() >= planes):
        raise ValueError(f"labels are in [{given.min()}, {given.max()}], allowed is -1 or the index of a plane, "
                         f"below {planes}")
    return np.require(np.ma.filled(array.astype(np.int32), -1), np.int32, ["C", "A", "E"])


def _number(name: str, value: Any) -> Optional[float]:
    if value is None:
        return None
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{name} must be a number, not {type(value).__name__}")
    try:
        return float(value)
    except TypeError:
        raise TypeError(f"{name} must be a number, not {type(value).__name__}") from None
    except (OverflowError, ValueError) as error:
        raise ValueError(f"{name} is out of its range: {error}") from None


def _count(name: str, value: Any) -> Optional[int]:
    if value is None:
        return None
    try:
        count = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer, not {type(value).__name__}") from None
    if count.bit_length() > 63:  # not written out: it may have any number of digits
        raise ValueError(f"{name} is out of its range: it has {count.bit_length()} bits")
    return count


def _switch(name: str, value: Any) -> bool:
    try:
        return bool(value)
    except ValueError as error:  # an array
        raise ValueError(f"{name} must be true or false: {error}") from None


def _direction(name: str, value: Optional[npt.ArrayLike]) -> Optional[Tuple[float, float, float]]:
    if value is None:
        return None
    x, y, z = _rows(name, [value])[0].tolist()
    return x, y, z


def _directions(name: str, values: Optional[npt.ArrayLike]) -> List[Tuple[float, float, float]]:
    return [] if values is None else [(d[0], d[1], d[2]) for d in _rows(name, values).tolist()]


def _set(arguments: Any, check: Callable[[str, Any], Any], **values: Any) -> None:
    for name, value in values.items():
        setattr(arguments, name, check(name, value))
