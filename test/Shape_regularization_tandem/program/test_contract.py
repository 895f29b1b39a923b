# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The contract of detect_planes: outputs, exit codes, and one line on standard error for whatever goes wrong."""

import os
import re

from support import (BARE, CLOUD, CUBE, HAS_VIEW, HELP, N, NO_POINTS, NOTHING, VERTICES, WARNS, XYZ, cube, off, ply,
                     table)

NUMBER = r"-?[0-9.]+(e-?[0-9]+)?"
TWO = "element vertex 2\n" + XYZ
ONE = "element vertex 1\n"


def prepare(p):
    p.write({"far.ply": ply(CLOUD, cube(4500000)), "bare.ply": ply(VERTICES, BARE), "a folder/cube.xyz": CUBE,
             "cube.PWN": CUBE, "bare.off": off(), "cube.doc": CUBE, "old.labels": "old"})
    p(0, "shapes +3 in 3 planes of 3 directions, 3 orthogonal", "cube.ply E --output 'a folder/out.ply' --vg out.vg "
      "--vg-by-plane --labels out.labels --planes out.planes --polygons out.obj --report out.json --backend sequential")


@table("path, expected", [
    ("parameters maximum_distance", 0.004), ("parameters minimum_region_size", None), ("counts points", N),
    ("counts shapes", 3), ("counts ignored", 0), ("counts assigned", None), ("counts directions", 3),
    ("counts planes", 3), ("counts rounds", None), ("criteria coverage", None), ("criteria mean_distance", None),
    ("criteria complexity", None), ("score fit", None), ("score total", None), ("seconds read", None),
    ("seconds normals", None), ("seconds sort", None), ("seconds neighbors", None), ("seconds growth", None),
    ("seconds regularity", None), ("seconds final", None), ("seconds total", None),
    ("memory process_peak_bytes", None), ("backend", None), ("device", "CPU"), ("hash", None),
    ("relations parallel_groups", None), ("relations coplanar_groups", None), ("free misfit", None),
    ("free total", None), ("uncertainty centroid 2 2", None), ("uncertainty normal_covariance 2 5", None),
    ("uncertainty noise", None), ("uncertainty angle_deg", None)])
def test_report(p, path, expected):
    value = p.json("out.json")
    for name in path.split():
        value = value[int(name) if name.isdigit() else name]
    assert expected is None or value == expected


def test_outputs(p):
    assert len(p.json("out.json")["relations"]["orthogonal_pairs"]) == 3
    assert set(p.sizes("out.labels")) <= {-1, 0, 1, 2} and p.path("out.labels").stat().st_size == 4 * N
    planes = p.lines("out.planes")
    assert len(planes) == 3 and all(re.fullmatch(f"{NUMBER} {NUMBER} {NUMBER} {NUMBER}", line) for line in planes)
    assert re.search(rf"binary_little_endian.*vertex {N}\n.*double x\n.*nx\n.*uchar red\n.*property int shape\nend_header",
                     p.read("a folder/out.ply"), re.DOTALL)


def test_outputs_for_other_programs(p):
    assert not p.lines("out.obj", f"^(?!(#.*|g shape_[0-2]|v {NUMBER} {NUMBER} {NUMBER}|f( [0-9]+)+)$)")
    assert p.lines("out.obj", "^g ") == ["g shape_0", "g shape_1", "g shape_2"]
    p(0, "shapes +3 in", "cube.ply E --vg shapes.vg --polygons out.PLY")
    for name in ("shapes.vg", "out.vg"):
        assert p.lines(name, "^group_label") == [f"group_label: shape_{i}" for i in range(3)]
    assert re.search("double x\n.*element face [1-9][0-9]*\n.*vertex_indices\n.*property int shape\nend_header",
                     p.read("out.PLY"), re.DOTALL)
    p(WARNS, "shapes +0 in", "cube.ply E --minimum-region-size 1700 --vg none.vg --polygons none.obj")
    assert p.lines("none.vg", "^num_groups") == ["num_groups: 0"]


