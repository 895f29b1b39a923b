// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A page that shows the result in a browser: see view/page.js. It needs no other file and no network.

#ifndef DETECT_PLANES_WRITE_VIEW_H
#define DETECT_PLANES_WRITE_VIEW_H

#include "output/write_results.h"

#include <ostream>
#include <string>

namespace program {

// Whether three.js was there when the program was built.
bool has_view();

// title: what the page is called. Of more than three million points every k-th one is shown.
void write_view(std::ostream& out, const Point_set& points, const Shapes& shapes, const std::string& title);

} // namespace program

#endif // DETECT_PLANES_WRITE_VIEW_H
