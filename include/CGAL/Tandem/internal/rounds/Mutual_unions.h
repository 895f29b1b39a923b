// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Unions of touching shapes that gain (Union_gain), in rounds of mutual choice. merge_shapes.h runs
// them, and merges the shapes and their surfels. See the manual, "Unions".

#ifndef CGAL_TANDEM_INTERNAL_ROUNDS_MUTUAL_UNIONS_H
#define CGAL_TANDEM_INTERNAL_ROUNDS_MUTUAL_UNIONS_H

#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/backend/lanes.h>
#include <CGAL/Tandem/internal/base/keys.h>
#include <CGAL/Tandem/internal/base/tuning/exactness.h>
#include <CGAL/Tandem/internal/rounds/Shape_samples.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/Stage_parameters.h>
#include <CGAL/Tandem/internal/shapes/Shape.h>
#include <CGAL/Tandem/internal/shapes/Shape_table.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace CGAL::Tandem::internal {

// --- What the union of two shapes gains, see score/Score.h, by their moments and samples. Changes nothing, and reads
// no other point. By a group of lanes, which share the points of a sample. See the manual, "Unions".

// How much the sum of squared distances of a shape grows if this plane replaces its local one.
CGAL_TANDEM_HD inline double excess(const Scatter& scatter, const Fit& fit, const Regular_plane& plane)
{
  const double e = dot(plane.normal, scatter.centroid) - plane.offset;
  return fused(scatter.count * e, e, quadratic_form(scatter.matrix, plane.normal)) - fit.smallest;
}

// What is known of a shape, or of a union of shapes. The sample is one of its points.
struct Sampled_shape {
  const Fitted_moments& fitted;
  const Shape_sample& sample;

  CGAL_TANDEM_HD std::int64_t size() const { return fitted.moments.count; }
};

// Within moments, the worth of a shape is 1 - d^2 / epsilon^2, also of points that do not fit and are worth nothing.
// How much that counts wrong is estimated from the sample, as a difference of both planes for the same points, so that
// most of the error of a sample cancels out.
class Union_gain {
public:
  explicit Union_gain(const Stage_parameters& options)
    : score_(options.score), tolerance_(options.growth.tolerance),
      per_square_(double(Score::unit) / (options.maximum_distance_steps * options.maximum_distance_steps))
  {}

  // A cheap test, by one lane, for pairs that gain nothing: the sum of squares of the union exceeds what it could save.
  // Not where both together are worth less than that. Points that would not fit count by their squares here, too.
  CGAL_TANDEM_HD bool may_gain(const Fitted_moments& a, const Fitted_moments& b, const Contact& contact) const
  {
    const double squares = a.fit.smallest / a.scatter.squared_tolerance + b.fit.smallest / b.scatter.squared_tolerance;
    const std::int64_t na = a.moments.count, nb = b.moments.count;
    const double most = fused(continuity_of(a, b, contact), bonus(na, nb, na, nb), saved(contact));
    if(fused(-per_square_, squares, double(Score::unit) * double(na + nb)) < most)
      return true;
    const Symmetric_matrix joint = joint_matrix(weighted(a.scatter), weighted(b.scatter));
    const double rounding = tuning::exactness::eigenvalue_margin * (joint.xx + joint.yy + joint.zz);
    return !has_eigenvalues_above(joint,
                                  fused(tuning::exactness::bound_factor, squares + most / per_square_, rounding));
  }

  // In units of the score; not positive if nothing is gained, or too many points would not fit.
  CGAL_TANDEM_HD double operator()(const Sampled_shape& a, const Sampled_shape& b, const Contact& contact) const
  {
    Fitted_moments joint;
    joint.moments = a.fitted.moments;
    joint.moments += b.fitted.moments;
    refit(joint);
    const Part of_b = compare(b, joint.local);
    if(of_b.has_misfits)
      return 0;
    const Part of_a = compare(a, joint.local);
    if(of_a.has_misfits)
      return 0;
    const double size = bonus(a.size() - of_a.misfits, b.size() - of_b.misfits, a.size() - of_a.misfits_before,
                              b.size() - of_b.misfits_before);
    return saved(contact) + fused(continuity_of(a.fitted, b.fitted, contact), size, -(of_a.loss + of_b.loss));
  }

private:
  // At the contact, by the tolerance of the points of the smaller shape.
  CGAL_TANDEM_HD double continuity_of(const Fitted_moments& a, const Fitted_moments& b, const Contact& contact) const
  {
    return double(continuity_at(rounded(a.local), rounded(b.local), contact.center(), mean_tolerance(b, tolerance_))) /
           double(Score::unit);
  }

