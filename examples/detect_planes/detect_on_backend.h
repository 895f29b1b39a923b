// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shapes of a cloud: detected on the back end that was chosen, or those of planes that are known.

#ifndef DETECT_PLANES_DETECT_ON_BACKEND_H
#define DETECT_PLANES_DETECT_ON_BACKEND_H

#include "Built_with.h"
#include "cloud_warnings.h"
#include "detection.h"
#include "planes_file.h"
#include "ranks/Ranks.h"

#include <CGAL/Shape_regularization_tandem/shapes_of_planes.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace program {

// An automatic distance is estimated here, once. Where the noise varies, it is one for each point.
inline void choose_tolerances(const Point_set& points, const Ranks& ranks, Options& o)
{
  if(o.maximum_distance || has_tolerance_of_each_point(o))
    return;
  const CGAL::Tandem::Distance_estimate estimate = ranks.are_many()
                                                     ? ranks.estimate_distance(points, o)
                                                     : estimate_distance<CGAL::Parallel_if_available_tag>(points, o);
  o.estimate_note = with_options(estimate.note);
  if(estimate.noise_varies) {
    o.has_local_distances = true;
    o.estimated_distance = 0; // the tolerances bound it
    o.estimate_note = estimate.note.substr(0, estimate.note.find(':')) +
                      ": each point has a tolerance of its own (--maximum-distance D is one for all)";
  }
}

template <class Tag>
Shapes label_with(const Point_set& points, const Options& o)
{
  if(o.has_local_distances)
    estimate_tolerances<Tag>(points, o);
  const auto all = CGAL::Tandem::parameters::settings(parameters_of(o));
  if(const auto tolerances = find_property<double>(points, tolerance_name))
    return CGAL::Tandem::shapes_of_planes<Tag>(o.known_planes, points, all.maximum_distance_map(*tolerances));
  return CGAL::Tandem::shapes_of_planes<Tag>(o.known_planes, points, all);
}

// Only the points tell whether a given distance is too small for them.
inline Shapes detect_on_backend(const Point_set& points, const Options& o, Ranks& ranks)
try {
  Progress_line progress(!o.is_quiet && ranks.is_first(), "estimating parameters");
  if(!o.known_planes.empty())
    return o.backend == "sequential" ? label_with<CGAL::Sequential_tag>(points, o)
                                     : label_with<CGAL::Parallel_if_available_tag>(points, o);
  if(ranks.are_many())
    return ranks.detect(points, o, progress);
  if constexpr(has_cuda) {
    if(o.backend == "cuda")
      return detect<CGAL::Tandem::Cuda_tag>(points, o, progress);
    if(o.backend == "auto")
      return detect<CGAL::Tandem::Cuda_if_available_tag>(points, o, progress);
  }
  return o.backend == "sequential" ? detect<CGAL::Sequential_tag>(points, o, progress)
                                   : detect<CGAL::Parallel_if_available_tag>(points, o, progress);
} catch(const std::range_error& e) {
  const std::string message = e.what(), parameter = "maximum_distance";
  const Cloud_box own = box_of(points, Ranks());
  throw std::runtime_error((message.compare(0, parameter.size(), parameter) == 0
                              ? "--maximum-distance" + message.substr(parameter.size())
                              : message) +
                           (are_zeros_strange(own) ? "; " + advice_on_zeros(own) : ""));
}

} // namespace program

#endif // DETECT_PLANES_DETECT_ON_BACKEND_H
