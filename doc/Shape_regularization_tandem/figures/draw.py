#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Draws pictures of the manual again, and writes the tables of their numbers, into fig and tables beside this folder.
#
#   draw.py results         the building of CGAL's data, after rounds and with other parameters: one picture each, *.md
#   draw.py knobs           measures what simplicity and regularity change, in about ten minutes: knobs.csv; and draws
#   draw.py curves          of knobs.csv: *_curves.png
#   draw.py outlines        three facades, and the number of corners that outlines share
#   draw.py surfaces        the closed surfaces of a generated house and of the building
#   draw.py sensors         what the commands of the page of sensors find in its generated scenes
#   draw.py tasks           runs the first commands of each of the three task pages, and keeps what they print: *.out
#   draw.py check           runs these, draws nothing, and fails where they print other lines than were kept
#   draw.py building        the result of the demo beside its cloud
#   draw.py view            the page of the demo, by a Chromium without a window
#   draw.py view PAGE PICTURE [ADDRESS [WIDTH,HEIGHT]]
#                           another page of detect_planes --view; ADDRESS is what address.js reads after '#'.
#                           Exit code 77: there is no Chromium
#   TANDEM_BUILD_DIR  where to build (default: build/figures of this repository)
#   TANDEM_PROGRAMS   a build folder that has the programs already
#   TANDEM_DATA       folder of kinect_room.ply, for knobs

import collections
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FIGURES = pathlib.Path(__file__).resolve().parent
MANUAL, ROOT = FIGURES.parent, FIGURES.parents[2]
BUILD = pathlib.Path(os.environ.get("TANDEM_BUILD_DIR", ROOT / "build/figures"))
PARAMETERS = {"maximum-distance": .15, "maximum-angle": 25.842, "minimum-region-size": 100}  # of the building
CHOICES = {"maximum-distance": (.015, 1.5), "maximum-angle": (5, 75), "minimum-region-size": (10, 2000),
           "angle-tolerance": (.5, 40), "simplicity": (0, .3), "regularity": (0, 1)}  # too small and too large
COLUMNS = ["cloud", "parameter", "value", "shapes", "coverage_percent", "mean_distance_in_epsilons", "degrees_of_freedom",
           "f_of_faces", "kept_of_layers", "angle_error_deg", "false_parallels"]
WALLS = ("bends", "bows", "offsets", "half offsets", "low steps", "steps", "boards", "strips")  # groups of clouds
KNOBS = {"simplicity": "0 0.04 0.06 0.08 0.1 0.15 0.2 0.3 0.5 1", "regularity": "0 0.01 0.03 0.1 0.2 0.3 1 3 10"}


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def output_of(*command, **options):
    return run(*command, stdout=subprocess.PIPE, text=True, **options).stdout


