// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Line plots of an experiment: panels over a common legend, drawn by gnuplot as SVG.
// The script is kept beside the picture, with its data, so that it can be redrawn.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLOT_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLOT_H

#include "criteria/results_csv.h"

#include <cstdlib>
#include <iostream>
#include <numeric>

namespace CGAL {
namespace Tandem {
namespace benchmark {

struct Axis {
  std::string label; // with the unit
  bool is_logarithmic = false;
  bool begins_at_zero = false;
};

struct Plot_point {
  double x, y;
  std::string mark; // written beside the point; may be empty
};

struct Series {
  std::string name;
  std::vector<Plot_point> points;
};

struct Panel {
  Axis x, y;
  std::vector<Series> series; // the same names in the same order in all panels of a plot
};

struct Plot {
  std::string title;
  std::vector<Panel> panels;
  std::vector<std::string> x_names = {}; // if the abscissae 0, 1, 2 ... stand for names
  bool is_connected = true;              // by lines
};

// Distinguishable for the color-blind (Okabe and Ito), and by their markers without colors.
inline std::string series_style(std::size_t i)
{
  static const char* const colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#555555"};
  return "pt " + std::to_string(i + 4) + " ps 0.8 lc rgb \"" + colors[i % 7] + "\"";
}

inline std::string gnuplot_quoted(const std::string& text)
{
  std::string quoted = "\"";
  for(char c : text)
    quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return quoted + '"';
}

// Where things are on the page, in pixels, as gnuplot wants it: shares of the page, from the lower left.
class Plot_page {
public:
  explicit Plot_page(const Plot& plot)
    : columns_(plot.panels.size() < 3 ? plot.panels.size() : (plot.panels.size() + 1) / 2),
      rows_((plot.panels.size() + columns_ - 1) / columns_), has_names_(!plot.x_names.empty())
  {}

  int width() const { return 10 + cell_width * int(columns_); }
  int height() const { return head + cell_height * int(rows_); }
  std::string at(int x, int y) const
  {
    std::ostringstream text;
    text << "screen " << double(x) / width() << "," << 1 - double(y) / height();
    return text.str();
  }

