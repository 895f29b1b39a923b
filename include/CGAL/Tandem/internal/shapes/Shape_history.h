// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the stages have noted of a shape, to tell later whether it has moved or grown since. Lengths are grid steps.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_HISTORY_H
#define CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_HISTORY_H

#include <CGAL/Tandem/internal/base/Box.h>
#include <CGAL/Tandem/internal/base/Tuning.h>
#include <CGAL/Tandem/internal/base/planes.h>

#include <cstdint>

namespace CGAL {
namespace Tandem {
namespace internal {

// The last count of misfits of a shape: the share of its points that fits the local plane, but not the candidate. Kept,
// so that nearly the same planes are not counted again.
struct Misfit_record {
  Regular_plane local = {}, candidate = {};
  std::int64_t points = 0;
  double misfit_share = 0;
};

class Shape_history {
public:
  // Whether its plane is fitted to the points that it has, and whether its links are those of its points and plane.
  CGAL_TANDEM_HD bool is_fitted() const { return is_fitted_ != 0; }
  CGAL_TANDEM_HD bool is_linked() const { return is_linked_ != 0; }
  CGAL_TANDEM_HD void set_fitted(bool is_fitted) { is_fitted_ = is_fitted; }
  CGAL_TANDEM_HD void set_linked(bool is_linked) { is_linked_ = is_linked; }

  // Whether its plane has moved since its points were checked against it. Then they are checked again, and linked.
  CGAL_TANDEM_HD bool check_again(const Box& box, const Regular_plane& plane, double maximum_distance)
  {
    if(!(bound_motion(box, checked_, plane) > tuning::motion::negligible * maximum_distance))
      return false;
    checked_ = plane;
    is_linked_ = false;
    return true;
  }
  CGAL_TANDEM_HD void set_checked(const Regular_plane& plane) { checked_ = plane; }

  // Whether its plane has moved far since the whole shape was put on the frontier.
  CGAL_TANDEM_HD bool restart_again(const Box& box, const Regular_plane& plane, double maximum_distance)
  {
    if(!(bound_motion(box, restarted_, plane) > tuning::motion::restart * maximum_distance))
      return false;
    restarted_ = plane;
    return true;
  }
  CGAL_TANDEM_HD void set_restarted(const Regular_plane& plane) { restarted_ = plane; }

  // The points that it had when its relations were found, 0 if it has none; and when it was examined for layers.
  CGAL_TANDEM_HD std::int64_t points_when_related() const { return related_; }
  CGAL_TANDEM_HD void set_related(std::int64_t points) { related_ = points; }
  CGAL_TANDEM_HD std::int64_t points_when_examined() const { return examined_; }
  CGAL_TANDEM_HD void set_examined(std::int64_t points) { examined_ = points; }

  // A shape that was rolled back takes part in relations again when it has grown, or after 2, 4, 8 ... rounds.
  // Otherwise each round would test it in vain.
  CGAL_TANDEM_HD void roll_back(std::int64_t points, int round)
  {
    if(rollbacks_ < tuning::verification::maximum_rollbacks)
      ++rollbacks_;
    retry_round_ = round + (1 << rollbacks_);
    retry_points_ = points + points / tuning::verification::retry_growth_divisor;
  }
  CGAL_TANDEM_HD bool is_waiting(std::int64_t points, int round) const
  {
    return round < retry_round_ && points < retry_points_;
  }
  CGAL_TANDEM_HD int rollbacks() const { return rollbacks_; }

  Misfit_record last_misfits;

private:
  Regular_plane checked_ = {}, restarted_ = {};
  std::int64_t related_ = 0, examined_ = 0, retry_points_ = 0;
  std::int32_t retry_round_ = 0, rollbacks_ = 0;
  std::int32_t is_fitted_ = 0, is_linked_ = 0; // wide, so that all bytes are defined where shapes are copied
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_SHAPES_SHAPE_HISTORY_H