def build(sources, folder, target, *options):
    if os.environ.get("TANDEM_SKIP_INSTALL") != "1":
        run(ROOT / "scripts/install_dependencies.sh")
        run(ROOT / "scripts/install_dependencies.sh", "gnuplot-nox", "python3-numpy")
    run("cmake", "-S", sources, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", *options, stdout=subprocess.DEVNULL)
    run("cmake", "--build", folder, "--target", target, "-j", os.environ.get("TANDEM_JOBS", "2"))


def program(name):
    folder = pathlib.Path(os.environ.get("TANDEM_PROGRAMS", BUILD / "programs"))
    if "TANDEM_PROGRAMS" not in os.environ:
        build(ROOT, folder, name, "-DTANDEM_BUILD_BENCHMARKS=ON", "-DTANDEM_BUILD_TESTS=OFF", "-DTANDEM_WITH_CUDA=OFF")
    parent = "examples" if name == "detect_planes" else "benchmark"
    return next(p for p in (folder / parent).rglob(name) if p.is_file() and os.access(p, os.X_OK))


def building():
    run(ROOT / "scripts/sample_cloud.sh", BUILD / "building.ply")
    return BUILD / "building.ply"


def picture(name):
    return MANUAL / f"fig/{name}.png"


def render(cloud, name, options):
    """Of the result of detect_planes --output; the options are assignments, see picture.gnuplot."""
    header = cloud.read_bytes().split(b"end_header\n")[0].decode() + "end_header\n"
    types, names = zip(*re.findall(r"^property (\w+) (\w+)", header, re.M))
    layout = "points = {}; bytes = {}; types = '{}'; ".format(
        re.search(r"element vertex (\d+)", header)[1], len(header),
        "".join("%int32" if t == "int" else "%" + t for t in types))
    columns = {"point": "x", "normal": "nx", "red": "red", "green": "green", "blue": "blue", "shape": "shape"}
    layout += "; ".join(f"{column} = {names.index(name) + 1}" for column, name in columns.items())
    run("gnuplot", "-c", FIGURES / "picture.gnuplot", cloud, picture(name), layout, options)


def detect_building(*outputs, **changed):
    options = [word for name, value in {**PARAMETERS, **changed}.items() for word in ("--" + name, value)]
    run(program("detect_planes"), building(), *options, "--quiet", *outputs)


def write_table(name, what, rows):
    head = f"| {what} | shapes | directions | planes | complexity | coverage |\n|:--|--:|--:|--:|--:|--:|\n"
    (MANUAL / f"tables/{name}.md").write_text(head + "".join(rows))


def results(work):
    import numpy as np
    import shape_colors

    def read(name):
        return np.fromfile(work / f"{name}.labels", "<i4"), np.loadtxt(work / f"{name}.planes", ndmin=2)[:, :3]

    def draw(name, shapes, ranks):
        shape_colors.write_colored(work / "colored.ply", points, *shapes, ranks)
        render(work / "colored.ply", name, "alone = 1; width = 330; height = 260")

    def draw_shapes(name, shapes, final):
        draw(name, shapes, shape_colors.ranks_like(final[0], shapes[0]))

    def draw_directions(name, shapes):
        rows = csv.DictReader(open(work / "shapes.csv"))
        draw(name, shapes, shape_colors.ranks_of_directions(shapes[0], np.array([int(r["parallel_group"]) for r in rows])))

    def detect(**changed):
        """What it finds, and its row of the table but for the name."""
        detect_building("--labels", work / "it.labels", "--planes", work / "it.planes", "--shapes", work / "shapes.csv",
                        "--report", work / "it.json", **changed)
        report = json.loads((work / "it.json").read_text())
        counts, criteria = report["counts"], report["criteria"]
        return read("it"), (f" | {counts['shapes']} | {counts['directions']} | {counts['planes']} | "
                            f"{criteria['complexity']:.2f} | {100 * criteria['coverage']:.1f} % |\n"), report["parameters"]

    # Shapes below the minimum size are not shown, so it is small here: young ones are of interest.
    build(FIGURES, BUILD / "results", "rounds")
    detect_building("--output", work / "cloud.xyz")
    points = np.loadtxt(work / "cloud.xyz")[:, :3]
    distance, angle, _ = PARAMETERS.values()
    write_table("rounds", "after", output_of(BUILD / "results/rounds", building(), distance, angle, 20, work))
    for name in ("round_1", "round_last"):
        draw_shapes(name, read(name), read("round_last"))

    right, right_row, parameters = detect()
    draw_shapes("right", right, right)
    draw_directions("right_directions", right)
    for option, values in CHOICES.items():
        name = option.replace("-", "_")
        rows = []
        for value, size in zip(values, ("small", "large")):
            shapes, row, _ = detect(**{option: value})
            rows.append(f"| {value:g}" + row)
            if option in ("angle-tolerance", "regularity"):
                draw_directions(f"{name}_{size}", shapes)
            else:
                draw_shapes(f"{name}_{size}", shapes, right)
        rows.insert(1, f"| {parameters[name]:g}" + right_row)
        write_table(name, f"`{name}`", rows)


def measure_cloud(work, cloud, name, knob, value):
    """A row of the table. Normals are estimated where the cloud has none."""
    rows = (line for line in open(ROOT / "benchmark/Shape_regularization_tandem/clouds.csv") if line[0] != "#")
    row = next(row for row in csv.DictReader(rows) if row["name"] == name)
    run(program("detect_planes"), cloud, "--maximum-distance", row["epsilon"], "--maximum-angle", row["alpha"],
        "--minimum-region-size", row["minimum"], f"--{knob}", value, "--quiet", "--report", work / "report.json")
    report = json.loads((work / "report.json").read_text())
    c = report["criteria"]
    return [name, knob, value, report["counts"]["shapes"], f"{100 * c['coverage']:.2f}",
            f"{c['mean_distance'] / report['parameters']['maximum_distance']:.4f}", c["degrees_of_freedom"]] + 4 * [""]


def measure_labels(work, knob, value):
    """A row of means over all labeled clouds, with given and with own normals."""
    run(program("tandem_benchmark"), "labels", f"--{knob}", value, "--output", work, stdout=subprocess.DEVNULL)
    rows = list(csv.DictReader(open(work / "labels.csv")))

    def mean(column, form, groups=None):
        values = [float(row[column]) for row in rows
                  if row[column] and (row["group"] in groups if groups else row["group"] not in WALLS)]
        return format(sum(values) / len(values), form)
    return ["labels", knob, value] + 4 * [""] + [mean("segmentation_f", ".4f"),
                                                 mean("mean_kept", ".4f", WALLS[-3:]),
                                                 mean("angle_error_deg", ".4f"), mean("parallel_false_relaxed", ".1f")]


def knobs(work):
    clouds = {"building": building(), "kinect": pathlib.Path(os.environ["TANDEM_DATA"]) / "kinect_room.ply"}
    rows = [COLUMNS]
    for knob, values in KNOBS.items():
        for value in values.split():
            rows += [measure_cloud(work, cloud, name, knob, value) for name, cloud in clouds.items()]
            rows.append(measure_labels(work, knob, value))
    with open(MANUAL / "tables/knobs.csv", "w") as file:
        csv.writer(file, lineterminator="\n").writerows(rows)
    curves(work)


def curves(_):
    for knob in KNOBS:
        run("gnuplot", "-c", FIGURES / "knobs.gnuplot", MANUAL / "tables/knobs.csv", knob, picture(knob + "_curves"))


def outlines(work):
    """Shapes of the result, which is the same everywhere; and how many corners the outlines share."""
    import numpy as np
    detect_building("--output", work / "cloud.xyz", "--polygons", work / "outlines.json")
    cloud = np.loadtxt(work / "cloud.xyz")
    shapes_at, plots = collections.defaultdict(set), []
    for shape, feature in enumerate(json.loads((work / "outlines.json").read_text())["features"]):
        rings = [np.array(ring) for polygon in feature["geometry"]["coordinates"] for ring in polygon]
        for corner in (tuple(corner) for ring in rings for corner in ring):
            shapes_at[corner].add(shape)
        if shape not in (2, 3, 5):
            continue
        normal = np.array(feature["properties"]["plane"][:3])
        across = np.cross((0, 0, 1), normal) / np.linalg.norm(normal[:2])
        flat = np.transpose([across, np.cross(normal, across)])
        np.savetxt(work / f"{shape}.points", cloud[cloud[:, -1] == shape, :3] @ flat)
        with open(work / f"{shape}.outline", "w") as file:
            for ring in rings:
                np.savetxt(file, ring @ flat, footer="\n", comments="")
        plots.append(f"plot '{work}/{shape}.points' with dots lc rgb '#999999', '{work}/{shape}.outline' with lines lw 2 "
                     "lc rgb '#0044aa'")
    print(sum(len(shapes) > 1 for shapes in shapes_at.values()), "corners are shared")
    run("gnuplot", "-e", f"set terminal pngcairo size 1080,360 font ',10'; set output '{picture('outlines')}'; "
        "set multiplot layout 1,3 margins .01,.99,.02,.98 spacing .02; unset key; unset tics; unset border; "
        "set size ratio -1; " + "; ".join(plots))


def draw_surfaces(name, *surfaces):
    import surfaces as drawing  # which needs numpy
    drawing.draw(picture(name), *surfaces)


def surfaces(work):
    run(program("make_scene"), "house", work / "house.ply", "--points", 200000, "--noise", ".0004", "--normals", "exact")
    for cloud, distance in (work / "house.ply", ".03"), (building(), ".15"):
        run(program("detect_planes"), cloud, "--maximum-distance", distance, "--maximum-angle", 25,
            "--minimum-region-size", 100, "--quiet", "--mesh", work / (cloud.stem + ".off"))
    draw_surfaces("surfaces", (work / "house.off", 220, 30), (work / "building.off", 220, 30))


def sensors(work):
    """The commands of the page run on the scenes of their names."""
    build(FIGURES, BUILD / "results", "sensor_scenes")
    run(BUILD / "results/sensor_scenes", work)
    here = {"cwd": work, "env": {**os.environ, "PATH": f"{program('detect_planes').parent}:{os.environ['PATH']}"}}
    views = {"lidar": "azimuth = 250; inside = 1; size = 0.1", "profiles": "azimuth = 250; elevation = 50; size = 0.1",
             "depth": "azimuth = 220; elevation = 30", "terrestrial": "elevation = 50; inside = 1",
             "aerial": "azimuth = 250; elevation = 45", "images": "azimuth = 250"}
    page = (MANUAL / "Sensors.txt").read_text()
    for name, command in re.findall(r"^(?=detect_planes (\w+)\.ply)(.*?)\n\\endverbatim", page, re.M | re.S):
        print(output_of("sh", "-euc", f"{command} --output sensor_{name}.ply", **here))
        render(work / f"sensor_{name}.ply", f"sensor_{name}", f"alone = 1; width = 460; height = 330; {views[name]}")


def differences(work, name, printed, keeps):
    """What was printed is kept, or compared with what was kept."""
    kept = MANUAL / f"tables/{name}.out"
    lines = re.sub(r"^(Installing |  seconds |  execution |  hash ).*\n", "", printed, flags=re.M)
    (kept if keeps else work / kept.name).write_text(lines)
    return 0 if keeps else subprocess.run(["diff", kept, work / kept.name]).returncode


def tasks(work, keeps=True):
    (work / "detect_planes").symlink_to(program("detect_planes"))
    (work / "scripts").symlink_to(ROOT / "scripts")
    here = {"cwd": work, "env": {**os.environ, "PATH": f"{work}:{os.environ['PATH']}"}}
    failures = 0
    for name, *surfaces in (("roofs", ("roofs.off", 250, 60), ("city.off", 250, 35)),
                            ("rooms", ("rooms.off", 250, 60), ("walls.off", 250, 60)),
                            ("facade", ("facade.off", 220, 30), ("model.off", 220, 30))):
        page = (MANUAL / f"{name.capitalize()}.txt").read_text()
        commands = re.search(r"\\verbatim\n(.*?)\\endverbatim", page, re.S)[1]
        failures += differences(work, name, output_of("sh", "-euc", commands, **here), keeps)
        code = re.search(r"\\code\{.py\}\n(.*?)\\endcode", page, re.S)
        if code and not re.search("import .*tandem", code[1]):  # it needs no module
            failures += differences(work, name + "_code", output_of("python3", "-c", code[1], **here), keeps)
        if keeps:
            draw_surfaces(name, *((work / file, *angles) for file, *angles in surfaces))
    if failures:
        sys.exit("draw.py: the task pages have other figures than their commands print")


def check(work):
    tasks(work, False)


def demo():
    run(ROOT / "scripts/demo.sh")
    return pathlib.Path(os.environ.get("TANDEM_BUILD_DIR", ROOT / "build/demo")) / "result"


def building_picture(_):
    render(demo() / "building_shapes.ply", "building", "width = 720; height = 560")


def view(work, page=None, to=None, address="", size="1280,800"):
    if page is None:
        page, to, size = demo() / "building.html", picture("view"), "760,480"
        address = "color=plane&direction=5&theme=light&layers=outlines,surface"
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if browser is None:
        sys.exit(77)
    sandbox = [] if os.getuid() else ["--no-sandbox"]  # it refuses to run as root with one
    run(browser, "--headless=new", *sandbox, f"--user-data-dir={work}", "--no-first-run", "--disable-extensions",
        "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars", f"--window-size={size}",
        "--virtual-time-budget=20000", f"--screenshot={to}", f"{pathlib.Path(page).resolve().as_uri()}#{address}")


PICTURES = {"building": building_picture, **{f.__name__: f for f in (
    results, knobs, curves, outlines, surfaces, sensors, tasks, check, view)}}

if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1] not in PICTURES:
        sys.exit("draw.py: its head says what it draws")
    with tempfile.TemporaryDirectory() as folder:
        PICTURES[sys.argv[1]](pathlib.Path(folder), *sys.argv[2:])
