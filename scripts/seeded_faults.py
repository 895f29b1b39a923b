#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says which tests notice each of the faults of test/Shape_regularization_tandem/seeded_faults.txt.

All faults are compiled at once into a copy of the sources, and the variable TANDEM_FAULT chooses one when a program
runs. First, all tests have to pass without any. Tests that build packages or need a browser are left out.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LIST = "test/Shape_regularization_tandem/seeded_faults.txt"
JOBS = os.environ.get("TANDEM_JOBS", str(os.cpu_count()))
LONGEST = 300  # seconds of a test: one that hangs has noticed
HEADER = """#pragma once
#include <cstdlib>
namespace seeded_faults {
inline const int chosen = std::getenv("TANDEM_FAULT") != nullptr ? std::atoi(std::getenv("TANDEM_FAULT")) : 0;
}
#define CGAL_TANDEM_FAULT(n) (seeded_faults::chosen == (n))
"""


def read_faults(path):
    faults = []
    for block in re.split(r"\n\n+", path.read_text().strip()):
        lines = [line for line in block.splitlines() if not line.startswith("#")]
        if not lines:
            continue
        number, house, file, rest = (part.strip() for part in lines[0].split(" | ", 3))
        hint, what = rest.rsplit(" | ", 1)
        old, new = (" ".join(line[2:] for line in lines[1:] if line[0] == sign) for sign in "-+")
        new = re.sub(r"\bFAULT\b", f"CGAL_TANDEM_FAULT({number})", new)
        faults.append({"number": int(number), "house": house, "file": file, "hint": hint.strip(), "what": what,
                       "old": r"\s+".join(map(re.escape, old.split())), "new": new})
    return faults


def with_faults(sources, faults):
    """The sources, by path, with all faults: each in its file, or where else its text is."""
    changed, errors = dict(sources), []
    for fault in faults:
        def places(paths):
            return [(path, m.span()) for path in paths for m in re.finditer(fault["old"], changed[path])]
        found = places([path for path in sources if path.name == fault["file"]])
        found = found if len(found) == 1 else places(sources)
        if len(found) != 1:
            errors.append(f"fault {fault['number']} of {fault['file']}: its text is there {len(found)} times")
            continue
        path, (first, last) = found[0]
        changed[path] = changed[path][:first] + fault["new"] + changed[path][last:]
    if errors:
        sys.exit("seeded_faults: " + "\n".join(errors))
    return changed


def make_copy(folder, faults):
    """The tracked files with the faults; those that stay as they are keep their time, for the next build."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
    paths = [pathlib.Path(os.fsdecode(n)) for n in names.split(b"\0") if n and (ROOT / os.fsdecode(n)).is_file()]
    sources = {path: (ROOT / path).read_text() for path in paths
               if path.parts[0] in ("include", "examples") and path.suffix in (".h", ".cpp")}
    changed = with_faults(sources, faults)
    contents = {folder / path: (ROOT / path).read_bytes() for path in paths}
    for path, text in changed.items():
        if text != sources[path]:
            contents[folder / path] = f'#include "{folder}/seeded_fault.h"\n{text}'.encode()
    contents[folder / "seeded_fault.h"] = HEADER.encode()
    for old in folder.rglob("*"):
        if old.is_file() and old not in contents and old.relative_to(folder).parts[0] != "build":
            old.unlink()
    for path, content in contents.items():
        if not path.is_file() or path.read_bytes() != content:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        if path != folder / "seeded_fault.h":
            path.chmod((ROOT / path.relative_to(folder)).stat().st_mode)


def build(folder, generator):
    """As the release build of test.sh, without benchmarks."""
    cloud = folder / "build/examples/Shape_regularization_tandem/building.ply"
    if subprocess.run([folder / "scripts/sample_cloud.sh", cloud]).returncode != 0:
        print("without the sample cloud, the examples of the building are not run")
    subprocess.run(["cmake", "-S", folder, "-B", folder / "build", *generator, "-DCMAKE_BUILD_TYPE=Release",
                    "-DTANDEM_BUILD_TESTS=ON", "-DTANDEM_BUILD_EXAMPLES=ON", "-DTANDEM_BUILD_PYTHON=ON",
                    "-DTANDEM_WITH_CUDA=OFF", "-DPython3_EXECUTABLE=/usr/bin/python3"], check=True)
    subprocess.run(["cmake", "--build", folder / "build", "-j", JOBS], check=True)


def failed_tests(folder, number, *options):
    run = subprocess.run(["ctest", "-j", JOBS, "-LE", "package|browser", "--timeout", str(LONGEST), *options],
                         cwd=folder / "build", env={**os.environ, "TANDEM_FAULT": str(number)},
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    return re.findall(r"Test +#\d+: (\S+) .*\*\*\*(?!Skipped|Not Run)", run.stdout), run


def who_notices(folder, fault, exclude, goes_on):
    stop = [] if goes_on else ["--stop-on-failure"]
    first, _ = failed_tests(folder, fault["number"], "-R", fault["hint"], "-E", exclude, *stop)
    if first and not goes_on:
        return first
    return first + failed_tests(folder, fault["number"], "-E", f"{exclude}|{fault['hint']}", *stop)[0]


def main():
    arguments = argparse.ArgumentParser(prog="seeded_faults.sh", description=__doc__)
    arguments.add_argument("folder", nargs="?", default=ROOT / "build/faults/source", help="for the copy")
    arguments.add_argument("--only", metavar="N,M", help="the numbers of the faults to try")
    arguments.add_argument("--all", action="store_true", help="goes on where a test has noticed")
    arguments.add_argument("--exclude", default="^$", metavar="REGEX", help="tests that are not run")
    arguments.add_argument("--copy-only", action="store_true", help="makes the copy, and does not compile")
    arguments.add_argument("--build-only", action="store_true", help="compiles, and does not run")
    arguments.add_argument("--run-only", action="store_true", help="runs what has been compiled")
    arguments.add_argument("-G", dest="generator", help="as for cmake")
    a = arguments.parse_args()
    folder = pathlib.Path(a.folder).resolve()
    faults = read_faults(ROOT / LIST)
    if not a.run_only:
        make_copy(folder, faults)
    if not a.run_only and not a.copy_only:
        build(folder, ["-G", a.generator] if a.generator else [])
    if a.copy_only or a.build_only:
        return
    for file in (folder / "build").rglob("CTestTestfile.cmake"):  # a limit of a test itself is stronger than --timeout
        file.write_text(re.sub(r'TIMEOUT "\d{3,}"', f'TIMEOUT "{LONGEST}"', file.read_text()))
    failed, run = failed_tests(folder, 0, "-E", a.exclude, "--no-tests=error")
    if run.returncode != 0:
        sys.exit(run.stdout + "seeded_faults: tests fail without a fault: " + ", ".join(failed))
    only = [int(n) for n in a.only.split(",")] if a.only else [f["number"] for f in faults]
    caught = 0
    for fault in (f for f in faults if f["number"] in only):
        noticed = who_notices(folder, fault, a.exclude, a.all)
        caught += bool(noticed)
        print(f"{fault['number']:2} | {fault['house']:20} | {fault['what']} | {' '.join(noticed) or 'nobody'}", flush=True)
    print(f"caught: {caught} of {len(only)}")


if __name__ == "__main__":
    main()
