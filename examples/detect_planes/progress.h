// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The line that tells what the program is doing.

#ifndef DETECT_PLANES_PROGRESS_H
#define DETECT_PLANES_PROGRESS_H

#ifdef __unix__
#include <unistd.h>
#endif

#include <CGAL/Tandem/detection_stage.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <utility>

namespace program {

inline const char* name_of(CGAL::Tandem::Detection_stage stage)
{
  const char* const names[] = {
    "sorting", "finding neighbors", "estimating normals", "choosing seeds", "growing shapes", "completing shapes",
    "done"};
  return names[int(stage)];
}

// Only on a terminal; gone when the work is done. A thread of its own draws it, four times a second, so that it moves
// whatever the work is.
class Progress_line {
public:
  Progress_line(bool is_wanted, std::string what) : work(std::move(what))
  {
    if(is_wanted && is_terminal())
      drawer = std::thread([this] { draw_until_end(); });
  }

  ~Progress_line()
  {
    if(!drawer.joinable())
      return;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      is_done = true;
    }
    end.notify_one();
    drawer.join();
    out << '\r' << std::string(width, ' ') << '\r' << std::flush;
  }

  Progress_line(const Progress_line&) = delete;
  Progress_line& operator=(const Progress_line&) = delete;

  // Of a detection.
  void show(double progress)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    share = (std::min)((std::max)(progress, 0.0), 1.0);
    work = name_of(CGAL::Tandem::stage_at(share));
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

  void draw_until_end()
  {
    std::unique_lock<std::mutex> lock(mutex);
    while(!end.wait_for(lock, std::chrono::milliseconds(250), [this] { return is_done; }))
      draw();
  }

  void draw()
  {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    std::ostringstream text;
    if(share >= 0) {
      const std::size_t full = std::size_t(share * bar_width);
      text << '[' << std::string(full, '#') << std::string(bar_width - full, '.') << "] " << std::setw(3)
           << int(100 * share) << " % ";
    }
    text << work << ", " << std::fixed << std::setprecision(1) << passed.count() << " s";
    const std::string line = text.str().substr(0, most_characters);
    const std::size_t before = width;
    width = line.size();
    out << '\r' << line << std::string(before > width ? before - width : 0, ' ') << std::flush;
  }

  std::ostream out{std::cerr.rdbuf()}; // its own: messages on std::cerr may be captured meanwhile
  static constexpr std::size_t bar_width = 40, most_characters = 79;
  const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::mutex mutex;
  std::condition_variable end;
  std::string work;
  double share = -1; // not known
  std::size_t width = 0;
  bool is_done = false;
  std::thread drawer;
};

} // namespace program

#endif // DETECT_PLANES_PROGRESS_H