@table("backend", ["sequential", "auto", "parallel"])
def test_an_output_is_a_cloud_again(p, backend):
    """It gives the same answer, whatever the back end."""
    has_tbb = os.environ.get("TANDEM_WITH_TBB", "1" if "sequential, parallel" in HELP else "0") == "1"
    if backend == "parallel" and not has_tbb:
        p(2, "--backend parallel needs oneTBB: this program was built without it", "cube.ply --backend parallel")
    else:
        p(0, p.json("out.json")["hash"], f"'a folder/out.ply' E --backend {backend} --threads 3")


def test_directions_like_options(p):
    found = p.hash("cube.ply E --fixed-direction 0,0,1 --symmetry-direction '1, 0, 0'")
    p(0, found, "cube.ply E --fixed-direction 0,0,1 --fixed-direction -1e-12,0,-2 --symmetry-direction=-1,0,0")


@table("pattern, arguments", [
    ("shapes +3 in", "far.ply E --output far_out.ply"),
    ("shapes +3 in", "far_out.ply E"),
    (NOTHING, "cube.ply E --quiet"),
    ("shapes +3 in", "cube.ply E --no-parallelism --no-orthogonality --no-coplanarity --angle-tolerance 0 --simplicity "
     "0.05 --regularity 0.2 --surfel-size 0.3 --k-neighbors 10 --cell-size 512 --maximum-angle 20 --maximum-offset "
     "0.002 --minimum-region-size 50"),
    ("normals given", "'a folder/cube.xyz' E"),
    ("normals given", "cube.PWN E"),
    ("shapes +3 in", "bare.off E --output bare_out.ply"),
    ("normals given", "bare_out.ply E"),
    ("normals estimated\n.*shapes +3 in", "--estimate-normals bare.ply E"),
    ("normals by PCA of 9 neighbors\n.*shapes +3 in", "--estimate-normals 9 bare.ply E"),
    ("normals estimated\n.*shapes +3 in", "cube.ply E --estimate-normals"),
    ("at least [0-9]+ points", "cube.ply"),
    ("usage: detect_planes INPUT.*--maximum-distance.*default.*--report", "--help")])
def test_runs(p, pattern, arguments):
    p(0, pattern, arguments)


@table("offer, arguments", [("--view FILE", "--view v.html"), ("--mesh FILE", "--mesh m.off"), (".laz", "--output l.laz"),
                            ("sequential, parallel", "--backend parallel")])
def test_help_offers_what_is_there(p, offer, arguments):
    if offer in HELP:
        p(1, "no such file", f"missing.ply {arguments}")
    else:
        p(2, "built without|build Tandem with", f"missing.ply {arguments}")


