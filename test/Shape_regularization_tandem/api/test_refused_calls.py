#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Calls that must not compile have one error each, which says what to pass.
#   test_refused_calls.py SOURCE COMPILER OPTION...   SOURCE: calls, with a comment of what their error contains

import re
import subprocess
import sys


def expected_errors(source):
    """By line, what the error of a call contains."""
    with open(source) as file:
        found = [(number, re.search(r"// error: (.*)", line)) for number, line in enumerate(file, 1)]
    return {number: match[1] for number, match in found if match}


def errors_of(source, command):
    """Pairs of a line of the source, the one that an error is about, and its text."""
    # g++ says before an error where it comes from, clang after it.
    before = re.compile(re.escape(source) + r":(\d+):\d+: +required from here")
    after = re.compile(re.escape(source) + r":(\d+):\d+: note: in instantiation of")
    here = re.compile(re.escape(source) + r":(\d+):\d+: error: ")
    errors, line = [], None
    all_errors = ["-ferror-limit=0"] if "clang" in command[0] else []
    options = ["-std=c++17", "-fsyntax-only", *all_errors, source]
    output = subprocess.run(command + options, stderr=subprocess.PIPE, text=True).stderr
    for text in output.splitlines():
        if match := before.match(text):
            line = int(match[1])
        elif ": error: " in text or "fatal error: " in text:
            match = here.match(text)
            errors.append([int(match[1]) if match else line, text])
            line = None
        elif (match := after.match(text)) and errors:
            errors[-1][0] = int(match[1])
    return errors


def main():
    source, command = sys.argv[1], sys.argv[2:]
    expected = expected_errors(source)
    if len(expected) < 25:
        sys.exit(f"only {len(expected)} calls were found in {source}")
    complaints, seen = [], set()
    for line, text in errors_of(source, command):
        if line not in expected or expected[line] not in text:
            complaints.append(f"line {line} has another error: {text}")
        elif line in seen:
            complaints.append(f"line {line} has a second error: {text}")
        seen.add(line)
    complaints += [f"line {line} compiles" for line in expected if line not in seen]
    if complaints:
        sys.exit("\n".join(complaints))
    print(f"{len(expected)} calls, one error each")


main()
