// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which shapes touch: the edges of the neighbor graph between their surfels. Sets the interior bits of surfels, and
// marks shapes as linked where only links of changed shapes are asked for; nothing else.

#ifndef CGAL_TANDEM_INTERNAL_SHAPES_LINKS_H
#define CGAL_TANDEM_INTERNAL_SHAPES_LINKS_H

#include <CGAL/Tandem/internal/base/tuning/score.h>
#include <CGAL/Tandem/internal/base/keys.h>
#include <CGAL/Tandem/internal/score/Score.h>
#include <CGAL/Tandem/internal/shapes/update_tables.h>

#include <algorithm>

namespace CGAL::Tandem::internal {

// A pair of shapes, and their contact, whose links are the edges of the neighbor graph between their surfels.
struct Link {
  static constexpr std::uint64_t none = ~std::uint64_t(0);

  std::uint64_t pair = none; // smaller id << 32 | larger id
  Contact contact;

  CGAL_TANDEM_HD std::uint32_t first() const { return std::uint32_t(pair >> 32); }
  CGAL_TANDEM_HD std::uint32_t second() const { return std::uint32_t(pair); }
};

// A hash table that all cells fill at the same time, with the next free slot for pairs of one hash. Where too many
// slots in a row are taken an addition is lost, and counted: the next attempt has a larger table. The places of the
// pairs depend on the order of the additions, the counts do not.
template <class Backend>
struct Link_set {
  Link* link;
  std::uint32_t size; // a power of two
  std::uint32_t* lost;

  CGAL_TANDEM_HD void add(std::uint64_t pair, const Contact& contact) const
  {
    constexpr std::uint32_t maximum_probes = 64;
    std::uint32_t slot = std::uint32_t(hash_of_pair(pair) >> 32);
    for(std::uint32_t probe = 0; probe < maximum_probes; ++probe, ++slot) {
      Link& l = link[slot & (size - 1)];
      const std::uint64_t old = Backend::atomic_exchange_if(l.pair, +Link::none, pair);
      if(old == Link::none || old == pair) {
        atomic_add<Backend>(l.contact, contact);
        return;
      }
    }
    Backend::atomic_add(*lost, 1u);
  }
};

// The links of a cell: one slot for each of 256 hashes. A pair whose slot belongs to another one goes to the links of
// all cells at once.
struct Link_scratch {
  static constexpr std::uint32_t slots = 256;
  Link link[slots];
};

// Counts the edges from surfels of selected shapes to surfels of other shapes, cell by cell. An edge is directed, from
// a surfel to one of its k neighbors. So a pair of selected shapes has its edges of both directions. Labels do not
// change meanwhile, and a cell writes states of its own surfels only.
template <class Backend>
struct Collect_links {
  Cloud_view cloud;
  Cells_view cells;
  const std::uint32_t* label;
  std::uint8_t* state;
  const std::uint8_t* is_selected; // by shape
  Link_set<Backend> links;

  template <class Block>
  CGAL_TANDEM_HD void operator()(Block& block, Link_scratch& scratch, std::uint32_t c) const
  {
    if(!cells.may_have(block, c, [&](std::uint32_t s) { return is_selected[s] != 0; }))
      return;
    const Range cell = cells[c];
    block.for_each(Link_scratch::slots, [&](std::uint32_t i) { scratch.link[i] = Link(); });
    block.for_each(cell.size(), [&](std::uint32_t at) { visit(block, scratch, cell.first + at); });
    block.for_each(Link_scratch::slots, [&](std::uint32_t i) {
      if(scratch.link[i].contact.links > 0)
        links.add(scratch.link[i].pair, scratch.link[i].contact);
    });
  }

private:
  // Counts the edges of surfel i, by one lane. Neighbors of one shape often follow each other.
  template <class Block>
  CGAL_TANDEM_HD void visit(Block& block, Link_scratch& scratch, std::uint32_t i) const
  {
    const std::uint32_t s = label[i];
    if(s >= first_mark || !is_selected[s] || (state[i] & interior_bit))
      return;
    const std::uint32_t* row = cloud.row(i);
    const std::uint32_t points = cloud.surfels.edge_weight(i);
    bool all_same = true;
    std::uint32_t last = s, edges = 0; // in a row to neighbors of shape `last`
    for(int j = 0; j < cloud.k && row[j] != no_index; ++j) {
      const std::uint32_t t = label[row[j]];
      all_same = all_same && t == s;
      if(t != last) {
        count(block, scratch, i, last, edges);
        last = t;
        edges = 0;
      }
      edges += points;
    }
    count(block, scratch, i, last, edges);
    if(all_same)
      state[i] |= interior_bit;
  }