  // By a union of two shapes.
  CGAL_TANDEM_HD double saved(const Contact& contact) const
  {
    return -double(score_.price() + score_.links(std::int64_t(contact.links)));
  }

  // What a part loses of its fit by another plane, and how many of its points do not fit.
  struct Part {
    double loss;
    std::int64_t misfits, misfits_before;
    bool has_misfits; // more than a union may have, or it is not known: the rest is not computed then
  };

  // Of the sizes of a union and of its parts.
  CGAL_TANDEM_HD double bonus(std::int64_t na, std::int64_t nb, std::int64_t a, std::int64_t b) const
  {
    return double(score_.size_bonus(na + nb) - score_.size_bonus(a) - score_.size_bonus(b));
  }

  CGAL_TANDEM_HD Part compare(const Sampled_shape& s, const Regular_plane& candidate) const
  {
    const Plane before = rounded(s.fitted.local), after = rounded(candidate);
    const double per_square = per_square_ / s.fitted.scatter.squared_tolerance; // by the tolerances of its points
    double sum = 0;
    constexpr tuning::Ratio most = tuning::moves::misfits_of_union;
    std::int64_t misfits = 0, misfits_before = 0;
    bool has_misfits = s.sample.size == 0;
    for(std::uint32_t first = 0; first < s.sample.size && !has_misfits; first += Lane_group::size()) {
      const std::uint32_t i = first + Lane_group::rank();
      const bool is_point = i < s.sample.size;
      const Sampled_point& q = s.sample.item[is_point ? i : 0];
      const Tolerance own = tolerance_.at(std::uint8_t(q.level));
      const bool is_misfit = is_point && !fits(after, q.point, own),
                 was_misfit = is_point && !fits(before, q.point, own);
      misfits += Lane_group::count(is_misfit);
      has_misfits = most.is_exceeded(misfits, std::int64_t(s.sample.size));
      misfits_before += Lane_group::count(was_misfit);
      const double change =
        (is_misfit ? surplus(after, q.point, per_square) : 0) - (was_misfit ? surplus(before, q.point, per_square) : 0);
      // In the order of the sample, as sums are of doubles. Points that fit both planes change nothing.
      Lane_group::for_each_in_order(is_misfit || was_misfit, change, [&](double c) { sum += c; });
    }
    const double scale = s.sample.size > 0 ? double(s.size()) / double(s.sample.size) : 1;
    return {fused(per_square, excess(s.fitted.scatter, s.fitted.fit, candidate), -scale * sum),
            std::int64_t(scale * double(misfits)), std::int64_t(scale * double(misfits_before)), has_misfits};
  }

  // By how much the squares count a point too low that is worth nothing.
  CGAL_TANDEM_HD static double surplus(const Plane& plane, const Grid_point& p, double per_square)
  {
    const double e = double(signed_distance(plane, p)) / normal_scale;
    return fused(e * e, per_square, -double(Score::unit));
  }

  Score score_;
  Tolerance tolerance_;
  double per_square_; // units of the score for a squared grid step, at epsilon
};

// A number of its own for each pair of ids. In the order of the ids, equal shapes in a row would join one after the
// other, one in a round.
CGAL_TANDEM_HD inline std::uint64_t mixed_ids(std::uint32_t a, std::uint32_t b)
{
  const std::uint64_t mixed = hash_of_pair(std::uint64_t(a) << 32 | b);
  return hash_of_pair(mixed ^ mixed >> 32);
}

// By what a shape chooses one of its pairs: the largest gain, then the largest union, then the mixed ids. Two pairs
// have the same key only if they are of the same shapes.
struct Union_key {
  std::uint64_t cost = ~std::uint64_t(0), size = ~std::uint64_t(0), ids = ~std::uint64_t(0);
};

// Two roots, and what the test says of them. The first one has more points, or as many and the smaller id.
struct Union_pair {
  std::uint32_t first, second; // equal if the pair has been joined
  Union_key key;               // the cost is that of `rejected` if the test rejects the pair
  std::int32_t tested;         // the last round in which it was tested
  std::int32_t is_taken;       // the first one is so much larger that it may take several in one round
  Contact contact;

  static constexpr std::uint64_t rejected = ~std::uint64_t(0);
  CGAL_TANDEM_HD bool is_accepted() const { return first != second && key.cost != rejected; }
};

