// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The interpreter of Python, compiled like the module. It leaves memory to the end of its process itself.

#include <Python.h>

extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

int main(int argc, char** argv) { return Py_BytesMain(argc, argv); }
