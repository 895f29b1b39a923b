// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A reader or a writer of LASzip.

#ifndef DETECT_PLANES_LASZIP_H
#define DETECT_PLANES_LASZIP_H

#include "errors.h"

#include <laszip_api.h>

namespace program {

class Laszip {
public:
  Laszip()
  {
    if(laszip_create(&pointer))
      throw std::runtime_error("LASzip cannot be used");
  }
  ~Laszip() { laszip_destroy(pointer); }
  Laszip(const Laszip&) = delete;
  Laszip& operator=(const Laszip&) = delete;

  // What a function of LASzip has returned; what: the message where it has failed.
  void check(laszip_I32 has_failed, const char* what) const
  {
    laszip_CHAR* error = nullptr;
    if(has_failed == 0)
      return;
    laszip_get_error(pointer, &error);
    throw_error(what, (error != nullptr ? " (" + std::string(error) + ")" : ""));
  }

  laszip_POINTER pointer = nullptr;
};

} // namespace program

#endif // DETECT_PLANES_LASZIP_H
