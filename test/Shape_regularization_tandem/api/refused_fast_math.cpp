// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Must not compile with -ffast-math, and say why.

#include <CGAL/Shape_regularization_tandem.h>

int main() {}
