# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of detect_planes share: runs of the program and their checks, a cloud, and the writers of its formats.

A case is a line of a table: exit code, pattern of the output, arguments; E among these is a tolerance that fits the cube.
"""

import json
import os
import re
import shlex
import subprocess
from pathlib import Path

import numpy as np
import pytest

SOURCES = Path(__file__).resolve().parents[3]
PROGRAM = os.environ.get("TANDEM_PROGRAM", "")
HELP = subprocess.run([PROGRAM, "--help", "all"], stdout=subprocess.PIPE, text=True, check=True).stdout if PROGRAM else ""
HAS_VIEW = "--view FILE" in HELP
HAS_GZIP = ".gz" in HELP
WARNS = "0 with warnings"
NOTHING = r"\A\Z"
EPSILON = 0.004

# Three faces of a cube, 24 x 24 points each, that share no edge: coordinates and normals.
N = 1728


def cube(shift=0):
    steps = [f"{7 * i:03}" for i in range(1, 25)]
    return "".join(f"{shift}.{a} 0.{b} 0 0 0 1\n{shift}.{a} 0 0.{b} 0 1 0\n{shift} 0.{a} 0.{b} 1 0 0\n"
                   for a in steps for b in steps)


CUBE = cube()
ROWS = np.array([line.split() for line in CUBE.splitlines()], float)


def with_columns(text="", rows=CUBE):
    """The rows without their normals, and with a text behind each."""
    return re.sub(r" [01] [01] [01]\n", text + "\n", rows)


BARE = with_columns()


def properties(names, kind="double"):
    return "".join(f"property {kind} {name}\n" for name in names)


XYZ, NORMALS = properties("xyz"), properties(["nx", "ny", "nz"])
VERTICES = f"element vertex {N}\n" + XYZ
CLOUD = VERTICES + NORMALS
NO_POINTS = "element vertex 0\n" + XYZ


def ply(header, rows="", kind="ascii"):
    return f"ply\nformat {kind} 1.0\n{header}end_header\n{rows}"


def binary_ply(header, data, order="little"):
    return ply(header, kind=f"binary_{order}_endian").encode() + data


def off(rows=BARE, counts=f"{N} 0 0"):
    return f"OFF\n{counts}\n{rows}"


def pcd(rows=BARE, fields="x y z", more="", count=N, size=8, kind="ascii"):
    words = len(fields.split())
    return (f"FIELDS {fields}\n{more}SIZE{f' {size}' * words}\nTYPE{' F' * words}\nPOINTS {count}\nDATA {kind}\n"
            f"{rows}")


def text_of(rows, separator=" "):
    return "".join(separator.join(f"{x:.17g}" for x in row) + "\n" for row in rows)


def table(names, rows):
    """Parametrizes a test by the lines of a table."""
    return pytest.mark.parametrize(names, rows)


def cases(rows, *code, absent=()):
    """A test of rows: the exit code, if it is not that of all, the pattern and the arguments. Some files do not appear."""
    @pytest.mark.parametrize("row", rows)
    def test(p, row):
        p(*code, *row)
        assert not p.has(*absent)
    return test


def refused_files(rows, arguments="", absent=()):
    """A test of rows: the name of a file, its content, unless it is there, what is said of it, and maybe more arguments."""
    @pytest.mark.parametrize("row", rows)
    def test(p, row):
        name, content, pattern, *more = row
        p.write({} if content is None else {name: content})
        p(1, f"{re.escape(name)}: {pattern}", [name, *shlex.split(" ".join([arguments, *more]))])
        assert not p.has(*absent)
    return test


def words_of(arguments):
    words = shlex.split(arguments) if isinstance(arguments, str) else arguments
    tolerance = ["--maximum-distance", str(EPSILON)]
    return [word for given in words for word in (tolerance if given == "E" else [given])]


class Program:
    """Runs of the program in a folder, whose path has a blank."""

    def __init__(self, folder):
        self.folder = folder

    def path(self, name):
        return self.folder / name

    def write(self, files):
        for name, content in files.items():
            self.path(name).parent.mkdir(parents=True, exist_ok=True)
            self.path(name).write_bytes(content if isinstance(content, bytes) else content.encode())

    def read(self, name):
        return self.path(name).read_bytes().decode(errors="surrogateescape")

    def json(self, name):
        return json.loads(self.read(name))

    def lines(self, name, pattern=""):
        return [line for line in self.read(name).splitlines() if re.search(pattern, line)]

    def labels(self, name):
        return np.fromfile(self.path(name), "<i4")

    def sizes(self, name):
        """The numbers of points by their labels."""
        return dict(zip(*(a.tolist() for a in np.unique(self.labels(name), return_counts=True))))

    def planes(self, name):
        return np.loadtxt(self.path(name), ndmin=2)

    def csv(self, name):
        """The columns of a table with a line of names."""
        return np.genfromtxt(self.path(name), delimiter=",", names=True, ndmin=1, dtype=None, encoding="utf-8")

    def is_same(self, *names):
        return len({self.path(name).read_bytes() for name in names}) == 1

    def has(self, *names):
        return any(os.path.lexists(self.path(name)) for name in names)

    def run(self, command, environment):
        run = subprocess.run(command, cwd=self.folder, env={**os.environ, **environment}, timeout=250,
                             stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        out, err = (stream.decode(errors="surrogateescape") for stream in (run.stdout, run.stderr))
        return run.returncode, out, err

    def __call__(self, code, pattern, arguments, **environment):
        """The exit code, and what the output matches; of an error one line, and of a success none but warnings."""
        return self.check(code, pattern, [PROGRAM, *words_of(arguments)], environment)

    def shell(self, code, pattern, command, **environment):
        """The same by sh, where $P is the program and $E the tolerance."""
        environment.update(P=PROGRAM, E=f"--maximum-distance {EPSILON}")
        return self.check(code, pattern, ["sh", "-c", command], environment)

    def check(self, code, pattern, command, environment):
        status, out, err = self.run(command, environment)
        what = f"{command[1:]}\nexit code {status}: {out}{err}"
        assert status == (0 if code is WARNS else code), what
        assert re.search(pattern, out + err, re.DOTALL), f"{what}\nno {pattern}"
        line = {0: "", WARNS: r"(detect_planes: warning: [^\n]+\n)+"}.get(code, r"detect_planes: [^\n]+\n")
        assert re.fullmatch(line, err), f"{what}\nother lines of errors"
        assert not re.search(r"cannot be (written|made)(?!( completely)? \([A-Z])", err), f"{what}\nno reason"
        return out + err

    def hash(self, arguments, pattern=""):
        return re.search("hash +[0-9a-f]+", self(0, pattern, arguments)).group()

    def warns(self, arguments, *patterns):
        """Each pattern matches a warning, and there are no others, also with --quiet, and in the report."""
        text = self(WARNS if patterns else 0, "", f"{arguments} --quiet --report w.json")
        report = self.read("w.json")
        assert len(json.loads(report)["warnings"]) == len(text.splitlines()) == len(patterns), text
        for pattern in patterns:
            assert re.search(pattern, text) and re.search(pattern, report), f"no {pattern} in {text}{report}"
