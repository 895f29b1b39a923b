# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the program detect_planes from outside. TANDEM_PROGRAM is its path; CMakeLists.txt tells what else is needed."""

import pytest

pytest.register_assert_rewrite("support", "clouds")

from support import CLOUD, CUBE, PROGRAM, Program, ply  # noqa: E402


@pytest.fixture(scope="module")
def p(request, tmp_path_factory):
    """The program in a folder of its own with the cube, and with what prepare() of the module makes there."""
    assert PROGRAM, "TANDEM_PROGRAM is not set"
    program = Program(tmp_path_factory.mktemp(request.module.__name__ + " of detect_planes"))
    program.write({"cube.ply": ply(CLOUD, CUBE)})
    program.path("a folder").mkdir()
    getattr(request.module, "prepare", lambda _: None)(program)
    yield program
    assert not list(program.folder.rglob("*.part*")), "files are left over"