  std::string margins(std::size_t panel) const
  {
    const int left = cell_width * int(panel % columns_) + 95, top = head + cell_height * int(panel / columns_) + 10;
    std::ostringstream text;
    text << "set lmargin at screen " << double(left) / width() << "\nset rmargin at screen "
         << double(left + cell_width - 100) / width() << "\nset tmargin at screen " << 1 - double(top) / height()
         << "\nset bmargin at screen " << 1 - double(top + cell_height - (has_names_ ? 110 : 70)) / height() << "\n";
    return text.str();
  }

private:
  static constexpr int cell_width = 400, cell_height = 300, head = 90; // of title and legend
  std::size_t columns_, rows_;
  bool has_names_;
};

inline void write_axis(std::ostream& out, const char* name, const Axis& axis)
{
  out << "set " << name << "label " << gnuplot_quoted(axis.label) << " font \",12\"\n"
      << (axis.is_logarithmic ? "set logscale " : "unset logscale ") << name << "\nset " << name << "range ["
      << (axis.begins_at_zero ? "0:*" : "*:*") << "]\n";
}

inline void write_names(std::ostream& out, const std::vector<std::string>& names)
{
  out << "set xrange [-0.4:" << double(names.size()) - 0.6 << "]\nset xtics rotate by 25 right (";
  for(std::size_t i = 0; i < names.size(); ++i)
    out << (i == 0 ? "" : ", ") << gnuplot_quoted(names[i]) << " " << i;
  out << ")\n";
}

inline void write_series(std::ostream& out, const std::string& block, const Series& series)
{
  out << block << " << EOD\n";
  for(const Plot_point& p : series.points)
    out << p.x << " " << p.y << " " << gnuplot_quoted(p.mark) << "\n";
  if(series.points.empty())
    out << "NaN NaN \"\"\n";
  out << "EOD\n";
}

inline void write_panel(std::ostream& out, const Plot& plot, std::size_t index)
{
  const Panel& panel = plot.panels[index];
  write_axis(out, "x", panel.x);
  write_axis(out, "y", panel.y);
  if(!plot.x_names.empty())
    write_names(out, plot.x_names);
  auto block = [&](std::size_t s) { return "$p" + std::to_string(index) + "_" + std::to_string(s); };
  for(std::size_t s = 0; s < panel.series.size(); ++s)
    write_series(out, block(s), panel.series[s]);
  for(std::size_t s = 0; s < panel.series.size(); ++s) {
    out << (s == 0 ? "plot " : ", \\\n  ") << block(s) << " using 1:2 with "
        << (plot.is_connected ? "linespoints lw 2 " : "points lw 2 ") << series_style(s);
    if(!panel.series[s].points.empty() && !panel.series[s].points[0].mark.empty())
      out << ", " << block(s) << " using 1:2:3 with labels font \",10\" offset 0.8,0.6 left";
  }
  out << "\n";
}

// By hand, since gnuplot fits its own into the first panel.
inline void write_legend(std::ostream& out, const Plot& plot, const Plot_page& page)
{
  int x = 85, y = 45;
  for(std::size_t s = 0; s < plot.panels[0].series.size(); ++s) {
    const std::string& name = plot.panels[0].series[s].name;
    const int length = 45 + 7 * int(name.size());
    if(x > 85 && x + length > page.width()) {
      x = 85;
      y += 20;
    }
    out << "set label " << 2 * s + 1 << " \"\" at " << page.at(x, y) << " point lw 2 " << series_style(s)
        << " front\nset label " << 2 * s + 2 << " " << gnuplot_quoted(name) << " at " << page.at(x + 14, y)
        << " left\n";
    x += length;
  }
}

inline void write_script(std::ostream& out, const Plot& plot, const std::string& svg)
{
  const Plot_page page(plot);
  out << "set terminal svg size " << page.width() << "," << page.height()
      << " dynamic noenhanced background \"white\" font \"sans-serif,13\"\nset output " << gnuplot_quoted(svg)
      << "\nset grid lc rgb \"#dddddd\" lt 1\nset border 3\nset tics nomirror\nunset key\nset multiplot\n"
      << "set label 100 " << gnuplot_quoted(plot.title) << " at " << page.at(page.width() / 2, 20)
      << " center font \",16\"\n";
  write_legend(out, plot, page);
  for(std::size_t i = 0; i < plot.panels.size(); ++i) {
    out << page.margins(i);
    write_panel(out, plot, i);
    out << "unset label\n"; // title and legend come with the first panel
  }
  out << "unset multiplot\n";
}

// Writes BASE.gnuplot and, where gnuplot is installed, BASE.svg.
inline void draw(const std::string& base, const Plot& plot)
{
  std::ofstream out(base + ".gnuplot");
  write_script(out, plot, base + ".svg");
  out.close();
  if(!out)
    throw std::runtime_error(base + ".gnuplot: cannot be written");
  std::string command = "gnuplot '" + base + ".gnuplot'";
  if(std::system("command -v gnuplot > /dev/null 2>&1") != 0)
    std::cout << "no " << base << ".svg: gnuplot is not installed (Debian: gnuplot-nox)\n";
  else if(std::system(command.c_str()) != 0)
    throw std::runtime_error(command + " failed");
  else
    std::cout << "wrote " << base << ".svg\n";
}

// Of the rows that repeat a step: for times, whose errors are positive, the least.
enum class Repeats { mean, least };

// Two columns over all rows with the same `series` and `step` (columns, too), a point for each step in the order of the
// rows. Empty cells are left out.
class Series_table {
public:
  Series_table(std::vector<Row> rows, std::string series_column, std::string step_column,
               Repeats repeats = Repeats::mean)
    : rows_(std::move(rows)), series_column_(std::move(series_column)), step_column_(std::move(step_column)),
      repeats_(repeats)
  {}

  std::vector<Series> operator()(const std::string& x, const std::string& y, bool has_marks = false) const
  {
    std::vector<Series> all;
    for(const std::string& name : distinct(series_column_)) {
      all.push_back({name, {}});
      for(const std::string& step : distinct(step_column_)) {
        std::vector<double> xs, ys;
        for(const Row& row : rows_)
          if(cell(row, series_column_) == name && cell(row, step_column_) == step && !cell(row, y).empty()) {
            xs.push_back(std::atof(cell(row, x).c_str()));
            ys.push_back(std::atof(cell(row, y).c_str()));
          }
        if(!ys.empty())
          all.back().points.push_back({reduced(xs), reduced(ys), has_marks ? step : std::string()});
      }
    }
    return all;
  }

private:
  double reduced(const std::vector<double>& values) const
  {
    return repeats_ == Repeats::least ? *std::min_element(values.begin(), values.end())
                                      : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  }

  std::vector<std::string> distinct(const std::string& column) const
  {
    std::vector<std::string> values;
    for(const Row& row : rows_)
      if(std::find(values.begin(), values.end(), cell(row, column)) == values.end())
        values.push_back(cell(row, column));
    return values;
  }

  std::vector<Row> rows_;
  std::string series_column_, step_column_;
  Repeats repeats_;
};

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLOT_H
