# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Of cost.sh: records what its folder of counts has, and compares it with a table."""

import math
import pathlib
import re
import sys

# Functions that have a row, NAME(), beside the stages of Stage_times; calls by any stage count. A row that is gone, or
# new, is no fault.
FUNCTIONS = """sort_points find_neighbors estimate_normals find_border order_seeds grow_cells collect_links sample_shapes
  merge_by_gain regularize_shapes apply_planes split_shapes raise_score regularize_finally choose_edge_sides
  separate_components free_clutter center_shapes extract_shapes""".split()


def short(name):
    """Without namespace, return type and arguments; None for those of other namespaces."""
    while "<" in name and re.search("<[^<>]*>", name):
        name = re.sub("<[^<>]*>", "", name)
    found = re.fullmatch(r"CGAL::Tandem::internal::(\w+)", name.partition("(")[0].rpartition(" ")[2])
    return found and found[1]


def count_functions(dumps):
    """Calls are counted where the callers are: "cfn=(ID) NAME" the first time, then "cfn=(ID)", "calls=..", and the
    position and the count."""
    counts = dict.fromkeys(FUNCTIONS, 0)
    for dump in dumps:
        names, called, is_count = {}, None, False
        for line in open(dump):
            function = re.match(r"c?fn=(\(\d+\))(?: (.*))?", line)
            if function:
                if function[2]:
                    names[function[1]] = short(function[2])
                called = names.get(function[1])
            if is_count and called in counts:
                counts[called] += int(line.split()[1])
            is_count = line.startswith("calls=")
    return [(name + "()", f"{count / 1e6:.1f}") for name, count in counts.items() if count]


def recorded(table):
    rows = (line.split(",") for line in table.read_text().splitlines()[2:])
    return {(cloud, stage): (float(first), float(present)) for cloud, stage, first, present in rows}


def record(table, compiler, now):
    old, is_same = recorded(table), table.read_text().startswith(f"# {compiler}\n")
    text = f"# {compiler}\ncloud,stage,first,present\n"
    for row, count in now.items():
        first, present = old.get(row, (float(count), 0))
        if present > 0 and not is_same:
            first *= float(count) / present
        text += f"{','.join(row)},{first:.1f},{count}\n"
    table.write_text(text)


def compare(old, now):
    """Prints what has changed, and returns whether that is a fault."""
    failed, rises, total = False, [], 0
    for (cloud, stage), count in now.items():
        if (cloud, stage) not in old:
            print(f"{cloud}, {stage} is new")
            continue
        first, present = old[cloud, stage]
        if stage == "total":
            total = count
            rises.append(math.log(total / first))
            print(f"{cloud}: {total:.0f} million instructions, {total / present:.3f} of those recorded, "
                  f"{total / first:.3f} of the first ones")
        if count > 1.03 * present and count > 0.01 * total:
            print(f"{cloud}, {stage}: {count:.1f} million instructions, but {present:.1f} are recorded")
            failed = True
    for cloud, stage in sorted(old.keys() - now.keys()):
        print(f"{cloud}, {stage} is gone")
        failed |= not stage.endswith("()")
    print(f"geometric mean of the clouds: {math.exp(sum(rises) / len(rises)):.3f} of the first instructions")
    return failed


def main(folder, table, compiler, option=None):
    folder, table, now = pathlib.Path(folder), pathlib.Path(table), {}
    for cloud in "building", "house", "scan":
        stages = [line.split(",") for line in (folder / f"{cloud}.csv").read_text().splitlines()]
        stages += count_functions(folder.glob(f"dump.{cloud}.*"))
        now.update({(cloud, stage): count for stage, count in stages})
    if option == "--record":
        record(table, compiler, now)
    return compare(recorded(table), {row: float(count) for row, count in now.items()})


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
