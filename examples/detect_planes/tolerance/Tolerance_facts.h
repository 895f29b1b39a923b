// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_TOLERANCE_FACTS_H
#define DETECT_PLANES_TOLERANCE_FACTS_H

#include <string>

namespace program {

// What there is to say about the tolerances of a run.
struct Tolerance_facts {
  std::string source = "given"; // or "estimated", "auto-local", "column NAME" or "noise SUM"
  bool is_of_each_point = false;
  std::string note; // where one estimated tolerance is a compromise: why
  // Of the points with finite coordinates and a positive tolerance; 0 if there are none.
  double smallest = 0, mean = 0, largest = 0;
};

} // namespace program

#endif // DETECT_PLANES_TOLERANCE_FACTS_H
