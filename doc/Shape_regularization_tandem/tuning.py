#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes of the headers of tuning constants what the manual has of them.
#   tuning.py aliases   settings of Doxygen: of growth::seed_tries, \growth_seed_tries is the value. \percent_ before the
#                       name has the value as a percentage, \root_ its root, and \degrees_ the angle whose sine it is, or
#                       whose square in radians, where the name ends in 2
#   tuning.py page      the page of all constants

import math
import pathlib
import re
import sys

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "include/CGAL/Tandem/internal/base/tuning"
HEADERS = ["cloud", "normals", "growth", "score", "regularity", "exactness"]


def plain(value):
    return format(value, ",") if isinstance(value, int) else format(value, ".10g")


def escaped(text):
    return re.sub(r"([|<>#])", r"\\\1", text.strip())


def without_slashes(lines):
    return "".join(re.sub(r"^ *// ?", "", line) + " " for line in lines)


class Constant:
    def __init__(self, name, expression, known):
        texts = [t for t in re.split(r"[{}, ]+", expression) if t] if "{" in expression else [expression]
        # Expressions of numbers and of constants before.
        values = [eval(re.sub(r"(?<=[\d.])f\b", "", re.sub(r"std::\w+\(", "(", t)), {}, known) for t in texts]
        self.name, self.value = name, values[0] / values[1] if len(values) == 2 else values[0]
        known[name] = values[0]
        fraction = re.fullmatch(r"(\d+)\. / (\d+)", texts[0])
        is_ratio = len(values) == 2 and all(isinstance(v, int) for v in values)
        self.text = fraction.expand(r"\1/\2") if fraction and not is_ratio else ("/" if is_ratio else ", ").join(
            map(plain, values))

    def aliases(self):
        yield "", self.text
        yield "percent_", plain(round(100 * self.value, 9)) + " %"
        if self.value >= 0:
            yield "root_", format(math.sqrt(self.value), ".2g")
            if self.name.endswith("2") or self.value <= 1:
                angle = math.sqrt(self.value) if self.name.endswith("2") else math.asin(self.value)
                yield "degrees_", format(math.degrees(angle), ".1g")


def namespaces():
    """Name and comment of each namespace of constants, and its rows: a comment, and the constants that it is of."""
    for header in HEADERS:
        text = (FOLDER / (header + ".h")).read_text()
        pattern = r"((?://.*\n)*)namespace (\w+) \{\n((?:(?!namespace ).*\n)*?)\} // namespace \2\n"
        for about, name, body in re.findall(pattern, text):
            rows, known = [], {}
            for comment, constants in re.findall(r"((?://.*\n)+)((?:constexpr .*\n)+)", body):
                found = re.findall(r"constexpr [\w:]+ (\w+)(?:\[\w+\])? = (.*);", constants)
                rows.append((without_slashes(comment.splitlines()), [Constant(*c, known) for c in found]))
            if rows:
                yield name, without_slashes(about.splitlines()), rows


def print_aliases():
    for namespace, _, rows in namespaces():
        for constant in (c for _, constants in rows for c in constants):
            for form, text in constant.aliases():
                print(f'ALIASES += "{form}{namespace}_{constant.name}={text}"')


def print_page():
    intro = without_slashes((FOLDER / "Ratio.h").read_text().split("\n\n")[0].splitlines()[3:])
    print("/*!\n\\page Tandem_numbers The Numbers of the Method\n\n\\cgalAutoToc\n\n\\details\n" + escaped(intro))
    for namespace, about, rows in namespaces():
        print(f"\n\\section Tandem_numbers_{namespace} {namespace.replace('_', ' ').capitalize()}\n\n{escaped(about)}")
        print("\n| constant | value | meaning |\n|:--|:--|:--|")
        for comment, constants in rows:
            names, values = "<br>".join(f"`{c.name}`" for c in constants), "<br>".join(c.text for c in constants)
            print(f"| {names} | {values} | {escaped(comment)} |")
    print("\n\\tandemPages{Tandem_method,Tandem_guarantees}\n*/")


if {path.stem for path in FOLDER.glob("*.h")} != {*HEADERS, "Ratio"}:
    sys.exit("tuning.py: it does not know all headers of " + str(FOLDER))
if sum(path.read_text().count("\nconstexpr ") for path in FOLDER.glob("*.h")) != \
        sum(len(constants) for _, _, rows in namespaces() for _, constants in rows):
    sys.exit("tuning.py: a constant has no comment, or is not in a namespace")
{"aliases": print_aliases, "page": print_page}[sys.argv[1]]()
