// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The progress of a detection, as the caller's callback sees it. The fractions are guesses of time: those of stages
// that are not needed are passed over.

#ifndef CGAL_TANDEM_INTERNAL_BASE_PROGRESS_H
#define CGAL_TANDEM_INTERNAL_BASE_PROGRESS_H

#include <CGAL/Tandem/Parameters.h>

#include <algorithm>
#include <utility>

namespace CGAL::Tandem::internal {

class Progress {
public:
  explicit Progress(Callback callback = Callback()) : callback_(std::move(callback)) {}

  // Calls the callback, with a fraction that never falls. Returns whether the detection goes on: not after the callback
  // has returned false, which is the last time that it is called. What it throws passes through.
  bool show(double fraction)
  {
    fraction_ = (std::max)(fraction_, fraction);
    if(callback_ && !is_cancelled_)
      is_cancelled_ = !call();
    return !is_cancelled_;
  }

  // Calls the callback with a fraction of a stage. Returns whether the detection goes on.
  bool show(Detection_stage stage, double fraction)
  {
    const double first = first_progress(stage), last = first_progress(Detection_stage(int(stage) + 1));
    return show(first + fraction * (last - first));
  }

  // Calls the callback before a round, with a guess of the fraction, since the number of rounds is not known before.
  bool show_rounds(double rounds) { return show(Detection_stage::rounds, 1 - 8 / (8 + rounds)); }

  // Calls the callback for the last time. What it returns changes nothing any more.
  void show_end()
  {
    fraction_ = 1;
    if(callback_ && !is_cancelled_)
      call();
  }

  bool is_cancelled() const { return is_cancelled_; }

  // Whether an exception comes from the callback.
  bool has_thrown() const { return has_thrown_; }

private:
  bool call()
  {
    has_thrown_ = true;
    const bool goes_on = callback_(fraction_);
    has_thrown_ = false;
    return goes_on;
  }

  Callback callback_;
  double fraction_ = 0;
  bool is_cancelled_ = false;
  bool has_thrown_ = false;
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_BASE_PROGRESS_H
