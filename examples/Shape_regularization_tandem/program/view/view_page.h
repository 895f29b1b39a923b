// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page of --view, with three.js, as embed.cmake puts it together when the program is built. Empty without three.js.

#ifndef DETECT_PLANES_VIEW_PAGE_H
#define DETECT_PLANES_VIEW_PAGE_H

namespace program {

extern const char* const page_before_model;
extern const char* const page_after_model;

} // namespace program

#endif // DETECT_PLANES_VIEW_PAGE_H
