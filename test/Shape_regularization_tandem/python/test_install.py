# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The component `python` of TANDEM_BUILD is installed, and imported from there, TANDEM_PYTHON_DIR below its prefix."""

import os
import subprocess
import sys

import pytest

FOLDER = os.environ.get("TANDEM_PYTHON_DIR")
CHECK = """import tandem, sys; assert tandem.__file__.startswith(sys.argv[1]), tandem.__file__
assert len(tandem.detect_planes([[x, y, 0] for x in range(20) for y in range(20)])) == 1"""


@pytest.mark.skipif(not FOLDER, reason="the build installs nothing")
def test_installed(tmp_path):
    subprocess.run(["cmake", "--install", os.environ["TANDEM_BUILD"], "--component", "python", "--prefix", tmp_path],
                   check=True)
    subprocess.run([sys.executable, "-c", CHECK, tmp_path], check=True,
                   env={**os.environ, "PYTHONPATH": str(tmp_path / FOLDER), "PYTHONDONTWRITEBYTECODE": "1"})
    assert len([path for path in tmp_path.rglob("*") if path.is_file()]) == 7