@table("name, content, pattern", [
    ("missing.ply", None, "missing.ply: no such file"),
    ("a folder", None, "a folder: is a directory"),
    ("empty.ply", "", "empty.ply: is empty"),
    ("text.ply", "Once upon a time\nthere was a cloud\n", "text.ply: is not a PLY file"),
    ("text.xyz", "Once upon a time\nthere was a cloud\n", "text.xyz: "),
    ("half.ply", ply(CLOUD, CUBE[:len(CUBE) // 2]),
     f"half.ply: (is truncated|unreadable after point [0-9]+ of {N})"),
    ("half.off", off(CUBE[:len(CUBE) // 2]), f"half.off: is truncated: {N} points announced, [0-9]+ rows found"),
    ("head.ply", "ply\nformat ascii 1.0\n" + VERTICES, "head.ply: the PLY header has no end"),
    ("none.ply", ply(NO_POINTS), "none.ply: has no points"),
    ("huge.ply", ply("element vertex 99999999999999\n" + XYZ, "0 0 0\n"), "huge.ply: is truncated"),
    ("words.ply", ply(TWO, "0 0 0\n0 zero 0\n"), "words.ply: unreadable after point 1 of 2"),
    ("flat.ply", ply(ONE + "property float x\nproperty float y\n", "0 0\n"), "flat.ply: .*no property 'z'"),
    ("type.ply", ply(ONE + XYZ + "property half q\n", "0 0 0 0\n"), "type.ply: unknown type 'half'"),
    ("nan.ply", ply("element vertex 60\n" + XYZ.replace("double", "float"), kind="binary_little_endian").encode()
     + 180 * b"\0\0\xc0\x7f", "nan.ply: none of its 60 points has finite")])
def test_unreadable_input(p, name, content, pattern):
    p.write({} if content is None else {name: content})
    p(1, pattern, [name, "--output", "never.ply"])
    assert not p.has("never.ply")


def test_truncated_output(p):
    p.write({"cut.ply": p.path("a folder/out.ply").read_bytes()[:20000]})
    p(1, "cut.ply: is truncated", "cut.ply --output never.ply")
    message = p(1, "cube.doc: unknown format", "cube.doc")
    for ending in (".laz", ".gz"):
        assert (ending in message) == (ending in HELP)


@table("pattern, arguments", [
    ("no/such.ply: cannot be written", "--output no/such.ply"),
    ("a folder: is a directory", "--planes 'a folder'"),
    ("no/such.vg: cannot be written", "--vg no/such.vg"),
    ("no/such.obj: cannot be written", "--polygons no/such.obj"),
    *(("/dev/full: cannot be written completely", f"--{option} /dev/full")
      for option in ("output", "labels", "planes", "report", "vg")),
    ("/dev/full", "--labels old.labels --planes never.planes --report /dev/full")])
def test_outputs_that_cannot_be_written(p, pattern, arguments):
    """Nothing is left that looks complete."""
    p(1, pattern, "cube.ply E " + arguments)
    assert p.read("old.labels") == "old" and not p.has("never.planes")


@table("pattern, command", [
    ("full.ply: cannot be written completely", "ln -s /dev/full full.ply; exec $P cube.ply $E --polygons full.ply"),
    ("standard output cannot be written .No space left on device.\n$", "exec $P cube.ply $E > /dev/full"),
    ("standard output cannot be written .Bad file descriptor", "exec $P --version >&-"),
    ("standard output cannot be written", "exec $P --help > /dev/full"),
    ("standard output cannot be written", "exec $P --version > /dev/full"),
    # A limit of the file size is a disk that runs full in the middle of a file.
    *(("never[^ ]*: cannot be written completely .File too large",
       f"trap '' XFSZ; ulimit -f 16; exec $P 'a folder/cube.xyz' $E --labels old.labels {output}")
      for output in ("--output never.ply", "--vg never.vg", "--output-directory never", "--view never.html")
      if HAS_VIEW or "view" not in output)])
def test_full_disks(p, pattern, command):
    p.shell(1, pattern, command)
    assert p.read("old.labels") == "old" and not p.has("never", "never.ply", "never.vg", "never.html")


def test_files_are_complete_without_standard_output(p):
    p.shell(1, "standard output cannot be written .No space[^\n]*; the files are complete",
            "exec $P cube.ply $E --planes full.planes --labels full.labels > /dev/full")
    p(0, NOTHING, "cube.ply E --quiet --planes same.planes --labels same.labels")
    assert p.is_same("full.planes", "same.planes") and p.is_same("full.labels", "same.labels")


@table("pattern, arguments", [
    ("no INPUT", ""),
    ("unrecognised option", "cube.ply --no-such-option"),
    ("unrecognised option", "cube.ply --max 3"),
    *((pattern, arguments.format(option)) for option in ("--help", "--version") for pattern, arguments in (
        ("unrecognised option '--no-such-option'", "{} --no-such-option"),
        ("unrecognised option '--no-such-option'", "--no-such-option {}"), ("--threads", "{} --threads"))),
    ("an option is not known.*--a%canonical_option%b", "cube.ply --a%canonical_option%b"),
    ("an option is not known.*'%value%'", "cube.ply --maximum-angle %value%"),
    ("maximum-distance", "cube.ply --maximum-distance far"),
    ("maximum-distance", "cube.ply --maximum-distance"),
    *((rf": --maximum-{name} is {value}, must be in [\[(].*[\])]", f"cube.ply --maximum-{name} {value}")
      for name, value in (("distance", 0), ("distance", -1), ("distance", "nan"), ("distance", "inf"), ("angle", 0),
                          ("angle", 0.005), ("angle", 90), ("offset", -1))),
    (": --angle-tolerance is 45, must be in .0, 45. degrees", "cube.ply --angle-tolerance 45"),
    *((f": --minimum-region-size is {value}, must be in .3, 2147483648. ", f"cube.ply --minimum-region-size {value}")
      for value in (-5, 0, 2, 2147483649, 9223372036854775807)),
    *((f": --k-neighbors is {value}, must be in .3, 64. ", f"missing.ply --k-neighbors={value}")
      for value in (-5, 2, 65, 2147483648)),
    *((f": --{name} is [^ ]*, must be in .0, {largest}. ", f"cube.ply --{name} {value}")
      for name, largest in (("simplicity", 1), ("regularity", 10), ("surfel-size", 0.55))
      for value in (-1, "nan", "inf", 1e9)),
    *((f": --cell-size is {value}, must be in .64, 65536. ", f"cube.ply --cell-size {value}") for value in (-1, 1)),
    *((f": --{name} is '{value}', must be three numbers .*, as in 0,0,1 ", f"cube.ply --{name} '{value}'")
      for name in ("fixed-direction", "symmetry-direction")
      for value in ("0,0", "a,b,c", "0,0,0", "0 0 1", "0,0,1,0", "0,0,1x", "0,0,1e999", "nan,0,1", ",0,1")),
    ("--fixed-direction is '0', must be three numbers", "cube.ply --fixed-direction 0 0 1"),
    ("--symmetry-direction is '0', must be three numbers", "cube.ply --symmetry-direction 0 0 1"),
    ("--fixed-direction is '', must be", "cube.ply --fixed-direction 0,0,1 --fixed-direction ''"),
    ("threads is 0", "cube.ply --threads 0"),
    ("threads is 0", "missing.ply --threads 0"),
    ("backend is 'gpu'", "cube.ply --backend gpu"),
    ("estimate-normals is 2", "cube.ply --estimate-normals 2"),
    ("named twice", "cube.ply --output ./cube.ply"),
    ("named twice", "cube.ply --output new.ply --labels 'a folder/../new.ply'"),
    ("named twice", "cube.ply --vg new.ply --polygons new.ply"),
    ("polygons is 'new.stl', must end in .geojson, .json, .ply, .obj or .off", "cube.ply --polygons new.stl"),
    ("polygons is 'new'", "missing.ply --polygons new"),
    ("vg-by-plane needs --vg", "cube.ply --vg-by-plane")])
def test_bad_usage(p, pattern, arguments):
    p(2, pattern, arguments)


def test_values_that_do_not_fit(p):
    p(1, ": --maximum-distance is 1e-09 while the extent", "cube.ply --maximum-distance 1e-9")
    if "cuda; all" in HELP:  # but no device
        p(1, "CUDA", "cube.ply --backend cuda", CUDA_VISIBLE_DEVICES="")
    else:
        p(2, "--backend cuda needs CUDA: this program was built without it", "cube.ply --backend cuda")


def test_interrupt(p):
    """When the points have been read there is a file of the output. On a very fast machine the run may be over before."""
    p.write({"big.xyz": "".join(f"{i % 1009} {i % 997} {i % 3}\n" for i in range(400000))})
    p.shell(1, "interrupted", """$P big.xyz --maximum-distance 0.5 --output never.ply & pid=$!
      while kill -0 $pid && ! ls *.part never.ply 2> errors | grep -q .; do sleep 0.05; done
      kill -INT $pid; wait $pid""")
    assert not p.has("never.ply")
