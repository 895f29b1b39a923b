// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "page.h"
#include "experiments/experiments.h"
#include "page_clouds.h"
#include "page_overview.h"
#include "page_targets.h"

#include <cctype>
#include <filesystem>
#include <iostream>

namespace CGAL {
namespace Tandem {
namespace benchmark {

namespace {

std::vector<Row> rows_of(const std::string& path) { return html::exists(path) ? read_csv(path) : std::vector<Row>(); }

std::string environment_text(const Row& row)
{
  auto value = [&](const char* column) { return html::escaped(cell(row, column)); };
  std::string cores = value("processors");
  return "<p class=note>Tandem " + value("commit") + ", CGAL " + value("cgal") + ", " + value("compiler") + "; " +
         value("processor") + ", " + cores + (cores == "1" ? " processor" : " processors") + "; " +
         value("date").substr(0, 10) + "</p>\n";
}

// The pictures NAME*.svg of an experiment, in the order of their names.
std::vector<std::string> plots(const std::string& folder, const std::string& name)
{
  std::vector<std::string> paths;
  for(const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::string stem = entry.path().stem().string(), next = stem.substr((std::min)(name.size(), stem.size()), 1);
    bool is_of_name = stem.compare(0, name.size(), name) == 0 && (next.empty() || next == "-" || next == "_");
    if(entry.path().extension() == ".svg" && is_of_name)
      paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

// The columns of the step, which come before the contestant, and the main criteria.
std::string table_of_experiment(const std::vector<Row>& rows)
{
  std::vector<std::pair<std::string, int>> columns; // with the digits that are shown; -1: as it is
  for(const std::string& column : columns_of(rows)) {
    if(column == "contestant")
      break;
    columns.emplace_back(column, -1);
  }
  for(auto column : {std::make_pair("cloud", -1),
                     {"points", -1},
                     {"method", -1},
                     {"seconds", 2},
                     {"peak_mib", 0},
                     {"coverage_percent", 1},
                     {"shapes", 0},
                     {"directions_relaxed", 0},
                     {"planes_relaxed", 0},
                     {"complexity_relaxed", 3},
                     {"face_f1_50", 3},
                     {"point_precision", 3}})
    columns.emplace_back(column.first, column.second);
  std::string head, body;
  for(const auto& column : columns)
    head += html::tag("th scope=col", html::breakable(column.first));
  for(const Row& row : rows) {
    std::string line;
    for(const auto& column : columns) {
      std::string text = cell(row, column.first);
      if(column.second >= 0 && !text.empty())
        text = html::fixed(std::strtod(text.c_str(), nullptr), column.second);
      line += html::tag(column.second < 0 ? "td class=text" : "td", text.empty() ? "&ndash;" : html::escaped(text));
    }
    body += html::tag("tr", line) + "\n";
  }
  return html::table(head, body, "All runs");
}

std::string section_of_experiment(const std::string& folder, const Experiment& experiment)
{
  std::string name = experiment.name, text;
  std::vector<Row> rows = rows_of(folder + "/" + name + ".csv");
  for(const std::string& path : plots(folder, name))
    text += html::tag("figure class=plot", html::image(path, "image/svg+xml", name + ": " + experiment.help)) + "\n";
  if(!rows.empty())
    text += "<details><summary>The numbers</summary>\n" + table_of_experiment(rows) + "</details>\n";
  if(text.empty())
    return "";
  std::string title = html::escaped(experiment.help);
  title[0] = char(std::toupper(static_cast<unsigned char>(title[0])));
  return html::tag("section id=\"" + name + "\"", html::tag("h2", title) + text) + "\n";
}

std::string section_of_clouds(const std::string& folder, const std::vector<Cloud_results>& clouds)
{
  std::string text;
  for(const Cloud_results& c : clouds) {
    if(c.normals != "given")
      continue;
    auto own = std::find_if(clouds.begin(), clouds.end(),
                            [&](const Cloud_results& o) { return o.name == c.name && o.normals == "own"; });
    text += section_of_cloud(folder, c, own == clouds.end() ? nullptr : &*own);
  }
  return text;
}

const char* const legend =
  "<p class=note>Time is wall clock without reading and writing, the median of the runs. Complexity is the paper's, "
  "smaller is more regular; read it with the number of shapes, since splitting shapes lowers it. "
  "&gt;eps, &gt;alpha: points that are farther from the final plane of their shape, or turned more, than the method "
  "was allowed; &dagger; marks results that have such points, and the pictures show them in black. "
  "<em>Cleaned</em>: these points are dropped, then the shapes that have become too small. "
  "<em>Again, shuffled</em>: points that are in another shape when the method is run once more (RANSAC: with another "
  "seed, and small numbers are its range), and when the points come in another order. "
  "<strong>Bold</strong>: the best of the column. &#9650;: better than Tandem.</p>\n";

std::string page(const Experiment_options& options)
{
  const std::string folder = options.output;
  std::vector<Row> rows = rows_of(folder + "/results.csv"), exponents = rows_of(folder + "/scaling-exponents.csv");
  std::vector<Cloud_results> clouds = results_of_clouds(rows);
  std::string body = "<h1>Tandem beside its peers</h1>\n";
  if(!clouds.empty())
    body += environment_text(rows.front()) +
            html::tag("section", "<h2>Targets</h2>\n" + Target_table(clouds, exponents).text()) +
            html::tag("section", "<h2>Overview</h2>\n" + overview(clouds) + legend) + section_of_clouds(folder, clouds);
  std::string experiments;
  for(const Experiment& e : paper_experiments())
    experiments += section_of_experiment(folder, e);
  if(clouds.empty() && experiments.empty())
    throw std::runtime_error(folder + " has no results; run the other subcommands with this --output first");
  body += experiments;
  return "<!doctype html>\n<html lang=en>\n<head>\n<meta charset=utf-8>\n"
         "<meta name=viewport content=\"width=device-width, initial-scale=1\">\n"
         "<title>Tandem beside its peers</title>\n" +
         html::tag("style", html::read_file(options.sources + "/report/page.css")) + "\n</head>\n" +
         html::tag("body", html::tag("main", body)) + "\n</html>\n";
}

} // namespace

void run_page(const Experiment_options& options)
{
  std::string path = options.output + "/index.html", text = page(options);
  std::ofstream out(path);
  out << text;
  out.close();
  if(!out)
    throw std::runtime_error(path + ": cannot be written");
  std::cout << "wrote " << path << "\n";
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL
