#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Says which tests notice each of the faults of test/Shape_regularization_tandem/seeded_faults.txt. Whoever removes or
joins tests runs it before and after.

All faults are compiled at once into a copy of the sources, and the variable TANDEM_FAULT chooses one when a program runs.
First, all tests have to pass without any. Tests that build packages or need a browser are left out.

With --requests, each fault drops a request of a stage for what follows from labels: without it, test_requests has to
fail. The variable CXX is the compiler of this test (default: g++)."""

import argparse
import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
JOBS = os.environ.get("TANDEM_JOBS", str(os.cpu_count()))
LONGEST = 300  # seconds of a test: one that hangs has noticed
HEADER = """#pragma once
#include <cstdlib>
namespace seeded_faults {
inline const int chosen = std::getenv("TANDEM_FAULT") != nullptr ? std::atoi(std::getenv("TANDEM_FAULT")) : 0;
}
#define CGAL_TANDEM_FAULT(n) (seeded_faults::chosen == (n))
"""


def read_faults():
    text = (ROOT / "test/Shape_regularization_tandem/seeded_faults.txt").read_text()
    for block in re.split(r"\n\n+", re.sub(r"^#.*\n", "", text, flags=re.M).strip()):
        head, *lines = block.splitlines()
        number, house, file, rest = head.split(" | ", 3)
        hint, what = rest.rsplit(" | ", 1)
        old, new = (" ".join(line[2:] for line in lines if line[0] == sign) for sign in "-+")
        yield {"number": int(number), "house": house.strip(), "file": file.strip(), "hint": hint.strip(), "what": what,
               "old": r"\s+".join(map(re.escape, old.split())),
               "new": re.sub(r"\bFAULT\b", f"CGAL_TANDEM_FAULT({int(number)})", new)}


def with_faults(sources, faults):
    """The sources, by path, with all faults: each in its file, or where else its text is."""
    changed = dict(sources)
    for fault in faults:
        def places(paths):
            return [(path, m.span()) for path in paths for m in re.finditer(fault["old"], changed[path])]
        found = places([path for path in sources if path.name == fault["file"]])
        found = found if len(found) == 1 else places(sources)
        if len(found) != 1:
            sys.exit(f"seeded_faults: {fault['number']} of {fault['file']}: its text is there {len(found)} times")
        path, (first, last) = found[0]
        changed[path] = changed[path][:first] + fault["new"] + changed[path][last:]
    return {path: text for path, text in changed.items() if text != sources[path]}


def with_requests(sources, places):
    """The sources in which each fault drops a table that a call of update_tables() names, or a call of states_of(). Adds
    where these are to the list."""
    changed = {}
    for path in sorted(path for path in sources if "internal" in path.parts):
        def dropped(call):
            places.append(f"{path}:{number}: {call[0]}")
            nothing = "0" if call[0].startswith("tables::") else "points.state()"
            return f"(CGAL_TANDEM_FAULT({len(places)}) ? {nothing} : {call[0]})"
        lines = sources[path].split("\n")
        for number, line in enumerate(lines, 1):
            tables = r"tables::[a-z]+|" if "update_tables(points" in line else ""
            lines[number - 1] = re.sub(tables + r"states_of\(points, [^()]*\)", dropped, line)
        changed[path] = "\n".join(lines)
    return {path: text for path, text in changed.items() if text != sources[path]}


def make_copy(folder, change):
    """The tracked files, some of them as change(sources) has them. Those that stay as they are keep their time, for the
    next build."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout.split(b"\0")
    paths = [path for path in map(pathlib.Path, map(os.fsdecode, names)) if (ROOT / path).is_file()]
    contents = {folder / path: (ROOT / path).read_bytes() for path in paths}
    sources = {path: (ROOT / path).read_text() for path in paths
               if path.parts[0] in ("include", "examples") and path.suffix in (".h", ".cpp")}
    for path, text in change(sources).items():
        contents[folder / path] = f'#include "{folder}/seeded_fault.h"\n{text}'.encode()
    contents[folder / "seeded_fault.h"] = HEADER.encode()
    for old in folder.rglob("*"):
        if old.is_file() and old not in contents and old.relative_to(folder).parts[0] != "build":
            old.unlink()
    for path, content in contents.items():
        if not path.is_file() or path.read_bytes() != content:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        path.chmod(0o755 if content.startswith(b"#!") else 0o644)


def check_requests(folder):
    places = []
    make_copy(folder, lambda sources: with_requests(sources, places))
    tests, program = folder / "test/Shape_regularization_tandem", folder / "test_requests"
    subprocess.run([os.environ.get("CXX", "g++"), "-std=c++17", "-O1", "-DBOOST_TEST_DYN_LINK", f"-I{folder}/include",
                    f"-I{tests}", "-I/usr/include/eigen3", tests / "testing/main.cpp", tests / "shapes/test_requests.cpp",
                    *tests.glob("scenes/*.cpp"), "-lboost_unit_test_framework", "-lgmp", "-lmpfr", "-lpthread", "-o",
                    program], check=True)

    def passes(number):
        return subprocess.run([program], env={**os.environ, "TANDEM_FAULT": str(number)}, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL).returncode == 0
    if not passes(0):
        sys.exit("seeded_faults: test_requests fails without a fault")
    superfluous = [place for number, place in enumerate(places, 1) if passes(number)]
    if superfluous:
        sys.exit("\n".join(["seeded_faults: these requests are not needed, or no test needs them:", *superfluous]))
    print(f"Each of {len(places)} requests is needed.")


def build(folder):
    """The preset dev."""
    cloud = folder / "build/examples/Shape_regularization_tandem/building.ply"
    subprocess.run([folder / "scripts/sample_cloud.sh", cloud])  # without it, examples of the building are not run
    subprocess.run(["cmake", "--preset", "dev", "-B", folder / "build"], cwd=folder, check=True)
    subprocess.run(["cmake", "--build", folder / "build", "-j", JOBS], check=True)


def failed_tests(folder, number, *options):
    run = subprocess.run(["ctest", "-j", JOBS, "-L", "quick", "--timeout", str(LONGEST), *options],
                         cwd=folder / "build", env={**os.environ, "TANDEM_FAULT": str(number)},
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    return re.findall(r"Test +#\d+: (\S+) .*\*\*\*(?!Skipped|Not Run)", run.stdout), run


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("folder", nargs="?", help="for the copy")
    arguments.add_argument("--requests", action="store_true", help="checks that each request is needed")
    arguments.add_argument("--only", metavar="N,M", help="the numbers of the faults to try")
    arguments.add_argument("--all", action="store_true", help="goes on where a test has noticed")
    arguments.add_argument("--exclude", default="^$", metavar="REGEX", help="tests that are not run")
    arguments.add_argument("--step", choices=["copy", "build", "run"], help="only this one of the three")
    a = arguments.parse_args()
    folder = pathlib.Path(a.folder or ROOT / "build" / ("requests" if a.requests else "faults/source")).resolve()
    if a.requests:
        check_requests(folder)
        return
    faults = list(read_faults())
    if a.step in (None, "copy"):
        make_copy(folder, lambda sources: with_faults(sources, faults))
    if a.step in (None, "build"):
        build(folder)
    if a.step not in (None, "run"):
        return
    for file in (folder / "build").rglob("CTestTestfile.cmake"):  # a limit of a test itself is stronger than --timeout
        file.write_text(re.sub(r'TIMEOUT "\d{3,}"', f'TIMEOUT "{LONGEST}"', file.read_text()))
    failed, run = failed_tests(folder, 0, "-E", a.exclude, "--no-tests=error")
    if run.returncode != 0:
        sys.exit(run.stdout + "seeded_faults: tests fail without a fault: " + ", ".join(failed))
    only = [int(n) for n in a.only.split(",")] if a.only else [f["number"] for f in faults]
    stop, caught = [] if a.all else ["--stop-on-failure"], 0
    for fault in (f for f in faults if f["number"] in only):
        noticed, _ = failed_tests(folder, fault["number"], "-R", fault["hint"], "-E", a.exclude, *stop)
        if a.all or not noticed:
            noticed += failed_tests(folder, fault["number"], "-E", f"{a.exclude}|{fault['hint']}", *stop)[0]
        caught += bool(noticed)
        print(f"{fault['number']:2} | {fault['house']:20} | {fault['what']} | {' '.join(noticed) or 'nobody'}", flush=True)
    print(f"caught: {caught} of {len(only)}")


if __name__ == "__main__":
    main()
