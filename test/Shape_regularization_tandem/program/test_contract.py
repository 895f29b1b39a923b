# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The contract of detect_planes: outputs, exit codes, and one line on standard error for whatever goes wrong."""

import pathlib
import re

import numpy as np
from support import (BARE, CLOUD, CUBE, HAS_VIEW, HELP, N, NO_POINTS, NOTHING, VERTICES, WARNS, XYZ, binary_ply, cases,
                     cube, off, ply, properties, refused_files, table)

NUMBER = r"-?[0-9.]+(e-?[0-9]+)?"
ONE = "element vertex 1\n"
NEVER = "--output never.ply"
PROSE = "Once upon a time\nthere was a cloud\n"


def prepare(p):
    p.write({"far.ply": ply(CLOUD, cube(4500000)), "bare.ply": ply(VERTICES, BARE), "a folder/cube.xyz": CUBE,
             "cube.PWN": CUBE, "bare.off": off(), "old.labels": "old"})
    p(0, "shapes +3 in 3 planes of 3 directions, 3 orthogonal", "cube.ply E --output 'a folder/out.ply' --vg out.vg "
      "--vg-by-plane --labels out.labels --planes out.planes --polygons out.obj --report out.json --backend sequential")


REPORT = {"parameters": "maximum_distance minimum_region_size",
          "counts": "points shapes ignored assigned directions planes rounds",
          "criteria": "coverage mean_distance complexity", "score": "fit total",
          "seconds": "read normals sort neighbors growth regularity final total", "memory": "process_peak_bytes",
          "relations": "parallel_groups coplanar_groups orthogonal_pairs", "free": "misfit total",
          "uncertainty": "centroid normal_covariance noise angle_deg"}


def test_report(p):
    report = p.json("out.json")
    for part, names in REPORT.items():
        assert set(names.split()) <= set(report[part])
    expected = {"points": N, "shapes": 3, "ignored": 0, "directions": 3, "planes": 3}
    assert {name: report["counts"][name] for name in expected} == expected and report["device"] == "CPU"
    assert report["backend"] and report["hash"] and report["parameters"]["maximum_distance"] == 0.004
    assert len(report["relations"]["orthogonal_pairs"]) == 3
    assert [np.shape(report["uncertainty"][name]) for name in ("centroid", "normal_covariance")] == [(3, 3), (3, 6)]


def test_outputs(p):
    assert set(p.sizes("out.labels")) <= {-1, 0, 1, 2} and p.path("out.labels").stat().st_size == 4 * N
    planes = p.lines("out.planes")
    assert len(planes) == 3 and all(re.fullmatch(f"{NUMBER} {NUMBER} {NUMBER} {NUMBER}", line) for line in planes)
    assert re.search(rf"format ascii.*vertex {N}\n.*double x\n.*nx\n.*uchar red\n.*property int shape\nend_header",
                     p.read("a folder/out.ply"), re.DOTALL)
    assert not p.lines("out.obj", f"^(?!(#.*|g shape_[0-2]|v {NUMBER} {NUMBER} {NUMBER}|f( [0-9]+)+)$)")
    assert p.lines("out.obj", "^g ") == ["g shape_0", "g shape_1", "g shape_2"]
    assert p.lines("out.vg", "^group_label") == [f"group_label: shape_{i}" for i in range(3)]
    p(WARNS, "shapes +0 in", "cube.ply E --minimum-region-size 1700 --vg none.vg --polygons none.obj")
    assert p.lines("none.vg", "^num_groups") == ["num_groups: 0"]


@table("backend", ["sequential", "auto"] + ["parallel"] * ("sequential, parallel" in HELP))
def test_an_output_is_a_cloud_again(p, backend):
    """It gives the same answer, whatever the back end."""
    p(0, p.json("out.json")["hash"], f"'a folder/out.ply' E --backend {backend} --threads 3")


def test_directions_like_options(p):
    found = p.hash("cube.ply E --fixed-direction 0,0,1 --symmetry-direction '1, 0, 0'")
    p(0, found, "cube.ply E --fixed-direction 0,0,1 --fixed-direction -1e-12,0,-2 --symmetry-direction=-1,0,0")


