// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the page on all clouds at a glance: how much longer each peer takes,
// and in what each is better than Tandem, on how many clouds.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_OVERVIEW_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_OVERVIEW_H

#include "page_clouds.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

struct Peer {
  std::string method, description;
  bool is_cleaned;
};

// All that took part on some cloud with the normals given, cleaned ones after the others.
inline std::vector<Peer> peers_of(const std::vector<Cloud_results>& clouds, bool with_cleaned)
{
  std::vector<Peer> peers;
  for(bool is_cleaned : {false, true})
    for(const Cloud_results& cloud : clouds)
      for(const Summary& m : cloud.methods) {
        std::string method = cell(m.first(), "method");
        bool is_new = std::none_of(peers.begin(), peers.end(),
                                   [&](const Peer& p) { return p.method == method && p.is_cleaned == is_cleaned; });
        bool fits = benchmark::is_cleaned(m) == is_cleaned && (with_cleaned || !is_cleaned);
        if(is_new && fits && !m.is_tandem() && cloud.normals == "given")
          peers.push_back({method, cell(m.first(), "description"), is_cleaned});
      }
  return peers;
}

inline std::string head_of_peers(const std::string& first, const std::vector<Peer>& peers)
{
  std::string head = html::tag("th scope=col", first);
  for(const Peer& p : peers)
    head += html::tag("th scope=col", html::breakable(p.description));
  return head;
}

// A cell for each peer: its time as a multiple of Tandem's.
inline std::string table_of_times(const std::vector<Cloud_results>& clouds)
{
  std::vector<Peer> peers = peers_of(clouds, false);
  std::string body;
  for(const Cloud_results& c : clouds) {
    if(c.normals != "given")
      continue;
    std::string row = "<th scope=row><a href=\"#cloud-" + html::escaped(c.name) + "\">" + html::escaped(c.name) +
                      "</a></th><td>" + html::grouped(cell(c.row(), "points")) + "</td><td>" +
                      html::rounded(median(c.tandem(), "seconds")) + " s</td>";
    for(const Peer& p : peers) {
      const Summary* m = c.find(p.method, false);
      double ratio = m == nullptr ? 0 : median(*m, "seconds") / median(c.tandem(), "seconds");
      row += m == nullptr ? "<td>&ndash;</td>"
                          : html::tag(ratio < 1 ? "td class=ahead" : "td", html::rounded(ratio) + "&times;");
    }
    body += html::tag("tr", row) + "\n";
  }
  std::string head = head_of_peers("cloud", peers);
  std::size_t end = head.find("</th>") + 5;
  head.insert(end, "<th scope=col>points</th><th scope=col>Tandem</th>");
  return html::table(head, body, "Time of the peers as a multiple of Tandem's, same normals");
}

// On how many of the clouds on which both are known the peer is better.
inline std::string count_ahead(const std::vector<Cloud_results>& clouds, const Peer& peer, const Criterion& c)
{
  std::size_t known = 0, ahead = 0;
  for(const Cloud_results& cloud : clouds) {
    const Summary* m = cloud.normals == "given" ? cloud.find(peer.method, peer.is_cleaned) : nullptr;
    if(m == nullptr || !concerns(c, *m) || cloud.tandem().text(c).empty())
      continue;
    ++known;
    ahead += is_ahead(c, *m, cloud.tandem());
  }
  if(known == 0)
    return "<td>&ndash;</td>";
  return html::tag(ahead > 0 ? "td class=ahead" : "td class=none",
                   ahead == 0 ? "0" : std::to_string(ahead) + " of " + std::to_string(known));
}

inline std::string table_of_criteria(const std::vector<Cloud_results>& clouds)
{
  std::vector<Peer> peers = peers_of(clouds, true);
  std::string body;
  for(const Criterion& c : all_criteria()) {
    if(c.better == Better::neither)
      continue;
    std::string row = html::tag("th scope=row", html::escaped(words(c)));
    for(const Peer& p : peers)
      row += count_ahead(clouds, p, c);
    body += html::tag("tr", row) + "\n";
  }
  return html::table(head_of_peers("criterion", peers), body,
                     "Where others are better than Tandem: on how many clouds, same normals");
}

inline std::string overview(const std::vector<Cloud_results>& clouds)
{
  return table_of_times(clouds) + table_of_criteria(clouds);
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_OVERVIEW_H
