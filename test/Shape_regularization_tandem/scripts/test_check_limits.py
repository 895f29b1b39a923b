# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What scripts/check_limits.py says of sources at the limits and beyond them."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "scripts" / "check_limits.py"

# Sources with the line and the complaint that each is to cause; none: (0, "")
CASES = (
    ("lines.h", "\n" * 300, 0, ""),
    ("lines.cpp", "\n" * 301, 301, "file has 301 lines"),
    ("page.js", "\n" * 301, 301, "file has 301 lines"),
    ("body.h", "void f()\n{\n" + "  g();\n" * 60 + "}\n", 0, ""),
    ("long_body.h", "void f()\n{\n" + "  g();\n" * 61 + "}\n", 2, "function has 61 lines"),
    ("member.cuh", "struct A {\n  A()\n  {\n" + "    g();\n" * 61 + "  }\n};\n", 3, "function has 61 lines"),
    ("five.h", "void f(int a, int b, std::map<int, int> c, int d = g(1, 2), int e = {});\n", 0, ""),
    ("six.h", "void f(int a, int b, std::map<int, int> c, int d = g(1, 2), int e = {}, T&&... f);\n", 1, "6 parameters"),
    ("constructor.h", "struct A {\n  A(int a, const B<C, D>& b, C* c, D d, E<F>::G e, int f) : a_(a) {}\n};\n", 2,
     "6 parameters"),
    ("operator.cu", "struct A {\n  void operator()(int a, int b, int c, int d, int e, int) const {}\n};\n", 2,
     "6 parameters"),
    ("wrapped.h", "template <class A>\nvoid f(int a, int b, int c,\n       int d, int (&e)[2], int f)\n{\n}\n", 2,
     "6 parameters"),
    ("lambda.cpp", "auto f = [&](int a, int b, int c, int d, int e, auto f) { return 0; };\n", 1, "6 parameters"),
    ("calls.cpp", 'int a = f(a, b + 1, "c(,", new D, e, \',\', g<int, int>(1)); // f(int a, int b, int c, int d, int e, int f)\n',
     0, ""),
    ("body.py", 'def f(a):\n    """' + "\n" * 60 + '    """\n' + "    g()\n" * 60, 0, ""),
    ("long_body.py", "def f(a):\n" + "    g()\n" * 61, 1, "function has 61 lines"),
    ("five.py", "class A:\n    def f(self, a, b, c, d, e, *, f=0): g()\n", 0, ""),
    ("six.py", "def f(a, b, c, d, e, f=0): g()\n", 1, "6 parameters"),
    ("body.sh", "f()\n{\n" + "  g\n" * 60 + "}\n", 0, ""),
    ("long_body.sh", "f()\n{\n" + "  g\n" * 61 + "}\n", 1, "function has 61 lines"),
)


class TestCheckLimits(unittest.TestCase):

    def test_cases(self):
        for name, source, line, complaint in CASES:
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                file = pathlib.Path(folder, name)
                file.write_text(source, encoding="utf-8")
                run = subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, text=True, check=False)
                self.assertEqual((run.returncode, run.stderr), (1 if complaint else 0, ""))
                said = run.stdout.splitlines()
                self.assertEqual(len(said), 1 if complaint else 0, said)
                if complaint:
                    self.assertTrue(said[0].startswith(f"{file}:{line}: ") and complaint in said[0], said)


if __name__ == "__main__":
    unittest.main()
