// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The last step that decides on single points: each is tested against the final plane of its shape. The test is in
// double, on the caller's coordinates and normals. It is filtered: integers accept all points that are not close to a
// bound. Changes labels, nothing else. In the loop, apply_planes() of shapes/update_shapes.h has detached most points
// that do not fit. See the manual, "Exact Check".

#ifndef CGAL_TANDEM_INTERNAL_RESULT_EXACT_CHECK_H
#define CGAL_TANDEM_INTERNAL_RESULT_EXACT_CHECK_H

#include <CGAL/Tandem/internal/cloud/Import.h>
#include <CGAL/Tandem/internal/shapes/Labeled_cloud.h>
#include <CGAL/Tandem/internal/shapes/Labels.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>

#include <utility>

namespace CGAL::Tandem::internal {

// --- From the labels of surfels to those of their points: each point has the label of its surfel, or none, as it is checked
// by itself. And what the result has of points. See the manual, "Exact Check".

// Planes, by label, and bounds for the points of shapes.
struct Bounded_planes {
  Surfels_view surfels;
  const Plane* plane;
  Tolerance tolerance;

  // point p of a surfel
  CGAL_TANDEM_HD bool hold(std::uint32_t label, std::uint32_t p) const
  {
    return fits(plane[label], surfels.point[p], surfels.tolerance_of_point(p, tolerance));
  }
};

// Points take the label of their surfel, if they may be within its tolerances, and its normal where normals are
// estimated.
struct Spread_surfel {
  Cloud_view cloud;
  const std::uint32_t* label;
  Bounded_planes possible;
  std::uint32_t* point_label;
  Grid_point* estimated; // the points; null where normals are given

  CGAL_TANDEM_HD void operator()(std::size_t p) const
  {
    const std::uint32_t i = cloud.surfels.of_point(std::uint32_t(p));
    if(estimated != nullptr)
      estimated[p].normal = cloud.point[i].normal;
    point_label[p] = label[i] >= first_mark || possible.hold(label[i], std::uint32_t(p)) ? label[i] : locked_label;
  }
};

// Makes the labels of points. Estimated normals go to the points, too.
template <class Backend>
void spread_labels(Labeled_cloud<Backend>& points, const std::uint32_t* label, const Bounded_planes& possible,
                   bool has_normals, Buffer_of<Backend, std::uint32_t>& point_label)
{
  Sorted_cloud<Backend>& cloud = points.cloud;
  if(!cloud.has_surfels())
    return;
  point_label.reset(cloud.number_of_points());
  points.backend.for_each(point_label.size(), Spread_surfel{cloud.view(), label, possible, point_label.data(),
                                                            has_normals ? nullptr : cloud.all_points.data()});
}

// A surfel is free if none of its points has kept its label.
struct Free_rejected {
  Labels_of_points labels;
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    bool is_kept = false;
    labels.for_each_point(std::uint32_t(i), [&](std::uint32_t) { is_kept = true; });
    if(!is_kept)
      label[i] = free_label;
  }
};

// After points have been rejected; labels: of both, label: of the surfels.
template <class Backend>
void free_rejected(Labeled_cloud<Backend>& points, const Labels_of_points& labels, std::uint32_t* label)
{
  if(points.cloud.has_surfels())
    points.backend.for_each(points.cloud.number_of_surfels(), Free_rejected{labels, label});
}

// The next label of each surfel: its own one, or of a free surfel that of the neighbor in whose plane most of its points
// surely fit, of equal ones the nearest. These points get the label, too. A surfel of one point has been tried by the
// assignments.
struct Label_free_surfel {
  Cloud_view cloud;
  const std::uint32_t* label;
  Bounded_planes certain;
  std::uint32_t* next;
  std::uint32_t* point_label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    next[i] = label[i];
    if(i >= cloud.size || label[i] < first_mark)
      return; // of a ghost its owner decides
    const Range points = cloud.surfels.points(std::uint32_t(i));
    const std::uint32_t* row = cloud.row(std::uint32_t(i));
    std::uint32_t most = 0, last = free_label; // neighbors of one shape often follow each other
    for(int j = 0; j < cloud.k && row[j] != no_index && points.size() > 1; ++j) {
      const std::uint32_t t = label[row[j]];
      if(t >= first_mark || t == last)
        continue;
      last = t;
      std::uint32_t held = 0;
      for(std::uint32_t p = points.first; p < points.last; ++p)
        held += certain.hold(t, p);
      if(held > most) {
        most = held;
        next[i] = t;
      }
    }
    for(std::uint32_t p = points.first; p < points.last && most > 0; ++p)
      if(certain.hold(next[i], p))
        point_label[p] = next[i];
  }
};