// A root between two rounds. Rounds are counted from 1 here; 0 means none.
struct Union_root {
  Union_key chosen;                // the smallest of its pairs
  std::int32_t takes = 0;          // the last round in which it had chosen a pair that it takes
  std::int32_t changed = 0;        // the last round in which others joined it
  std::uint32_t place = no_index;  // in the table of unions; none as long as it is the shape alone
  std::uint32_t joined = no_index; // the last one that joined it in this round, and ...
  std::uint32_t next = no_index;   // ... the one that joined the same root before it
};

// Each shape chooses its pair of the smallest key. Two shapes that choose each other become one. A much larger shape
// takes all that choose it in one round, as its plane hardly turns. All unions of a round are independent, then they
// are fitted and their pairs tested anew, until no two shapes join. The pair of the smallest key is chosen by both of
// its shapes, so each round has a union as long as a pair is accepted. Only minima, integer sums and values that are
// the same for all writers are shared, so no order matters. Tests and fits take most of the time: a rank makes its own
// items, and gets the others from the other ranks, see run_unions(). Tests are made where the samples are.
template <class Backend>
struct Union_rounds {
  // One after the other: each needs all of the one before.
  enum Step { test, choose_cost, choose_size, choose_ids, take, join, fit, number_of_steps };
  static constexpr int steps = number_of_steps;

  Union_gain gain;
  Union_pair* pair;
  std::size_t pairs, shapes;
  const Shape* shape;   // these by id
  Shape_sample* sample; // of a root, that of its union
  Union_root* root;
  std::uint32_t* target;  // what it has joined, or itself
  Shared_moments* joined; // the sums of those that joined in this round, zero between two
  Fitted_moments* whole;  // the unions, in any order
  std::uint32_t* joins;   // how many joined in this round, and in the one before or after: by parity
  std::uint32_t* total;   // the number of rounds, and that of the places in `whole`
  Sample_homes homes;     // where the samples are, and the own pairs and shapes

  // Only tests and fits are worth several threads where there are few.
  static constexpr std::size_t few(int step) { return step == test || step == fit ? 64 : 4096; }

  CGAL_TANDEM_HD bool is_last(std::size_t round) const { return joins[round % 2] == 0; }

  CGAL_TANDEM_HD void run(int step, std::size_t round, std::size_t lane, std::size_t lanes) const
  {
    if(step == fit && lane == 0)
      joins[(round + 1) % 2] = 0;
    if(step == test && lane == 0)
      total[0] = std::uint32_t(round + 1);
    const std::int32_t number = std::int32_t(round + 1);
    if(step == fit)
      for_items_of_group(
        lane, lanes, shapes, [&](std::size_t s) { return end_round(number, root[s]); },
        [&](std::size_t s) { fit_whole(s); });
    else if(step == test)
      for_items_of_group(
        lane, lanes, pairs, [&](std::size_t i) { return begin_test(number, i); }, [&](std::size_t i) { end_test(i); });
    else
      for_items_of_lane(lane, lanes, pairs, [&](std::size_t i) { run_pair(step, number, pair[i]); });
  }

  // A root with all that has joined it.
  CGAL_TANDEM_HD const Fitted_moments& united(std::uint32_t s) const
  {
    return root[s].place == no_index ? static_cast<const Fitted_moments&>(shape[s]) : whole[root[s].place];
  }

private:
  CGAL_TANDEM_HD void run_pair(int step, std::int32_t round, const Union_pair& p) const
  {
    if(!p.is_accepted())
      return;
    Union_root &a = root[p.first], &b = root[p.second];
    switch(step) {
    case choose_cost:
      Backend::atomic_min(a.chosen.cost, p.key.cost);
      Backend::atomic_min(b.chosen.cost, p.key.cost);
      break;
    case choose_size:
      for(Union_root* r : {&a, &b})
        if(r->chosen.cost == p.key.cost)
          Backend::atomic_min(r->chosen.size, p.key.size);
      break;
    case choose_ids:
      for(Union_root* r : {&a, &b})
        if(r->chosen.cost == p.key.cost && r->chosen.size == p.key.size)
          Backend::atomic_min(r->chosen.ids, p.key.ids);
      break;
    case take:
      if(p.is_taken && is_chosen(p, a))
        Backend::atomic_max(a.takes, round);
      break;
    default: // join
      join_pair(round, p);
    }
  }

