# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""detect_planes by several processes: they write the bytes of one, and leave no file that looks complete if one of them
fails or is killed. TANDEM_MPIEXEC starts them."""

import os
import re

import pytest
from clouds import OPTIONS, OUTPUTS, TILES, check_same_results, write_tiles
from support import CLOUD, CUBE, HELP, NOTHING, PROGRAM, WARNS, pcd, ply, properties, table, words_of

MPIEXEC = os.environ.get("TANDEM_MPIEXEC")
pytestmark = pytest.mark.skipif(not MPIEXEC or "mpirun" not in HELP, reason="the program was built without MPI")
ALL = " ".join(TILES)
# Open MPI asks who wants it as root, or with more processes than processors.
ENVIRONMENT = {**{f"OMPI_{name}": "1" for name in (
    "ALLOW_RUN_AS_ROOT", "ALLOW_RUN_AS_ROOT_CONFIRM", "MCA_rmaps_base_oversubscribe", "MCA_mpi_yield_when_idle")},
    "OMPI_MCA_hwloc_base_binding_policy": "none"}
CLASSES = ["class_corner.ply", "class_last.ply", "class_none.ply"]
ZEROS = ["zeros.xyz", "folder/Middle.XYZ", "last.xyz"]
SIGNALS = """rm -f rank* messages
"$MPIEXEC" -n 3 sh -c 'echo $$ > rank${OMPI_COMM_WORLD_RANK:-$PMI_RANK}
  exec "$P" slow0.xyz slow1.xyz slow2.xyz --quiet --maximum-distance .5 --output-directory never --planes never.planes' \\
  > messages 2>&1 &