// A surfel may be free because its mean normal fits nowhere, or its center. Its points may still fit.
template <class Backend>
void label_free_surfels(Labeled_cloud<Backend>& points, const Bounded_planes& certain,
                        Buffer_of<Backend, std::uint32_t>& label, Buffer_of<Backend, std::uint32_t>& point_label)
{
  if(!points.cloud.has_surfels())
    return;
  Buffer_of<Backend, std::uint32_t> next(label.size());
  points.backend.for_each(
    next.size(), Label_free_surfel{points.cloud.view(), label.data(), certain, next.data(), point_label.data()});
  label = std::move(next);
  points.ranks.refresh(label.data(), Rings::inner);
}

// Of the points that are in shapes, in the order of the imported points; the others have -1.
struct Write_shapes {
  Labels_of_points labels;
  const std::uint32_t* shape; // by surfel
  const std::uint32_t* order;
  std::int32_t* shape_of;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    labels.for_each_point(std::uint32_t(i), [&](std::uint32_t p) { shape_of[order[p]] = std::int32_t(shape[i]); });
  }
};

// Estimated normals, in the order of the imported points.
struct Write_normals {
  const Grid_point* point;
  const std::uint32_t* order;
  std::uint32_t* normal;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { normal[order[i]] = point[i].normal; }
};

// --- The check itself.

// What the host needs of a point to test it. The normal is the packed one, for clouds with estimated normals.
struct Uncertain_point {
  std::uint32_t shape, origin, normal, level; // origin: the imported point; level: of its tolerance
  std::uint32_t place;                        // in the sorted cloud
};

// The labeled points for which the filter fails: integers do not tell whether they are within the bounds, less all
// rounding of the point, of its normal and of the plane (see tuning::exactness). So a point that fits within these
// passes the exact test, too. The labels are those of the extraction: a test between two rounds changes no label of the
// loop.
struct Take_uncertain {
  Bounded_planes certain;
  std::uint32_t* label;
  const std::uint32_t* origin; // the imported points

  CGAL_TANDEM_HD bool has(std::uint32_t p) const { return label[p] < first_mark && !certain.hold(label[p], p); }
  CGAL_TANDEM_HD Uncertain_point take(std::uint32_t p) const
  {
    return {label[p], origin[p], certain.surfels.point[p].normal, certain.surfels.level_of_point(p), p};
  }
};

// Points that fail become free, and no plane is fitted afterwards.
struct Lock_rejected {
  const std::uint32_t* place;
  std::uint32_t* label;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { label[place[i]] = locked_label; }
};

// The test itself. It runs on the host, because the caller's coordinates and normals are there.
struct Check_exactly {
  Vectors_view coordinates;  // the caller's values, in the order of the imported points
  Vectors_view normals;      // of any length; null where they were estimated
  const Coefficients* plane; // by shape
  Exact_bounds bounds;

  bool is_within(const Uncertain_point& u) const
  {
    // An estimated normal is what the result reports for the point: its packed value.
    const Vector normal = normals.data != nullptr ? normalized(normals[u.origin]) : unpacked_normal(u.normal);
    return bounds.is_near(plane[u.shape], coordinates[u.origin], std::uint8_t(u.level)) &&
           bounds.is_aligned(plane[u.shape], normal);
  }
};

// Takes the label of each of the n points that is not within the bounds of its shape. Few points are uncertain, so
// little goes to the host and back.
template <class Backend>
void check_exactly(Backend& backend, std::size_t n, const Take_uncertain& points, const Check_exactly& check)
{
  const auto uncertain = backend.template collect_on_host<Uncertain_point>(n, points);
  std::vector<std::uint8_t> is_rejected(uncertain.size());
  backend.for_each_on_host(uncertain.size(), [&](std::size_t i) { is_rejected[i] = !check.is_within(uncertain[i]); });
  std::vector<std::uint32_t> rejected;
  for(std::size_t i = 0; i < uncertain.size(); ++i)
    if(is_rejected[i])
      rejected.push_back(uncertain[i].place);
  const auto places = to_buffer(backend, rejected);
  backend.for_each(places.size(), Lock_rejected{places.data(), points.label});
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_RESULT_EXACT_CHECK_H