  // So many edges from surfel i to surfels of shape t.
  template <class Block>
  CGAL_TANDEM_HD void count(Block& block, Link_scratch& scratch, std::uint32_t i, std::uint32_t t,
                            std::uint32_t edges) const
  {
    const std::uint32_t s = label[i];
    if(t >= first_mark || t == s || edges == 0)
      return;
    Contact contact;
    contact.add(edges, cloud.point[i]);
    const std::uint64_t pair = unordered_pair(s, t);
    Link& slot = scratch.link[std::uint32_t(hash_of_pair(pair) >> 56)];
    if(!block.count_pair(slot.pair, slot.contact.links, pair))
      return links.add(pair, contact);
    block.add(slot.contact.links, contact.links - 1);
    for(int d = 0; d < 3; ++d)
      block.add(slot.contact.position[d], contact.position[d]);
  }
};

// All touching shapes, or only those of which one has changed since its links were last collected.
enum class Links { all, changed };

struct Select_shape {
  Shape* shape;
  bool selects_all;
  std::uint8_t* is_selected;

  CGAL_TANDEM_HD void operator()(std::size_t id) const
  {
    is_selected[id] = shape[id].is_live() && (selects_all || !shape[id].history.is_linked);
    if(!selects_all)
      shape[id].history.is_linked = true;
  }
};

// Takes the links of enough edges from the table. If any was lost all slots are taken, which says so by their number.
struct Take_links {
  const Link* link;
  const std::uint32_t* lost;
  std::uint32_t minimum;

  CGAL_TANDEM_HD bool has(std::uint32_t i) const { return *lost > 0 || link[i].contact.links >= minimum; }
  CGAL_TANDEM_HD Link take(std::uint32_t i) const { return link[i]; }
};

inline void append(std::vector<Link>& links, const Link& link)
{
  if(links.empty() || links.back().pair != link.pair)
    return links.push_back(link);
  links.back().contact += link.contact;
}

// Of all links of the ranks, those with enough edges, by pair.
template <class Backend>
Buffer_of<Backend, Link> join_links(Backend& backend, const Ranks<Backend>& ranks, const Buffer_of<Backend, Link>& own)
{
  std::vector<Link> all = ranks.gather(to_vector(backend, own)), joined;
  std::sort(all.begin(), all.end(), [](const Link& a, const Link& b) { return a.pair < b.pair; });
  for(const Link& link : all)
    append(joined, link);
  const auto is_weak = [](const Link& link) { return link.contact.links < tuning::moves::minimum_edges; };
  joined.erase(std::remove_if(joined.begin(), joined.end(), is_weak), joined.end());
  return to_buffer(backend, joined);
}

// The links between live shapes with enough edges to touch, in any order. If the table is too small the cells are
// counted again with a larger one. Interior surfels found by then have no links, so none is lost.
template <class Backend>
Buffer_of<Backend, Link> collect_links(Labeled_cloud<Backend>& points, Shape_table<Backend>& shapes, Links which,
                                       Phase phase)
{
  Backend& backend = points.backend;
  update_tables(points, shapes, tables::lists);
  std::uint8_t* const state = states_of(points, phase);
  Buffer_of<Backend, std::uint8_t> is_selected(shapes.size);
  for_each_shape(backend, shapes, Select_shape{shapes.counted(), which == Links::all, is_selected.data()});
  // Hardly more than a pair for 8 surfels: a bound where most shapes are on other ranks.
  const std::size_t pairs = (std::min)(16 * shapes.size, points.cloud.number_of_surfels() / 8);
  std::size_t size = 1024;
  while(size < pairs)
    size *= 2;
  for(;; size *= 4) {
    auto table = filled_buffer(backend, size, Link());
    auto lost = filled_buffer(backend, 1, std::uint32_t(0));
    backend.template for_each_cell<Link_scratch>(
      points.number_of_parts(), Collect_links<Backend>{points.cloud.view(),
                                                       points.listed_parts(),
                                                       points.label(),
                                                       state,
                                                       is_selected.data(),
                                                       {table.data(), std::uint32_t(size), lost.data()}});
    points.ranks.sum(lost.data(), 1);
    constexpr bool are_many = Ranks<Backend>::are_many;
    constexpr std::uint32_t minimum = are_many ? 1 : tuning::moves::minimum_edges;
    auto links = backend.template collect<Link>(size, Take_links{table.data(), lost.data(), minimum});
    if(links.size() == size)
      continue;
    if constexpr(are_many)
      return join_links(backend, points.ranks, links);
    else
      return links;
  }
}

} // namespace CGAL::Tandem::internal

#endif // CGAL_TANDEM_INTERNAL_SHAPES_LINKS_H