  CGAL_TANDEM_HD static bool is_chosen(const Union_pair& p, const Union_root& r)
  {
    return r.chosen.cost == p.key.cost && r.chosen.size == p.key.size && r.chosen.ids == p.key.ids;
  }

  // A pair of shapes that have changed gets new roots, and waits for a new verdict: then this returns whether it may be
  // accepted, and is an own item. By one lane.
  CGAL_TANDEM_HD bool begin_test(std::int32_t round, std::size_t i) const
  {
    Union_pair& p = pair[i];
    if(p.first == p.second)
      return false;
    std::uint32_t a = target[p.first], b = target[p.second];
    const bool is_old =
      round > 1 && a == p.first && b == p.second && root[a].changed != round - 1 && root[b].changed != round - 1;
    if(is_old)
      return false;
    const std::int64_t na = united(a).moments.count, nb = united(b).moments.count;
    if(na < nb || (na == nb && b < a)) {
      const std::uint32_t swapped = a;
      a = b;
      b = swapped;
    }
    p.first = a;
    p.second = b;
    p.tested = round;
    p.is_taken = (na > nb ? na : nb) > tuning::moves::much_larger * (na > nb ? nb : na);
    p.key = {Union_pair::rejected, ~std::uint64_t(na + nb), mixed_ids(a, b)};
    return a != b && homes.has_pair(i, a, b) && gain.may_gain(united(a), united(b), p.contact);
  }

  // By a group of lanes.
  CGAL_TANDEM_HD void end_test(std::size_t i) const
  {
    Union_pair& p = pair[i];
    const std::uint32_t a = p.first, b = p.second;
    const double gained = gain({united(a), sample[a]}, {united(b), sample[b]}, p.contact);
    Lane_group::single([&] {
      if(gained > 0)
        p.key.cost = ordered_bits(-gained);
    });
  }

  // The second shape joins the first one, if it has chosen the pair, and the first one has chosen it, too, or takes
  // shapes in this round: otherwise its plane is about to change. Of several links of one pair, one succeeds.
  CGAL_TANDEM_HD void join_pair(std::int32_t round, const Union_pair& p) const
  {
    Union_root& stays = root[p.first];
    if(!is_chosen(p, root[p.second]) || !(is_chosen(p, stays) || (p.is_taken && stays.takes == round)) ||
       Backend::atomic_exchange_if(target[p.second], p.second, p.first) != p.second)
      return;
    atomic_add<Backend>(joined[p.first], united(p.second).moments, Box());
    std::uint32_t& next = root[p.second].next;
    do
      next = Backend::atomic_load(stays.joined);
    while(Backend::atomic_exchange_if(stays.joined, +next, p.second) != next);
    Backend::atomic_max(stays.changed, round);
    Backend::atomic_add(joins[(round - 1) % 2], 1u);
  }

  // Whether others have joined the root in this round.
  CGAL_TANDEM_HD static bool end_round(std::int32_t round, Union_root& r)
  {
    r.chosen = Union_key();
    return r.changed == round;
  }

  // The sample of root s gets those of what has joined it. They may be many, of which few have points of less hash:
  // each lane looks at one.
  CGAL_TANDEM_HD void merge_samples(std::size_t s, std::uint32_t joined_first) const
  {
    for(std::uint32_t t = joined_first; t != no_index;) {
      std::uint64_t of_lane = no_index;
      for(std::uint32_t k = 0; k < Lane_group::size() && t != no_index; ++k, t = root[t].next)
        of_lane = k == Lane_group::rank() ? t : of_lane;
      const bool is_needed = of_lane != no_index && has_least(sample[s], sample[of_lane]);
      Lane_group::for_each_in_order(is_needed, of_lane, [&](std::uint64_t id) { merge_sample(sample[s], sample[id]); });
    }
  }

  // The root with what has joined it in this round.
  CGAL_TANDEM_HD void fit_whole(std::size_t s) const
  {
    Union_root& r = root[s];
    if(homes.has(s))
      merge_samples(s, r.joined);
    Lane_group::single([&] {
      r.joined = no_index;
      if(r.place == no_index) {
        r.place = Backend::atomic_add(total[1], 1u);
        whole[r.place] = shape[s];
      }
      Fitted_moments& m = whole[r.place];
      m.moments += joined[s].moments();
      joined[s] = Shared_moments();
      m.scatter = make_scatter(m.moments);
      if(homes.own.has(s))
        set_fit(m, fit_plane(m.scatter));
    });
  }
};

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_ROUNDS_MUTUAL_UNIONS_H
