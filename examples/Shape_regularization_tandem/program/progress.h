// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The progress bar.

#ifndef DETECT_PLANES_PROGRESS_H
#define DETECT_PLANES_PROGRESS_H

#ifdef __unix__
#include <unistd.h>
#endif

#include <algorithm>
#include <iostream>
#include <string>

namespace program {

// Only on a terminal; gone when the work is done.
class Progress_bar {
public:
  explicit Progress_bar(bool is_wanted) : is_shown(is_wanted && is_terminal()) {}
  ~Progress_bar()
  {
    if(percent >= 0)
      std::cerr << '\r' << std::string(width + 7, ' ') << '\r' << std::flush;
  }
  Progress_bar(const Progress_bar&) = delete;
  Progress_bar& operator=(const Progress_bar&) = delete;

  // Always true, so that it can be part of a condition to go on.
  bool show(double share)
  {
    const int now = int(100 * (std::min)((std::max)(share, 0.0), 1.0));
    if(is_shown && now != percent) {
      percent = now;
      const std::size_t full = std::size_t(now) * width / 100;
      std::cerr << "\r[" << std::string(full, '#') << std::string(width - full, '.') << "] " << now << " %"
                << std::flush;
    }
    return true;
  }

private:
  static bool is_terminal()
  {
#ifdef __unix__
    return isatty(STDERR_FILENO) != 0;
#else
    return false;
#endif
  }

  static constexpr std::size_t width = 40;
  bool is_shown;
  int percent = -1;
};

} // namespace program

#endif // DETECT_PLANES_PROGRESS_H
