// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program says about a run on standard error: messages, one line each, and the line that tells what it is doing.

#ifndef DETECT_PLANES_MESSAGES_H
#define DETECT_PLANES_MESSAGES_H

#include <boost/locale/utf.hpp>

#include <CGAL/Tandem/Parameters.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <sstream>
#include <string_view>
#include <thread>
#include <unistd.h>
#include <utility>

namespace program {

// --- Texts that may have any bytes: names of files and other pieces of input, in messages and in JSON.

using Utf8 = boost::locale::utf::utf_traits<char>;

// The UTF-8 character that a text begins with, and the number of its bytes; 0 bytes if it begins with something else.
inline std::pair<boost::locale::utf::code_point, std::size_t> first_character(std::string_view text)
{
  const char* end = text.data();
  const auto c = Utf8::decode(end, text.data() + text.size());
  return {c, boost::locale::utf::is_valid_codepoint(c) ? std::size_t(end - text.data()) : 0};
}

inline std::size_t utf8_length(std::string_view text) { return first_character(text).second; }

// The number of bytes of the character that a text begins with, if it can be shown: it is UTF-8, and does not control
// what shows it. Otherwise 0.
inline std::size_t visible_length(std::string_view text)
{
  const auto [c, length] = first_character(text);
  const bool is_control = c < 0x20 || (c >= 0x7f && c < 0xa0);
  const bool changes_direction =
    c == 0x61c || c == 0x200e || c == 0x200f || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
  return is_control || changes_direction ? 0 : length;
}

struct Visible {
  std::string_view text;
};

// Writes \x1b for a byte that cannot be shown, so that no input controls a terminal. Works without memory.
inline std::ostream& operator<<(std::ostream& out, const Visible& visible)
{
  std::string_view text = visible.text;
  while(!text.empty()) {
    std::size_t shown = 0;
    for(std::size_t n = 1; n > 0; shown += n)
      n = visible_length(text.substr(shown));
    out.write(text.data(), std::streamsize(shown));
    text.remove_prefix(shown);
    if(text.empty())
      break;
    const unsigned char byte = (unsigned char)(text[0]);
    out << "\\x"
        << "0123456789abcdef"[byte / 16] << "0123456789abcdef"[byte % 16];
    text.remove_prefix(1);
  }
  return out;
}

// One line, whatever a library or the name of a file put into the message. Works without memory, too.
inline void print_message(const char* before, std::string_view message, const char* after = "")
{
  std::cerr << before << Visible{message} << after << std::endl;
}

// Returns the exit code.
inline int fail(int code, const char* message, const char* advice = "")
{
  print_message("detect_planes: ", message, advice);
  return code;
}

inline void warn(std::string_view message) { print_message("detect_planes: warning: ", message); }

// ---

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
    if(is_wanted && isatty(STDERR_FILENO) != 0)
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

  void show(double progress)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    fraction = (std::min)((std::max)(progress, 0.0), 1.0);
  }

  // Of a detection.
  void show_stage(double progress)
  {
    show(progress);
    const std::lock_guard<std::mutex> lock(mutex);
    work = name_of(CGAL::Tandem::stage_at(fraction));
  }

private:
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
    if(fraction >= 0) {
      const std::size_t full = std::size_t(fraction * bar_width);
      text << '[' << std::string(full, '#') << std::string(bar_width - full, '.') << "] " << std::setw(3)
           << int(100 * fraction) << " % ";
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
  double fraction = -1; // not known
  std::size_t width = 0;
  bool is_done = false;
  std::thread drawer;
};

} // namespace program

#endif // DETECT_PLANES_MESSAGES_H
