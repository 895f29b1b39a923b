// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_OUTPUT_FILES_H
#define DETECT_PLANES_OUTPUT_FILES_H

#include "Options.h"
#include "signals.h"
#include "output/Output_file.h"
#include "output/report.h"
#include "output/write_cloud.h"
#include "output/write_mesh.h"
#include "output/write_polygons.h"
#include "output/write_results.h"
#include "output/write_vg.h"
#include "view/write_view.h"

#include <deque>
#include <ostream>
#include <string>
#include <vector>

namespace program {

// The files to be written, opened before the work starts, so that a bad name costs no time.
class Output_files {
public:
  explicit Output_files(const Options& o) : options(o)
  {
    open(o.output, [](std::ostream& out, const Results& r) {
      write_cloud(out, r.points, r.shapes, {output_extension(r.o.output), r.o.colors, r.notes.las_frame});
    });
    open(o.labels, [](std::ostream& out, const Results& r) { write_labels(out, r.shapes); });
    open(o.planes, [](std::ostream& out, const Results& r) { write_planes(out, r.shapes); });
    open(o.vg,
         [](std::ostream& out, const Results& r) { write_vg(out, r.points, r.shapes, r.o.has_group_for_each_plane); });
    open(o.polygons, [](std::ostream& out, const Results& r) {
      write_polygons(out, r.points, r.shapes, r.o.polygons, r.o.has_triangles_only);
    });
    open(o.mesh, [](std::ostream& out, const Results& r) { write_mesh(out, r.points, r.shapes, r.o); });
    open(o.view, [](std::ostream& out, const Results& r) { write_view(out, r.points, r.shapes, r.run); });
    open(o.report, [](std::ostream& out, const Results& r) { write_report(out, r.shapes, r.run); });
  }

  bool is_empty() const { return files.empty(); }

  // All of them or, if one cannot be written, none.
  void write(const Point_set& points, const Input_notes& notes, const Shapes& shapes, const Run& run)
  {
    for(std::size_t i = 0; i < files.size(); ++i) {
      if(is_interrupted())
        throw Interrupted();
      writers[i](files[i].stream(), Results{options, points, notes, shapes, run});
      files[i].close();
    }
    if(is_interrupted())
      throw Interrupted();
    for(Output_file& file : files)
      file.commit();
  }

private:
  struct Results {
    const Options& o;
    const Point_set& points;
    const Input_notes& notes;
    const Shapes& shapes;
    const Run& run;
  };
  using Writer = void (*)(std::ostream&, const Results&);

  void open(const std::string& path, Writer writer)
  {
    if(path.empty())
      return;
    files.emplace_back(path);
    writers.push_back(writer);
  }

  const Options& options;
  std::deque<Output_file> files; // a file does not move
  std::vector<Writer> writers;
};

} // namespace program

#endif // DETECT_PLANES_OUTPUT_FILES_H
