// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where given normals are oriented, surfels of the other side of a thin wall are no neighbors. Changes rows of the
// neighbor graph. See the manual, "Wall Sides".

#ifndef CGAL_TANDEM_INTERNAL_NEIGHBORS_CUT_WALL_SIDES_H
#define CGAL_TANDEM_INTERNAL_NEIGHBORS_CUT_WALL_SIDES_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/base/tuning/cloud.h>
#include <CGAL/Tandem/internal/cloud/Cloud.h>

namespace CGAL::Tandem::internal {

// Which neighbors have the wall side of a surfel. Integers and exact doubles, so that all back ends decide alike.
class Wall_side {
public:
  CGAL_TANDEM_HD explicit Wall_side(const Grid_point& p)
    : point_(p), normal_(decode_normal(p.normal)), squared_length_(int_product(normal_, normal_))
  {}

  // Whether a neighbor is of the same wall side: not of the opposite one, or so close to the plane of the surfel that its
  // normal may be wrong.
  CGAL_TANDEM_HD bool is_same(const Grid_point& q, double distance_steps) const
  {
    if(have_close_codes(point_.normal, q.normal)) // nearly all
      return true;
    const std::int64_t product = dot(q);
    return product >= 0 || !are_aligned(q, product) || is_near(q, distance_steps);
  }

  // Of the normals: positive if they make less than a right angle.
  CGAL_TANDEM_HD std::int64_t dot(const Grid_point& q) const { return int_product(normal_, decode_normal(q.normal)); }

  // Whether normals with this dot product make less than 45 degrees, or more than 135.
  CGAL_TANDEM_HD bool are_aligned(const Grid_point& q, std::int64_t dot) const
  {
    const Int_vector n = decode_normal(q.normal);
    return 2 * dot * dot > squared_length_ * int_product(n, n);
  }

  // Whether the neighbor is within a distance of the plane through the surfel with its normal.
  CGAL_TANDEM_HD bool is_near(const Grid_point& q, double distance_steps) const
  {
    const double along =
      double(std::int64_t(normal_.x) * (q.x - point_.x) + std::int64_t(normal_.y) * (q.y - point_.y) +
             std::int64_t(normal_.z) * (q.z - point_.z));
    return along * along <= distance_steps * distance_steps * double(squared_length_);
  }

private:
  Grid_point point_;
  Int_vector normal_;
  std::int64_t squared_length_;
};

// Counts the neighbors within a small distance of the plane of a surfel: those of the same wall side, and those
// of the opposite one. A pair of surfels counts as often as the smaller one has points. Of a sample by position in the
// cloud of all ranks.
struct Count_wall_sides {
  Cloud_view cloud;
  const std::uint32_t* weight; // points of each surfel, and of ghosts
  double distance_steps;

  CGAL_TANDEM_HD void operator()(std::size_t i, std::int64_t* sum) const
  {
    if((i + cloud.first) % tuning::orientation::surfels_per_sampled != 0)
      return;
    const std::uint32_t* row = cloud.row(std::uint32_t(i));
    const Wall_side side(cloud.point[i]);
    const double own_steps = distance_steps * level_factor(cloud.level_of(std::uint32_t(i)));
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const Grid_point& q = cloud.point[row[j]];
      const std::int64_t dot = side.dot(q);
      if(!side.are_aligned(q, dot) || !side.is_near(q, own_steps))
        continue;
      sum[dot < 0] += weight[i] < weight[row[j]] ? weight[i] : weight[row[j]];
    }
  }
};

struct Write_weight {
  Surfels_view surfels;
  std::uint32_t* weight;

  CGAL_TANDEM_HD void operator()(std::size_t i) const { weight[i] = surfels.points(std::uint32_t(i)).size(); }
};

// Takes the neighbors of the opposite wall side out of the row of a surfel, but those close to its plane: on one
// surface, normals may be wrong.
struct Drop_opposite_side {
  Cloud_view cloud;
  double distance_steps;
  std::uint32_t* neighbor;

  CGAL_TANDEM_HD void operator()(std::size_t i) const
  {
    const Wall_side side(cloud.point[i]);
    const double own_steps = distance_steps * level_factor(cloud.level_of(std::uint32_t(i)));
    std::uint32_t* const row = neighbor + i * std::size_t(cloud.k);
    int kept = 0, j = 0;
    for(; j < cloud.k && row[j] != no_index; ++j)
      if(side.is_same(cloud.point[row[j]], own_steps))
        row[kept++] = row[j];
    for(; kept < j; ++kept)
      row[kept] = no_index;
  }
};

// Whether normals are oriented like most of their neighbors is decided for the whole cloud.
template <class Backend>
void cut_wall_sides(Backend& backend, const Ranks<Backend>& ranks, Sorted_cloud<Backend>& cloud,
                    double maximum_distance_steps)
{
  const double distance_steps = maximum_distance_steps * tuning::orientation::same_side_fraction;
  const Cloud_view view = cloud.view();
  Buffer_of<Backend, std::uint32_t> weight(cloud.size_with_ghosts());
  backend.for_each(view.size, Write_weight{view.surfels, weight.data()});
  ranks.refresh(weight.data(), Rings::inner);
  const auto own = backend.template sum<2>(view.size, Count_wall_sides{view, weight.data(), distance_steps});
  const std::size_t same = ranks.total(std::size_t(own[0])), opposite = ranks.total(std::size_t(own[1]));
  if(same > 0 && tuning::orientation::agreement.is_reached(std::int64_t(same), std::int64_t(same + opposite)))
    backend.for_each(view.size, Drop_opposite_side{view, distance_steps, cloud.neighbor.data()});
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_NEIGHBORS_CUT_WALL_SIDES_H
