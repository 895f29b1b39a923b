# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Facets of curved surfaces and faces: which shapes of labeled parts and landscapes the column `curved` tells apart."""

import numpy as np
from support import NOTHING, table, text_of

TURN = 2 * np.pi


class Part:
    """Random points on primitives: a plate whose top has a slope of 2 to 15 degrees, a cylinder and a cone with lids, half a
    sphere, a torus, a bent sheet, and a prism of 8 to 10 sides."""

    def __init__(self, seed, density, noise):
        self.random, self.density, self.noise = np.random.default_rng(seed), density, noise
        self.points, self.are_curved, self.primitives = [], [], 0
        between = self.random.uniform
        fall = 4 * np.tan(np.radians(between(2, 15)))
        for origin, u, v in (((0, 0, 0), (10, 0, 0), (0, 10, 0)), ((0, 0, 0), (10, 0, 0), (0, 0, 1)),
                             ((0, 10, 0), (10, 0, 0), (0, 0, 1)), ((0, 0, 0), (0, 10, 0), (0, 0, 1)),
                             ((0, 0, 1), (6, 0, 0), (0, 10, 0)), ((6, 0, 1), (4, 0, -fall), (0, 10, 0))):
            self.face(origin, u, v)
        for x, narrowing in ((2, 1), (7, between(.4, .75))):
            radius, height = between(.9, 1.6), between(1, 3)
            self.turned((x, 14, 0), lambda t: (radius * (1 + (narrowing - 1) * t), height * t), (0, 1))
            self.turned((x, 14, height), lambda t: (radius * narrowing * t, 0 * t), (0, 1), False)
        radius, tube, bent = between(.9, 1.6), between(.5, .9), between(4, 12)
        self.turned((12, 14, 0), lambda t: (radius * np.cos(t), radius * np.sin(t)), (0, TURN / 4))
        self.turned((17, 3, 1), lambda t: (2 + tube * np.cos(t), tube * np.sin(t)), (0, TURN))
        self.turned((25, 0, 0), lambda t: (bent + 0 * t, t), (0, 6), True, TURN / 5)
        sides = self.random.integers(8, 11)
        corners = [np.array((17 + 2 * np.cos(a), 12 + 2 * np.sin(a), 0)) for a in TURN * np.arange(sides + 1) / sides]
        for a, b in zip(corners, corners[1:]):
            self.face(a, b - a, (0, 0, 3))

    def add(self, points, normals, is_curved):
        noise = self.random.normal(0, self.noise, (len(points), 1))
        self.points.append(points + noise * normals)
        self.are_curved.append(np.full(len(points), is_curved))
        self.primitives += 1

    def face(self, origin, u, v):
        normal = np.cross(u, v)
        area = np.linalg.norm(normal)
        a, b = self.random.random((2, int(self.density * area), 1))
        self.add(origin + a * u + b * v, normal / area, False)

    def turned(self, center, profile, ends, is_curved=True, turn=TURN):
        """A profile (radius, height) of a parameter between its ends, turned about a vertical axis."""
        t = np.linspace(*ends, 1001)
        radius, height = profile(t)
        steps = np.stack([np.diff(radius), np.diff(height)], 1)
        areas = np.linalg.norm(steps, axis=1) * (radius[1:] + radius[:-1]) / 2 * turn
        chosen = self.random.choice(1000, int(self.density * areas.sum()), p=areas / areas.sum())
        radius, height = profile(t[chosen] + self.random.random(len(chosen)) * (t[1] - t[0]))
        angle = self.random.random(len(chosen)) * turn
        outward = np.stack([steps[chosen, 1], -steps[chosen, 0]], 1) / np.linalg.norm(steps[chosen], axis=1)[:, None]
        along = np.stack([np.cos(angle), np.sin(angle)], 1)
        self.add(np.column_stack([radius[:, None] * along, height]) + center,
                 np.column_stack([outward[:, :1] * along, outward[:, 1]]), is_curved)


def marks(p, points, are_curved):
    """Of the shapes: whether most of their points are of a curved surface, and whether they are marked."""
    p.write({"part.xyz": text_of(points)})
    p(0, NOTHING, "part.xyz --labels part.labels --shapes part.csv --quiet")
    labels, curved = p.labels("part.labels"), p.csv("part.csv")["curved"]
    assert ((curved >= 0) & (curved <= 1)).all()
    return np.array([are_curved[labels == s].mean() > .5 for s in range(len(curved))]), curved > .5


def test_parts(p):
    """At least 200 primitives, three of four of which are planes: recall and precision"""
    are_facets, are_marked, primitives = [], [], 0
    for seed, (density, noise) in enumerate(2 * [(40, .002), (80, .01), (80, .0002), (60, .02), (50, .005)]):
        part = Part(seed, density, noise)
        primitives += part.primitives
        # Turned: nothing is level.
        turn = np.linalg.qr(part.random.normal(size=(3, 3)))[0]
        for rows, added in zip((are_facets, are_marked),
                               marks(p, np.concatenate(part.points) @ turn, np.concatenate(part.are_curved))):
            rows.extend(added)
    are_facets, are_marked = np.array(are_facets), np.array(are_marked)
    assert primitives >= 200 and are_facets.sum() >= 200 and (~are_facets).sum() >= 150
    assert are_marked[are_facets].mean() >= .9 and are_marked[~are_facets].mean() <= .02


def hill(x, y):
    return 6 * np.exp(-(x ** 2 + y ** 2) / 200)


def roofs(x, y):
    """Slopes of 3 and 6 degrees that meet at a ridge, and one of 12 degrees beside them"""
    return np.where(x < 10, -np.abs(x) * np.tan(np.radians(np.where(x < 0, 3, 6))), 5 - (x - 10) * np.tan(np.radians(12)))


@table("height, is_curved", [(hill, True), (roofs, False)])
def test_landscapes(p, height, is_curved):
    random = np.random.default_rng(3)
    x, y = random.random((2, 15000)) * 40 - 20
    points = np.column_stack([x, y, height(x, y) + random.normal(0, .02, len(x))])
    _, are_marked = marks(p, points, np.full(len(x), is_curved))
    assert are_marked.mean() >= .9 if is_curved else not are_marked.any()


def test_flat_only(p):
    """A round tank on a yard: only the yard is left. The report tells how much of the area was curved."""
    random = np.random.default_rng(5)
    angle, place = random.random(12000) * TURN, random.random((9000, 2)) * 30 - 15
    place = place[np.hypot(*place.T) > 10]
    tank = np.column_stack([10 * np.cos(angle), 10 * np.sin(angle), random.random(len(angle)) * 8])
    yard = np.column_stack([place, np.zeros(len(place))])
    points = np.concatenate([tank, yard]) + random.normal(0, .004, (len(tank) + len(yard), 3))
    p.write({"tank.xyz": text_of(points)})
    p(0, NOTHING, "tank.xyz --report all.json --shapes all.csv --quiet")
    p(0, "--flat-only", "tank.xyz --flat-only --report flat.json --shapes flat.csv --labels flat.labels")
    surface, flat = p.json("all.json")["surface"], p.json("flat.json")["surface"]
    # what is between the facets belongs to none
    assert 0 < TURN * 10 * 8 - surface["curved_area"] < 60 and surface["curved_shapes"] >= 10
    assert abs(surface["area"] - surface["curved_area"] - (900 - TURN * 50)) < 30
    assert flat["curved_area"] == flat["curved_shapes"] == 0
    assert set(p.sizes("flat.labels")) == {-1, 0} and (p.labels("flat.labels")[:len(tank)] < 0).mean() > .98
