// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the page on one cloud: pictures, the table of all methods, and in
// words where a peer is better.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_CLOUDS_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_CLOUDS_H

#include "Cloud_results.h"
#include "html.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

// The criteria of the tables, with their names in full.
inline std::string words(const Criterion& c)
{
  static const std::map<std::string, std::string> names = {
    {"seconds", "time (seconds)"},
    {"user_seconds", "processor time (seconds)"},
    {"bytes_per_point", "peak memory (bytes a point)"},
    {"shapes", "shapes"},
    {"directions_relaxed", "directions, equal within 1e-6"},
    {"planes_relaxed", "planes, equal within 1e-6"},
    {"complexity_relaxed", "complexity, relations within 1e-6"},
    {"complexity_exact", "complexity, relations exact"},
    {"coverage", "coverage (%)"},
    {"mean_distance_in_epsilons", "mean distance (epsilons)"},
    {"max_distance_in_epsilons", "largest distance (epsilons)"},
    {"beyond_epsilon", "points beyond epsilon"},
    {"beyond_alpha", "points beyond alpha"},
    {"face_f1_50", "true faces found (F1 at overlap .5)"},
    {"face_f1_75", "true faces found (F1 at overlap .75)"},
    {"point_precision", "point precision"},
    {"point_recall", "point recall"},
    {"split_faces", "faces split into several shapes"},
    {"swallowed_faces", "faces swallowed by the shape of another"},
    {"angle_error_deg", "angle error of the faces found (degrees)"},
    {"parallel_kept_exact", "share of true parallel pairs made exact"},
    {"parallel_false_relaxed", "pairs made parallel that are not"},
    {"orthogonal_kept_exact", "share of true orthogonal pairs made exact"},
    {"orthogonal_false_relaxed", "pairs made orthogonal that are not"},
    {"coplanar_kept_exact", "share of true coplanar pairs made exact"},
    {"coplanar_false_relaxed", "pairs made coplanar that are not"}};
  auto found = names.find(c.column);
  return found == names.end() ? c.title : found->second;
}

inline std::vector<Criterion> all_criteria()
{
  std::vector<Criterion> all = shown_criteria();
  all.insert(all.end(), further_criteria().begin(), further_criteria().end());
  return all;
}

inline bool is_known(const Criterion& c, const Cloud_results& cloud)
{
  return std::any_of(cloud.methods.begin(), cloud.methods.end(),
                     [&](const Summary& m) { return m.is_finished() && !m.text(c).empty(); });
}

// The best of all methods, those included that violate their tolerances.
inline bool is_best(const Criterion& c, const Summary& summary, const Cloud_results& cloud)
{
  return c.better != Better::neither && concerns(c, summary) &&
         std::none_of(cloud.methods.begin(), cloud.methods.end(),
                      [&](const Summary& m) { return concerns(c, m) && is_better(c, m, summary); });
}

// From .. to, where the runs differ in more than their time.
inline std::string range(const Criterion& c, const Summary& m)
{
  std::string text = m.range(c), low = text.substr(0, text.find(".."));
  bool is_one = m.same("same_result") || low + ".." + low == text;
  return is_one || is_of_run(c) || is_cleaned(m) ? "" : "<br><small>" + text + "</small>";
}

inline std::string cell_of_method(const Criterion& c, const Summary& m, const Cloud_results& cloud)
{
  if(!concerns(c, m))
    return "<td>&ndash;</td>";
  bool ahead = is_ahead(c, m, cloud.tandem()), best = is_best(c, m, cloud);
  std::string content = html::grouped(m.text(c));
  if(best)
    content = html::tag("strong", content);
  if(ahead)
    content = "<span aria-label=\"better than Tandem\">&#9650;</span>" + content;
  std::string kind = best && ahead ? "best ahead" : best ? "best" : ahead ? "ahead" : "plain";
  return html::tag("td class=\"" + kind + "\"", content + range(c, m));
}

// How many points change their shape, by a column that holds their share.
inline std::string cell_of_change(const Summary& m, const char* column, bool is_same)
{
  double share = median(m, column);
  if(!std::isfinite(share) || is_cleaned(m))
    return "<td>&ndash;</td>";
  if(share > 0)
    return "<td class=missed>" + html::rounded(100 * share) + " %</td>";
  return is_same ? "<td class=good>same</td>" : "<td>planes differ</td>";
}

