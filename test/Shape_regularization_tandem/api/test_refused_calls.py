#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Calls that must not compile have one error each, which says what to pass.
#   test_refused_calls.py SOURCE COMPILER OPTION...   SOURCE: calls, with a comment of what their error contains

import re
import subprocess
import sys


def errors_of(source, command):
    """Pairs of a line of the source, the one that an error is about, and its text."""
    # g++ says before an error where it comes from, clang after it.
    at = re.escape(source) + r":(\d+):\d+: "
    all_errors = ["-ferror-limit=0"] if "clang" in command[0] else []
    options = ["-std=c++17", "-fsyntax-only", *all_errors, source]
    errors, line = [], None
    for text in subprocess.run(command + options, stderr=subprocess.PIPE, text=True).stderr.splitlines():
        if match := re.match(at + " *required from here", text):
            line = int(match[1])
        elif ": error: " in text or "fatal error: " in text:
            match = re.match(at + "error: ", text)
            errors.append([int(match[1]) if match else line, text])
            line = None
        elif (match := re.match(at + "note: in instantiation of", text)) and errors:
            errors[-1][0] = int(match[1])
    return errors


source = sys.argv[1]
with open(source) as file:
    found = [(number, re.search(r"// error: (.*)", line)) for number, line in enumerate(file, 1)]
expected = {number: match[1] for number, match in found if match}
complaints, seen = [], set()
for number, text in errors_of(source, sys.argv[2:]):
    if number in seen or expected.get(number, text + "?") not in text:
        complaints.append(f"line {number} has another error: {text}")
    seen.add(number)
complaints += [f"line {number} compiles" for number in expected if number not in seen]
if complaints or len(expected) < 25:
    sys.exit("\n".join(complaints + [f"{len(expected)} calls in {source}"]))
print(f"{len(expected)} calls, one error each")
