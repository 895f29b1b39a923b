#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the tables of cuda.md and mpi.md in one run on this machine, and prints them.

figures.py device|host|mpi PROGRAMS [--clouds FOLDER] [--against PROGRAMS] [--rounds N] [--row ARGUMENTS]...
  PROGRAMS   the folder with cuda_benchmark (device, host) or mpi_benchmark (mpi)
  --clouds   the folder of building.ply, kinect_normals.ply, ...: see cuda.md; clouds that it lacks are left out
  --against  the same program of another version; the two take turns. Adds the ratio of their wall times
  --rounds   processes for each row, of which the median counts (default: 3)
  --row      measures these rows instead, such as "cuda 3 1e9", which takes minutes
"""

import argparse
import pathlib
import statistics
import subprocess

STAGES = "wall sort neighbors growth regularity final".split()
ROWS = {
    "device": ["cuda 9 1e6", "cuda 13 5.2e6", "cuda 9 2e7", "cuda 5 1e8", "cuda 15 building.ply 0.15 100",
               "cuda 15 kinect_normals.ply 0.03 200", "cuda 9 sheridan_normals.ply 0.03 500",
               "cuda 9 kinect_room.ply 0.03 200", "cuda 9 sheridan_tls.ply 0.03 500"],
    "host": [f"{kind} 3 {cloud}" for kind in ("parallel", "sequential") for cloud in
             ("5.2e6", "sheridan_normals.ply 0.03 500", "kinect_normals.ply 0.03 200", "building.ply 0.15 100")],
    "mpi": ["1 sequential strong 1e7 1"] + [f"{n} mpi strong 1e7 2" for n in (2, 4, 8, 16)] +
           ["1 parallel strong 1e7 3", "1 sequential tiles 1e6 2"] + [f"{n} mpi tiles 1e6 2" for n in (2, 4, 8, 16)],
}


def measure(kind, folder, clouds, row):
    """The medians of the runs of one process but the first, by column, and the hash. None without the cloud."""
    arguments = row.split()
    if kind == "mpi":
        ranks, *arguments = arguments
        command = [f"{folder}/mpi_benchmark", *arguments]
        if ranks != "1":
            command = ["mpirun", "-n", ranks, "--bind-to", "core", *command]
    else:
        cloud = clouds / arguments[2]
        if arguments[2].endswith(".ply") and not cloud.exists():
            return None
        arguments[2] = str(cloud) if cloud.exists() else arguments[2]
        command = [f"{folder}/cuda_benchmark", *arguments]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    lines = [line.split(",") for line in text.splitlines() if line and not line.startswith("#")]
    head, runs = lines[0], lines[2:] or lines[1:]
    columns = {name.split(" ")[0]: place for place, name in reversed(list(enumerate(head)))}
    numbers = [statistics.median(float(run[columns[stage]]) for run in runs) for stage in STAGES + ["bytes"]]
    return numbers, runs[0][columns["hash"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=ROWS)
    parser.add_argument("programs")
    parser.add_argument("--clouds", type=pathlib.Path, default=pathlib.Path("."))
    parser.add_argument("--against")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--row", action="append")
    options = parser.parse_args()
    folders = [options.programs] + ([options.against] if options.against else [])
    print("| arguments | " + " | ".join(STAGES) + " | bytes a point |" + (" ratio |" if options.against else ""))
    print("|:--|" + "--:|" * (len(STAGES) + len(folders)))
    for row in options.row or ROWS[options.kind]:
        found = [[] for _ in folders]
        for _ in range(options.rounds):
            for results, folder in zip(found, folders):
                results.append(measure(options.kind, folder, options.clouds, row))
        if found[0][0] is None:
            continue
        medians = [[statistics.median(column) for column in zip(*(numbers for numbers, _ in results))]
                   for results in found]
        ratio = [f"{medians[0][0] / medians[1][0]:.2f}"] if options.against else []
        print("| `" + row + "` | " + " | ".join([f"{number:.3g}" for number in medians[0]] + ratio) + " |", flush=True)
        if len({result for _, result in found[0]}) > 1:
            raise SystemExit(f"{row}: results differ between runs")


if __name__ == "__main__":
    main()