started=$!
while [ $(find . -name '*.part*' | wc -l) -lt 1 ] && kill -0 $started; do sleep .01; done
kill -$1 $(cat rank$2)
code=0
wait $started || code=$?
cat messages >&2
exit $code
"""


def prepare(p):
    write_tiles(p)
    tiles = {name: p.read(name) for name in ("corner.pts", "last.xyz")}
    p.write({"class_none.ply": with_classes(""), "class_empty.ply": with_classes(""),
             "class_corner.ply": with_classes(tiles["corner.pts"]), "class_last.ply": with_classes(tiles["last.xyz"]),
             "given.ply": ply(CLOUD, CUBE),
             # Tiles of one shape are in several processes, which have viewpoints of their own.
             "corner.pcd": seen_from("4 1.5 2", tiles["corner.pts"]), "last.pcd": seen_from("4 -9 9", tiles["last.xyz"]),
             "zeros.xyz": tiles["corner.pts"] + 5 * "0 0 0\n", "signals.sh": SIGNALS,
             **{f"slow{t}.xyz": "".join(f"{t * 60 + i % 59} {i % 997} {i % 3}\n" for i in range(60000)) for t in range(3)}})
    p.path("taken/border.csv").mkdir(parents=True)


def with_classes(rows):
    return ply(f"element vertex {rows.count(chr(10))}\n" + properties("xyz", "float") + "property uchar classification\n",
               rows.replace("\n", " 6\n"))


def seen_from(place, rows):
    return pcd(rows, more=f"VIEWPOINT {place} 1 0 0 0\n", count=rows.count("\n"))


def ranks(p, n, code, pattern, arguments):
    check(code, pattern, p.run([MPIEXEC, "-n", str(n), PROGRAM, *words_of(arguments)], ENVIRONMENT))


def check(code, pattern, run):
    """What mpirun says of a failure comes with the one line of the program."""
    status, out, err = run
    assert status == code and re.search(pattern, out + err, re.DOTALL), f"{status}, no {pattern}: {out}{err}"
    lines = re.findall("detect_planes: (?!warning: )[^\n]+\n", err)
    assert code == 0 or len(lines) == 1, f"not one line of error: {err}"


def outputs(folder):
    return f"--output-directory {folder} --planes {folder}/planes --report {folder}/report"


@pytest.fixture(scope="module")
def written(p):
    """Outputs of one process, which have normals but for LAS"""
    p(0, "normals estimated.*hash", f"{ALL} {OPTIONS} {outputs('one_estimated')}")
    tiles = " ".join(f"one_estimated/{name}" for name in OUTPUTS[:-1])
    p(0, "normals given.*hash", f"{tiles} {OPTIONS} {outputs('one_given')}")
    return tiles


@table("n", [1, 2, 3, 6])
@table("normals", ["estimated", "given"])
def test_the_same_bytes(p, written, n, normals):
    tiles, names = (ALL, OUTPUTS) if normals == "estimated" else (written, OUTPUTS[:-1])
    processes = "1 thread," if n == 1 else f"{n} processes of 1 thread,"
    ranks(p, n, 0, f"normals {normals}.*execution +[a-z]+, {processes}.*hash",
          f"{tiles} {OPTIONS} --threads 1 {outputs(f'{n}_{normals}')}")
    check_same_results(p, f"one_{normals}", f"{n}_{normals}", names)


@table("pattern, inputs, names", [
    # Inputs that do not have the same; a part of the shapes
    ("left out +normals, colors, intensity, classification: not", "{} last.las", OUTPUTS),
    ("selection +[12] of [0-9]+ shapes.*hash", "{} --near-direction 0,0,1 --largest 2", OUTPUTS[:-1]),
    # A tile without points, of which a process has no other
    ("warning: class_none.ply: has no points", " ".join(CLASSES), CLASSES),
    # Walls and floors that are exactly so
    (" up +0 0 1, found.*hash", f"{ALL} --upright", OUTPUTS),
    # The sides of planes, by one viewpoint or that of each input
    ("normals estimated, towards the viewpoint\n.*hash", f"{ALL} --viewpoint 4,1.5,2 --oriented", OUTPUTS),
    ("normals estimated, towards the viewpoint\n.*hash", "corner.pcd folder/Middle.XYZ folder/sub/border.csv last.pcd",
     ["corner.pcd", "Middle.XYZ", "border.csv", "last.pcd"]),
    # Tolerances of points; those at 0 0 0 are in one tile.
    *(("; ignored: 5 at 0 0 0.*tolerances .* by (noise|auto-local)", f"{' '.join(ZEROS)} --ignore-zeros {option}",
       [name[name.find("/") + 1:] for name in ZEROS])
      for option in ("--noise '0.01 + 0.001*r' --viewpoint 4,1.5,2", "--maximum-distance auto-local"))])
def test_the_same_of_other_inputs(p, written, pattern, inputs, names):
    for n in (1, 3):
        ranks(p, n, 0, pattern, f"{inputs.format(written)} {'' if 'local' in inputs else OPTIONS} {outputs(f'some_{n}')}")
    check_same_results(p, "some_1", "some_3", names)


@table("n, code, pattern, arguments", [
    (2, 0, "execution +sequential, 2 processes of 1 thread", f"{ALL} {OPTIONS} --backend sequential"),
    (2, 0, NOTHING, f"{ALL} {OPTIONS} --quiet"), (2, 0, r"\Adetect_planes .Tandem. [0-9.]+\n\Z", "--version"),
    # One message, and no file
    (3, 1, "nothere.ply: no such file", f"{ALL} nothere.ply --output-directory none --planes none/planes"),
    (2, 2, "--threads is 0", f"{ALL} --threads 0 --output-directory none"),
    (2, 1, "none of the inputs has points", "class_none.ply class_empty.ply"),
    *((2, 2, f"--{option.split()[0]} needs all points in one process", f"{ALL} --{option}") for option in (
        "output out.ply", "labels out.ply", "vg out.ply", "polygons out.ply", "shapes out.csv", "mesh out.ply",
        "view out.html", "by-plane", "planes-from 1", "minimum-area 1", "minimum-extent 1",
        "minimum-width 1", "flat-only", "class wall")),
    *([] if os.environ.get("TANDEM_WITH_MPI_CUDA") == "1" else [
        (2, 2, "--backend is 'cuda', but in several processes", f"{ALL} --backend cuda")]),
    (2, 2, "--estimate-normals with a number needs all points", f"{ALL} --estimate-normals 12"),
    (3, 1, "taken/border.csv: is a directory", f"{ALL} --output-directory taken --planes taken/planes"),
    *3 * [(3, 1, "/dev/full: cannot be written completely .No space",  # the folders that they make, too
           f"{ALL} {OPTIONS} --output-directory made/one/two --planes /dev/full")]])
def test_messages(p, n, code, pattern, arguments):
    ranks(p, n, code, pattern, arguments)
    assert not p.has("none", "made", "out.ply", "out.html", "out.csv", "taken/corner.ply", "taken/planes")


def test_the_same_warnings(p):
    run = "corner.pts folder/Middle.XYZ last.las --maximum-distance 1 --quiet --report "
    p(WARNS, "", run + "warned")
    ranks(p, 3, 0, r"\Adetect_planes: warning: the maximum distance 1 is more than a tenth of the extent of the points, "
          r"7.9: [^\n]*\n\Z", run + "warned_3")
    assert p.json("warned")["warnings"] == p.json("warned_3")["warnings"] != []


@table("signal", ["KILL", "INT", "TERM"])
@table("rank", ["1", "2"])
def test_signals(p, signal, rank):
    """A rank that gets a signal, once all tiles were read"""
    run = p.run(["sh", "signals.sh", signal, rank], {**ENVIRONMENT, "MPIEXEC": MPIEXEC, "P": PROGRAM})
    if signal == "KILL":
        assert run[0] != 0 and run[2]
    else:
        check(1, "detect_planes: interrupted, nothing was written", run)
    assert not list(p.folder.glob("never*/*")) and not p.has("never.planes")
