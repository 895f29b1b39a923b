# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What detect_planes() warns of. The program says the same, of options: test_programs.py."""

import warnings

import numpy as np
import pytest

import tandem
from clouds import MAXIMUM_DISTANCE, room

POINTS = room()[0]
FAR = (500000, 4500000, 100)
PLACE = np.ones((300, 3))
TURNED = room()[1].copy()
TURNED[::10] = np.roll(TURNED[::10], 1, axis=1)

CASES = [
    ((POINTS + FAR).astype(np.float32), {}, "^the coordinates are rounded, x in steps of 0.03125, y in steps of 0.5.*: use dou"),
    (POINTS / (400, 300, 0.1) + (-71.06, 42.36, 0), {"maximum_distance": 0.1}, "degrees of longitude and latitude .*project"),
    (np.concatenate([POINTS + FAR, np.zeros((20, 3))]), {}, "^20 points are exactly at 0 0 0, .*: ignore_zeros leaves"),
    (np.zeros((0, 3)), {}, "^no shape was found: the number of points is 0, but .* at least .* .minimum_region_size"),
    (PLACE, {}, "^no shape was found: no .* connected points .minimum_region_size., .* .maximum_distance. .*maximum_angle"),
    (POINTS, {"maximum_distance_map": np.zeros(len(POINTS))}, "a positive tolerance .maximum_distance_map.$"),
    (np.random.default_rng(2).random((4000, 3)), {"maximum_distance": 0.001}, "^(no shape|only .* % of the points)"),
    (POINTS, {"normals": TURNED}, "^given normals keep 9[0-9.]* % of the points out of shapes .*: normals=None mostly adds about"),
    (POINTS, {"maximum_distance": 0.5}, "^the maximum distance 0.5 is more than a tenth .*: a smaller maximum_distance"),
    (POINTS, {"maximum_distance": 0.0001}, "^the maximum distance 0.0001 is less than a tenth of the noise .*maximum_distance"),
    (POINTS, {"maximum_angle": 0.9}, "^the maximum angle is 0.9 degrees: if that was meant as a cosine")]


@pytest.mark.parametrize("points, given, pattern", CASES)
def test_warnings(points, given, pattern):
    with pytest.warns(tandem.TandemWarning, match=pattern) as caught:
        tandem.detect_planes(points, **{"maximum_distance": MAXIMUM_DISTANCE, **given})
    assert all(warning.category is tandem.TandemWarning and warning.filename == __file__ for warning in caught)
    assert not any("--" in str(warning.message) for warning in caught)
    assert issubclass(tandem.TandemWarning, UserWarning)


def test_nothing_to_say():
    zeros = np.concatenate([POINTS + FAR, np.zeros((20, 3))])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tandem.detect_planes(*room(), maximum_distance=MAXIMUM_DISTANCE)
        tandem.detect_planes(POINTS, threads=1)
        tandem.detect_planes(zeros, maximum_distance=MAXIMUM_DISTANCE, ignore_zeros=True)
        assert tandem.detect_planes(POINTS, progress=lambda _: False).is_cancelled
        warnings.simplefilter("ignore", tandem.TandemWarning)
        assert len(tandem.detect_planes(PLACE)) == 0
