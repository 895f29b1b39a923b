// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The interpreter of Python, compiled like the module.

#include <Python.h>

int main(int argc, char** argv) { return Py_BytesMain(argc, argv); }
