// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page before and after the data, as embed_page.cmake puts it together of three.js and the files of this folder.

#ifndef DETECT_PLANES_PAGE_PARTS_H
#define DETECT_PLANES_PAGE_PARTS_H

namespace program {

// Texts in pieces, as compilers limit the length of a literal. They end with a null pointer.
struct Page_parts {
  const char* const* before_data;
  const char* const* after_data;
};

// No pieces if the program was built without three.js.
Page_parts page_parts();

} // namespace program

#endif // DETECT_PLANES_PAGE_PARTS_H
