#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes of the headers of tuning constants what the manual has of them.

  tuning.py aliases   settings of Doxygen: of growth::seed_tries, \\growth_seed_tries is the value. \\percent_ before
                      the name has the value as a percentage, \\root_ its root, and \\degrees_ the angle whose sine it
                      is, or whose square in radians, where the name ends in 2
  tuning.py page      the page of all constants
"""

import math
import pathlib
import re
import sys

FOLDER = pathlib.Path(__file__).parent.parent / "include/CGAL/Tandem/internal/base/tuning"
HEADERS = ["cloud", "normals", "growth", "score", "regularity", "exactness"]
CONSTANT = re.compile(r"constexpr [\w:]+ (\w+)(?:\[\w+\])? = (.*);")


class Constant:
    def __init__(self, name, expression, known):
        self.name, self.texts = name, [t for t in re.split(r"[{}, ]+", expression) if t]
        self.values = []
        if "{" not in expression:
            self.texts = [expression]
        for text in self.texts:
            text = re.sub(r"std::\w+\(", "(", text)
            text = re.sub(r"(?<=[\d.])f\b", "", text)
            self.values.append(eval(text, {}, known))  # an expression of numbers and of constants before

    def text(self):
        if len(self.values) == 2 and all(isinstance(v, int) for v in self.values):
            return "/".join(format(v, ",") for v in self.values)
        fraction = re.fullmatch(r"(\d+)\. / (\d+)", self.texts[0])
        return fraction.expand(r"\1/\2") if fraction else ", ".join(map(plain, self.values))

    def aliases(self):
        value = self.values[0] / self.values[1] if len(self.values) == 2 else self.values[0]
        yield "", self.text()
        yield "percent_", plain(round(100 * value, 9)) + " %"
        if value >= 0:
            yield "root_", format(math.sqrt(value), ".2g")
            if self.name.endswith("2") or value <= 1:
                angle = math.sqrt(value) if self.name.endswith("2") else math.asin(value)
                yield "degrees_", format(math.degrees(angle), ".1g")


def plain(value):
    return format(value, ",") if isinstance(value, int) else format(value, ".10g")


def comment_of(line):
    return re.sub(r"^ *// ?", "", line) + " "


def namespaces(header):
    """Name and comment of each namespace of constants, and its rows: a comment, and the constants that it is of."""
    comment, name, rows, known = "", "", [], {}
    for line in (FOLDER / (header + ".h")).read_text().splitlines():
        begin, end = re.match(r"namespace (\w+) \{", line), re.match(r"\} // namespace (\w+)", line)
        constant = CONSTANT.match(line)
        if line.startswith("//"):
            comment += comment_of(line)
        elif begin:
            name, about, rows, known, comment = begin[1], comment, [], {}, ""
        elif constant:
            c = Constant(constant[1], constant[2], known)
            known[c.name] = c.values[0]
            if comment:
                rows.append((comment, []))
            rows[-1][1].append(c)
            comment = ""
        elif end and end[1] == name and rows:
            yield name, about, rows
        elif not line:
            comment = ""


def check():
    files = {path.stem for path in FOLDER.glob("*.h")}
    if files != set(HEADERS) | {"Share"}:
        sys.exit("tuning.py: it does not know all headers of " + str(FOLDER))


def print_aliases():
    for header in HEADERS:
        for namespace, _, rows in namespaces(header):
            for constant in (c for _, constants in rows for c in constants):
                for form, text in constant.aliases():
                    print(f'ALIASES += "{form}{namespace}_{constant.name}={text}"')


def escaped(text):
    return re.sub(r"([|<>#])", r"\\\1", text.strip())


def print_page():
    intro = "".join(comment_of(line) for line in (FOLDER / "Share.h").read_text().split("\n\n")[0].splitlines()[3:])
    print("/*!\n\\page Tandem_numbers The Numbers of the Method\n\n\\cgalAutoToc\n\n\\details\n" + escaped(intro))
    for header in HEADERS:
        for namespace, about, rows in namespaces(header):
            print(f"\n\\section Tandem_numbers_{namespace} {namespace.replace('_', ' ').capitalize()}\n\n{escaped(about)}")
            print("\n| constant | value | meaning |\n|:--|:--|:--|")
            for comment, constants in rows:
                names = "<br>".join(f"`{c.name}`" for c in constants)
                values = "<br>".join(c.text() for c in constants)
                print(f"| {names} | {values} | {escaped(comment)} |")
    print("\n\\tandemPages{Tandem_method,Tandem_guarantees}\n*/")


check()
{"aliases": print_aliases, "page": print_page}[sys.argv[1]]()
