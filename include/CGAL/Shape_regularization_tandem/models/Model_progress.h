// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_MODEL_PROGRESS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_MODEL_PROGRESS_H

#include <CGAL/Tandem/Parameters.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace CGAL::Tandem::internal {

// Where work tells how far it is, and learns that it is to end. The callback is called by the thread that made this, also
// within loops in parallel.
class Model_progress {
public:
  struct Cancelled {};

  explicit Model_progress(Callback callback = Callback()) : callback_(std::move(callback)) {}

  // All of the work is done up to this part when the stage that begins ends.
  void begin_stage(double end)
  {
    begin_ = std::exchange(end_, end);
    check(0);
  }

  double end_of_stage() const { return end_; }

  // How much of the stage is done. Throws Cancelled.
  void check(double done) const
  {
    if(!callback_ || std::this_thread::get_id() != caller_)
      return;
    reached_ = (std::max)(reached_, begin_ + done * (end_ - begin_));
    if(!callback_(reached_))
      throw Cancelled();
  }

private:
  Callback callback_;
  std::thread::id caller_ = std::this_thread::get_id();
  double begin_ = 0, end_ = 0;
  mutable double reached_ = 0; // so that it never goes back
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_MODELS_MODEL_PROGRESS_H
