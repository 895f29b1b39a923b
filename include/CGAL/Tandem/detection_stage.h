// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_TANDEM_DETECTION_STAGE_H
#define CGAL_TANDEM_DETECTION_STAGE_H

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

The stages of a detection, in their order.
*/
enum class Detection_stage {
  sort,      ///< the points are sorted into cells
  neighbors, ///< the neighbors of each point are found
  normals,   ///< normals are estimated where none are given
  seeds,     ///< seeds of growth are chosen
  rounds,    ///< shapes grow, merge and are regularized, round after round
  end_game,  ///< points and shapes move by the score, relations are final, points are verified
  done       ///< the result is complete
};

/// \ingroup PkgShapeRegularizationTandemRef
/// the progress, in [0, 1], at which a stage begins
inline double first_progress(Detection_stage stage)
{
  constexpr double first[] = {0, .1, .2, .35, .4, .8, 1, 1};
  return first[int(stage)];
}

/// \ingroup PkgShapeRegularizationTandemRef
/// the stage of a detection that has reported this progress to the callback
inline Detection_stage stage_at(double progress)
{
  int stage = 0;
  while(stage < int(Detection_stage::done) && progress >= first_progress(Detection_stage(stage + 1)))
    ++stage;
  return Detection_stage(stage);
}

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_DETECTION_STAGE_H
