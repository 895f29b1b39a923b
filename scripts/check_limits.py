#!/usr/bin/env python3
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails where a file has more than 300 lines, a function more than 60 in its body, or more than 5 parameters.

C++ is read as clang-format lays it out: the brace of a function of more than one line has a line of its own. Of Python,
docstrings and parameters that each call has to name do not count.
  check_limits.py            the sources of this repository
  check_limits.py FOLDER...  those below these folders
"""

import ast
import pathlib
import re
import sys

MOST_LINES_OF_FILE = 300
MOST_LINES = 60
MOST_PARAMETERS = 5

# What is no code of C++: comments, literals, directives.
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"\(.*?\)"|"(?:\\.|[^"\\\n])*"|(?<!\d)\'(?:\\.|[^\'\\\n])+\'|'
                     r'^[ ]*#(?:[^\n]*\\\n)*[^\n]*', re.DOTALL | re.MULTILINE)

# A parameter of C++, with or without its name and default value; what is between brackets has been left out.
PARAMETER = re.compile(r'(?:const )?(?:unsigned |typename )?[A-Za-z_][\w:]*(?:<>)?(?:::\w+)*(?: const)?[&*.\s]*'
                       r'(?:\(\)(?:\(\)|\[\])|\w*(?:\[\])?)(?: = .*)?', re.DOTALL)
NAMED_PARAMETER = re.compile(r'.*[\w>&*.] ?[&*]?\b\w+(?: = .*)?', re.DOTALL)


def parts_of(text, start):
    """The texts between the commas from an opening bracket to its end, without what is in brackets within."""
    parts, depth = [''], 0
    for i in range(start, len(text)):
        character = text[i]
        opens = character in '([{' or character == '<' and not text[i - 1].isspace()
        closes = character in ')]}' or character == '>' and text[i - 1] != '-' and not text[i - 1].isspace()
        depth -= closes
        if depth == 0 and closes:
            break
        if depth == 1 and character == ',':
            parts.append('')
        elif depth == 1:
            parts[-1] += character
        depth += opens
    return [part.strip() for part in parts]


def cxx_functions(text):
    """Line, number of lines and of parameters, where they may be too many, of the functions of C++."""
    text = NO_CODE.sub(lambda match: '0' + '\n' * match.group().count('\n'), text)
    for body in re.finditer(r'^( *)\{\n(.*?)^\1\}', text, re.DOTALL | re.MULTILINE):
        yield text.count('\n', 0, body.start()) + 1, body.group(2).count('\n'), 0
    for bracket in re.finditer(r'(?<=[\w\])>=*+/!-])\(', text):
        parts = parts_of(text, bracket.start())
        if all(map(PARAMETER.fullmatch, parts)) and NAMED_PARAMETER.fullmatch(parts[0]):
            yield text.count('\n', 0, bracket.start()) + 1, 0, len(parts)


def is_text(node):
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def python_functions(text):
    """The same of Python."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.Lambda)):
            names = [argument.arg for argument in node.args.posonlyargs + node.args.args]
            first = node.body[0] if isinstance(node, ast.FunctionDef) else node.body
            lines = node.end_lineno - (first.end_lineno if is_text(first) else first.lineno - 1)
            yield node.lineno, lines, len(names) - (names[:1] in (['self'], ['cls']))


def shell_functions(text):
    """The same of the shell, where parameters have no names."""
    for body in re.finditer(r'^\w+\(\)\s*\{\n(.*?)^\}', text, re.DOTALL | re.MULTILINE):
        yield text.count('\n', 0, body.start()) + 1, body.group(1).count('\n'), 0


def no_functions(_):
    return ()


READERS = {'.h': cxx_functions, '.cpp': cxx_functions, '.cuh': cxx_functions, '.cu': cxx_functions,
           '.py': python_functions, '.sh': shell_functions, '.cmake': no_functions, '.js': no_functions}


def complaints(file):
    text = file.read_text(encoding='utf-8')
    length = text.count('\n')
    if length > MOST_LINES_OF_FILE:
        yield length, f'the file has {length} lines'
    for line, lines, parameters in READERS[file.suffix](text):
        if lines > MOST_LINES:
            yield line, f'a function has {lines} lines'
        if parameters > MOST_PARAMETERS:
            yield line, f'a function has {parameters} parameters'


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    folders = sys.argv[1:] or [root / name for name in
                               ('include', 'examples', 'test', 'benchmark', 'cmake', 'doc', 'scripts')]
    found = [f'{file}:{line}: {text}' for folder in folders for file in sorted(pathlib.Path(folder).rglob('*'))
             if file.suffix in READERS for line, text in complaints(file)]
    print('\n'.join(found), end='\n' if found else '')
    return bool(found)


if __name__ == '__main__':
    sys.exit(main())