inline std::string row_of_method(const Summary& m, const Cloud_results& cloud)
{
  std::string row = "<th scope=row>" + html::escaped(cell(m.first(), "description")) + "</th>";
  if(!m.is_finished())
    return html::tag("tr class=failed", row + "<td colspan=30 class=\"note text\">did not finish: " +
                                          html::escaped(cell(m.first(), "error")) + "</td>");
  double ratio = median(m, "seconds") / median(cloud.tandem(), "seconds");
  row += is_cleaned(m) ? "<td>&ndash;</td>" : html::tag("td", html::rounded(ratio) + "&times;");
  for(const Criterion& c : shown_criteria())
    if(is_known(c, cloud))
      row += cell_of_method(c, m, cloud);
  row += cell_of_change(m, "points_relabeled", m.same("same_result"));
  row += cell_of_change(m, "relabeled_when_shuffled", m.same("same_planes_when_shuffled"));
  return html::tag(m.is_tandem() ? "tr class=tandem" : is_cleaned(m) ? "tr class=cleaned" : "tr", row) + "\n";
}

inline std::string table_of_methods(const Cloud_results& cloud, const std::string& caption)
{
  std::string head = "<th scope=col>method</th><th scope=col title=\"time as a multiple of Tandem's\">time ratio</th>";
  for(const Criterion& c : shown_criteria())
    if(is_known(c, cloud))
      head += "<th scope=col title=\"" + html::escaped(words(c)) + "\">" + html::escaped(c.title) + "</th>";
  head += "<th scope=col title=\"points in another shape when it is run again; RANSAC: with another seed\">again</th>"
          "<th scope=col title=\"points in another shape when the points come in another order\">shuffled</th>";
  std::string body;
  for(const Summary& m : cloud.methods)
    body += row_of_method(m, cloud);
  return html::table(head, body, caption);
}

// "A, B 0.5; C 0.4": those that are better, the best first, and together where they are as good.
inline std::string list_ahead(const Criterion& c, const Cloud_results& cloud)
{
  std::vector<const Summary*> ahead;
  for(const Summary& m : cloud.methods)
    if(is_ahead(c, m, cloud.tandem()))
      ahead.push_back(&m);
  std::stable_sort(ahead.begin(), ahead.end(),
                   [&](const Summary* a, const Summary* b) { return is_better(c, *a, *b); });
  std::string list;
  for(std::size_t i = 0; i < ahead.size(); ++i) {
    list += html::escaped(cell(ahead[i]->first(), "description")) + (violates_tolerances(*ahead[i]) ? "&dagger;" : "");
    bool is_last = i + 1 == ahead.size() || ahead[i + 1]->text(c) != ahead[i]->text(c);
    list += is_last ? " <b>" + html::grouped(ahead[i]->text(c)) + "</b>" : "";
    list += i + 1 == ahead.size() ? "" : is_last ? "; " : ", ";
  }
  return list;
}

inline std::string others_ahead(const Cloud_results& cloud)
{
  std::string items;
  for(const Criterion& c : all_criteria()) {
    std::string list = list_ahead(c, cloud);
    if(!list.empty())
      items += html::tag("li", html::escaped(words(c)) + ", Tandem <b>" + html::grouped(cloud.tandem().text(c)) +
                                 "</b>: " + list) +
               "\n";
  }
  if(items.empty())
    return "<p>In no criterion is a peer better here.</p>\n";
  return html::tag("ul class=ahead-list", items) + "\n";
}

inline std::string figure(const std::string& folder, const std::string& cloud, const std::string& method,
                          const std::string& caption)
{
  std::string path = folder + "/pictures/" + cloud + "." + method + ".png";
  if(!html::exists(path))
    return "";
  return html::tag("figure", html::image(path, "image/png", cloud + ", " + caption) +
                               html::tag("figcaption", html::escaped(caption)));
}

inline std::string pictures(const std::string& folder, const Cloud_results& cloud)
{
  std::string all =
    figure(folder, cloud.name, "input", "the points") + figure(folder, cloud.name, "truth", "the truth");
  for(const Summary& m : cloud.methods)
    if(!is_cleaned(m))
      all += figure(folder, cloud.name, cell(m.first(), "method"), cell(m.first(), "description"));
  return all.empty() ? "" : html::tag("div class=pictures", all) + "\n";
}

inline std::string section_of_cloud(const std::string& folder, const Cloud_results& given, const Cloud_results* own)
{
  auto value = [&](const char* column) { return cell(given.row(), column); };
  std::string text = "<h2>" + html::escaped(given.name) + "</h2>\n<p>" + html::grouped(value("points")) +
                     " points; epsilon " + value("epsilon") + ", alpha " +
                     html::fixed(std::atof(value("alpha_deg").c_str()), 1) + "&deg;, at least " + value("minimum") +
                     " points a shape, " + value("k") + " neighbors; the same points and normals for all.</p>\n";
  text += pictures(folder, given);
  text += table_of_methods(given, "With the same normals");
  text += "<h3>Where others are better</h3>\n" + others_ahead(given);
  if(own != nullptr)
    text += "<details><summary>Each with its own normals (peers: PCA of 20 neighbors)</summary>\n" +
            table_of_methods(*own, "With own normals") + others_ahead(*own) + "</details>\n";
  return html::tag("section id=\"cloud-" + html::escaped(given.name) + "\"", text) + "\n";
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PAGE_CLOUDS_H
