// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What ends a run: errors, with texts of words and figures, and signals. None of these leaves a partial file, except for
// signals that no program can catch.

#ifndef DETECT_PLANES_ERRORS_H
#define DETECT_PLANES_ERRORS_H

#include "../sentences.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace program {

// Bad usage: exit code 2. Every other exception is exit code 1. The library makes them alike on all processes.
using Usage_error = std::invalid_argument;

using tandem_examples::sentence;
using tandem_examples::text_of;

// Why the system failed, in brackets, for the end of a message.
inline std::string reason_of(int error) { return std::string(" (") + std::strerror(error != 0 ? error : EIO) + ")"; }

template <class Error = std::runtime_error, class... Words>
[[noreturn]] void throw_error(const Words&... words)
{
  throw Error(text_of(words...));
}

// --- Ctrl-C and other signals

struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted, nothing was written") {}
};

inline volatile std::sig_atomic_t interrupt_flag = 0;

inline bool is_interrupted() { return interrupt_flag != 0; }

inline void check_signals()
{
  if(is_interrupted())
    throw Interrupted();
}

// The name of a file that a signal removes if it ends the process.
struct Removed_name {
  std::atomic<bool> is_set{false};
  char text[4096];
  Removed_name* next = nullptr;
};

// A handler of signals may use neither the heap nor a lock: the list only grows, and its entries are used again.
inline std::atomic<Removed_name*> removed_names{nullptr};

// Null if the name is too long.
inline Removed_name* remove_at_signal(const std::string& name)
{
  if(name.size() >= sizeof Removed_name::text)
    return nullptr;
  Removed_name* entry = removed_names;
  while(entry != nullptr && entry->is_set)
    entry = entry->next;
  if(entry == nullptr) {
    entry = new Removed_name;
    entry->next = removed_names;
    removed_names = entry;
  }
  std::memcpy(entry->text, name.c_str(), name.size() + 1);
  entry->is_set = true;
  return entry;
}

inline void remove_names()
{
  for(const Removed_name* entry = removed_names; entry != nullptr; entry = entry->next)
    if(entry->is_set)
      std::remove(entry->text);
}

inline void end_by_signal(int signal)
{
  remove_names();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

inline void handle(int signal, void (*handler)(int))
{
  struct sigaction action = {};
  action.sa_handler = handler; // without SA_RESTART, so that a call that waits ends
  sigaction(signal, &action, nullptr);
}

// Where a second signal, which no program can catch, may come soon: mpirun sends it.
inline volatile std::sig_atomic_t first_signal_removes = 0;

// The first signal requests the end of the run, a second one ends the process. What is interrupted finds its errno.
inline void request_end(int signal)
{
  const int error = errno;
  if(is_interrupted())
    end_by_signal(signal);
  interrupt_flag = 1;
  if(first_signal_removes != 0)
    remove_names();
  errno = error;
}

// When all files but the mesh are complete: exit code 1.
inline void end_mesh(int)
{
  constexpr char message[] = "detect_planes: interrupted; the other files are complete\n";
  remove_names();
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message, sizeof message - 1);
  _exit(1);
}

// Then the first signal ends the process.
inline void end_at_signal()
{
  for(int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if(action.sa_handler == request_end)
      handle(signal, end_mesh);
  }
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
  catch_unless_ignored(SIGHUP, request_end);
  for(int signal : {SIGPIPE, SIGQUIT, SIGXCPU, SIGXFSZ})
    catch_unless_ignored(signal, end_by_signal);
}

} // namespace program

#endif // DETECT_PLANES_ERRORS_H