test_runs = cases([
    ("shapes +3 in", "far.ply E --output far_out.ply"), ("shapes +3 in", "far_out.ply E"), (NOTHING, "cube.ply E --quiet"),
    ("shapes +3 in", "cube.ply E --no-parallelism --no-orthogonality --no-coplanarity --angle-tolerance 0 --simplicity "
     "0.05 --regularity 0.2 --surfel-size 0.3 --k-neighbors 10 --cell-size 512 --maximum-angle 20 --maximum-offset "
     "0.002 --minimum-region-size 50"),
    ("normals given", "'a folder/cube.xyz' E"), ("normals given", "cube.PWN E"),
    ("shapes +3 in", "bare.off E --output bare_out.ply"), ("normals given", "bare_out.ply E"),
    ("normals estimated\n.*shapes +3 in", "--estimate-normals bare.ply E"),
    ("normals by PCA of 9 neighbors\n.*shapes +3 in", "--estimate-normals 9 bare.ply E"),
    ("normals estimated\n.*shapes +3 in", "cube.ply E --estimate-normals"), ("at least [0-9]+ points", "cube.ply"),
    ("usage: detect_planes INPUT.*--maximum-distance.*default.*--report", "--help all"),
    ("files +o.ply, o.txt, one for each input in a folder\n", "cube.ply E -o o.ply --planes o.txt "
     "--output-directory 'a folder'"),
    ("free +66.7 %: 66.7 % in shapes that were not selected\n +in shapes that were not selected: the options of the "
     "selection leave them out\n", "cube.ply E --largest 1")], 0)


def test_help_fits_a_screen(p):
    """Its options are some of those of --help all."""
    text = p(0, "^usage: .*--help all", "-h")
    lines = text.splitlines()
    names = re.findall("--[a-z-]+ ", text)
    assert len(lines) <= 24 and max(map(len, lines)) <= 100 and len(names) > 10
    assert all(name in HELP for name in names) and p(0, "usage", "--help") == text


def test_help_of_the_manual(p):
    """Lines that are not there in every build aside, the manual has the help of this program."""
    kept = pathlib.Path(__file__).parents[3] / "doc/Shape_regularization_tandem/tables/help.out"
    optional = re.compile("mpirun|machines|[.]laz|cuda|LASzip")
    text, lines = p(0, "usage", "--help all"), kept.read_text().splitlines()
    assert not [line for line in text.splitlines() if line not in lines and not optional.search(line)], \
        f"detect_planes --help all > {kept}"


@table("offer, arguments", [("--view FILE", "--view v.html"), ("--mesh FILE", "--mesh m.off"), (".laz", "--output l.laz"),
                            ("sequential, parallel", "--backend parallel")])
def test_help_offers_what_is_there(p, offer, arguments):
    if offer in HELP:
        p(1, "no such file", f"missing.ply {arguments}")
    else:
        p(2, "built without|build Tandem with", f"missing.ply {arguments}")


