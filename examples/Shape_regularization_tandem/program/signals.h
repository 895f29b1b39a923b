// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ctrl-C and other signals. None of them leaves a partial file, except for those that no program can catch.

#ifndef DETECT_PLANES_SIGNALS_H
#define DETECT_PLANES_SIGNALS_H

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace program {

struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted, nothing was written") {}
};

inline volatile std::sig_atomic_t interrupt_flag = 0;

inline bool is_interrupted() { return interrupt_flag != 0; }

// The name of a file that a signal removes if it ends the process.
struct Removed_name {
  std::atomic<bool> is_set{false};
  char text[4096];
};

// A handler of signals may use neither the heap nor a lock: there is room for a fixed number of names.
inline std::array<Removed_name, 8> removed_names;

// Null if there is no room.
inline Removed_name* remove_at_signal(const std::string& name)
{
  for(Removed_name& entry : removed_names) {
    if(entry.is_set || name.size() >= sizeof entry.text)
      continue;
    std::memcpy(entry.text, name.c_str(), name.size() + 1);
    entry.is_set = true;
    return &entry;
  }
  return nullptr;
}

inline void end_by_signal(int signal)
{
  for(const Removed_name& entry : removed_names)
    if(entry.is_set)
      std::remove(entry.text);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

inline void handle(int signal, void (*handler)(int))
{
#if defined(__unix__) || defined(__APPLE__)
  struct sigaction action = {};
  action.sa_handler = handler; // without SA_RESTART, so that a call that waits ends
  sigaction(signal, &action, nullptr);
#else
  std::signal(signal, handler);
#endif
}

// The first signal requests the end of the run, a second one ends the process.
inline void request_end(int signal)
{
  if(is_interrupted()) {
    end_by_signal(signal);
    return;
  }
  interrupt_flag = 1;
  handle(signal, request_end); // some systems reset it
}

// nohup ignores SIGHUP, for example: that stays so.
inline void catch_unless_ignored(int signal, void (*handler)(int))
{
  if(std::signal(signal, SIG_IGN) != SIG_IGN)
    handle(signal, handler);
}

inline void catch_signals()
{
  // Shells ignore SIGINT for what runs in the background.
  handle(SIGINT, request_end);
  handle(SIGTERM, request_end);
#if defined(__unix__) || defined(__APPLE__)
  catch_unless_ignored(SIGHUP, request_end);
  for(int signal : {SIGPIPE, SIGQUIT, SIGXCPU, SIGXFSZ})
    catch_unless_ignored(signal, end_by_signal);
#endif
}

} // namespace program

#endif // DETECT_PLANES_SIGNALS_H
