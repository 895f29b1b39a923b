// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ctrl-C and other signals.

#ifndef DETECT_PLANES_SIGNALS_H
#define DETECT_PLANES_SIGNALS_H

#include <csignal>
#include <stdexcept>

namespace program {

struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted, nothing was written") {}
};

inline volatile std::sig_atomic_t interrupt_flag = 0;

inline bool is_interrupted() { return interrupt_flag != 0; }

// The first signal requests the end of the run, a second one ends the process.
inline void catch_interrupts()
{
  const auto handler = [](int signal) {
    interrupt_flag = 1;
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
}

} // namespace program

#endif // DETECT_PLANES_SIGNALS_H