test_unreadable_input = refused_files([
    ("missing.ply", None, "no such file"), ("a folder", None, "is a directory"),
    ("empty.ply", "", "is empty"), ("text.ply", PROSE, "is not a PLY file"), ("text.xyz", PROSE, ""),
    ("half.ply", ply(CLOUD, CUBE[:len(CUBE) // 2]), f"(is truncated|unreadable after point [0-9]+ of {N})"),
    ("head.ply", "ply\nformat ascii 1.0\n" + VERTICES, "the PLY header has no end"),
    ("none.ply", ply(NO_POINTS), "has no points"),
    ("huge.ply", ply("element vertex 99999999999999\n" + XYZ, "0 0 0\n"), "is truncated"),
    ("type.ply", ply(ONE + XYZ + "property half q\n", "0 0 0 0\n"), "unknown type 'half'"),
    ("nan.ply", binary_ply("element vertex 60\n" + properties("xyz", "float"), 180 * b"\0\0\xc0\x7f"),
     "none of its 60 points has finite")], NEVER, absent=["never.ply"])


@table("pattern, arguments", [
    ("no/such.obj: cannot be written", "--polygons no/such.obj"), ("a folder: is a directory", "--planes 'a folder'"),
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


test_bad_usage = cases([
    ("no INPUT", ""), ("--max': did you mean --maximum-distance, --maximum-angle or --maximum-offset.", "cube.ply --max 3"),
    *((f"option '{name}[^']*': did you mean {meant}[?] ", f"cube.ply {name}") for name, meant in (
        ("--epsilon=3", "--maximum-distance"), ("--min_points", "--minimum-region-size"),
        ("--normal-threshold", "--maximum-angle"), ("--max-dist", "--maximum-distance"), ("--lables", "--labels"),
        ("--max-distance=3", "--maximum-distance"), ("--gpu", "--backend"),
        ("--angle", "--maximum-angle or --angle-tolerance"), ("-labels", "--label-property or --labels"))),
    *((f"option '{name}' .detect_planes --help", f"cube.ply {name}") for name in ("--xyz", "-x", "---")),
    *((f"{name}.*with a decimal point", f"cube.ply {name} 0,3") for name in (
        "--maximum-distance", "--maximum-angle", "--threads")),
    *((pattern, arguments.format(option)) for option in ("--help", "--version") for pattern, arguments in (
        ("unrecognised option '--no-such-option'", "{} --no-such-option"),
        ("unrecognised option '--no-such-option'", "--no-such-option {}"), ("--threads", "{} --threads"))),
    ("an option is not known.*--a%canonical_option%b", "cube.ply --a%canonical_option%b"),
    ("maximum-distance", "cube.ply --maximum-distance far"), ("maximum-distance", "cube.ply --maximum-distance"),
    *((rf": --{name} is {re.escape(str(value))}, allowed is {limits}", f"missing.ply --{name}={value}")
      for name, limits, values in (
          ("maximum-distance", "a length .*1e270", (0, -1, "nan", "inf")), ("maximum-angle", r"[\[(].*[\])]", (0, 0.005, 90)),
          ("maximum-offset", "a length .*1e270", (-1,)), ("angle-tolerance", ".0, 45. degrees", (45,)),
          ("minimum-region-size", ".3, 2147483648. ", (-5, 0, 2, 2147483649, 9223372036854775807)),
          ("k-neighbors", ".3, 64. ", (-5, 2, 65, 2147483648)), ("simplicity", ".0, 1. ", (-1, "nan", "inf")),
          ("regularity", ".0, 10. ", (-1, "nan")), ("surfel-size", ".0, 0.55. ", (-1, "nan", 0.56)),
          ("cell-size", ".64, 65536. ", (-1, 1)), ("threads", "", (0,)), ("estimate-normals", ".3, 1000.", (0, 2)))
          for value in values),
    *((f": --fixed-direction is '{value}', must be three numbers .*, as in 0,0,1 ", f"cube.ply --fixed-direction '{value}'")
      for value in ("0,0", "a,b,c", "0,0,0", "0 0 1", "0,0,1,0", "0,0,1x", "0,0,1e999", "nan,0,1", ",0,1")),
    ("--symmetry-direction is '0', must be three numbers", "cube.ply --symmetry-direction 0 0 1"),
    ("backend is 'gpu'", "cube.ply --backend gpu"), ("named twice", "cube.ply --output ./cube.ply"),
    ("named twice", "cube.ply --output new.ply --labels 'a folder/../new.ply'"),
    ("polygons is 'new'", "missing.ply --polygons new"),
    ("polygons is 'new.stl', must end in .geojson, .json, .ply, .obj or .off", "cube.ply --polygons new.stl"),
    ("vg-by-plane needs --vg", "cube.ply --vg-by-plane")], 2)


def test_values_that_do_not_fit(p):
    p(1, ": --maximum-distance is 1e-09, allowed is at least .*: the extent of the points", "cube.ply --maximum-distance 1e-9")
    if "cuda; all" in HELP:  # but no device
        p(1, "CUDA", "cube.ply --backend cuda", CUDA_VISIBLE_DEVICES="")
    else:
        p(2, "--backend cuda needs CUDA: this program was built without it", "cube.ply --backend cuda")
