// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_OUTPUT_FILES_H
#define DETECT_PLANES_OUTPUT_FILES_H

#include "input/read_cloud.h"
#include "output/Output_file.h"
#include "output/writers.h"

#include <deque>

namespace program {

// The files to be written, opened before the work starts, so that a bad name costs no time. What one process writes for
// all is written by the first one, the file of an input by the one that has read it.
class Output_files {
public:
  // Before this, --output-directory has been made.
  Output_files(const Options& o, const Input_cloud& cloud, bool is_first) : options(o), cloud(cloud)
  {
    if(!o.output_directory.empty())
      try_files_of_inputs();
    if(is_first) // some of them may be in that folder
      open_files_of_all();
  }

  // But for the mesh.
  bool is_empty() const { return files.empty() && options.output_directory.empty(); }

  // All but the mesh. None of them has its name before commit(). Adds a warning where shapes have no polygon.
  void write(const Shapes& shapes, Run& run)
  {
    const Described_shapes described(cloud.points, shapes);
    if(!options.polygons.empty() && described.areas().number_of_empty_entries() > 0)
      run.warnings.push_back(why_empty(described.areas()));
    for(std::size_t i = 0; i < writers.size(); ++i)
      write_file(i, Results{options, cloud, shapes, described, run});
    if(!options.output_directory.empty())
      for(const Input_part& part : cloud.parts)
        write_part(part, shapes);
  }

  // Gives the files their names.
  void commit()
  {
    for(Output_file& file : files)
      file.commit();
  }

  // The surface may take long, or not be there, and then the others are complete.
  std::optional<Mesh_facts> write_mesh(const Shapes& shapes)
  {
    if(!mesh)
      return std::nullopt;
    const Mesh_facts facts = program::write_mesh(mesh->stream(), cloud.points, shapes, options);
    mesh->close();
    check_signals();
    mesh->commit();
    return facts;
  }

private:
  struct Results {
    const Options& o;
    const Input_cloud& cloud;
    const Shapes& shapes;
    const Described_shapes& described;
    const Run& run;
  };
  using Writer = void (*)(std::ostream&, const Results&);

  void open_files_of_all()
  {
    const Options& o = options;
    open(o.output, [](std::ostream& out, const Results& r) {
      write_cloud(out, r.cloud.points, Point_part(r.cloud.points, 0, r.cloud.points.size()), r.shapes,
                  {output_extension(r.o.output), r.o.colors, r.o.label_property, first_las_frame(r.cloud)});
    });
    open(o.labels, [](std::ostream& out, const Results& r) { write_labels(out, r.shapes); });
    open(o.planes, [](std::ostream& out, const Results& r) { write_planes(out, r.shapes); });
    open(o.shapes, [](std::ostream& out, const Results& r) { write_shape_table(out, r.described.table()); });
    open(o.vg, [](std::ostream& out, const Results& r) {
      write_vg(out, r.cloud.points, r.o.has_group_for_each_plane ? joined_shapes(r.cloud.points, r.shapes) : r.shapes);
    });
    open(o.polygons, [](std::ostream& out, const Results& r) {
      write_polygons(out, r.described,
                     {lower_case_extension(r.o.polygons),
                      r.o.has_triangles_only ? Faces_of_file::triangles : Faces_of_file::polygons, r.o.crs});
    });
    open(o.view, [](std::ostream& out, const Results& r) { write_view(out, r.described, r.run); });
    open(o.report, [](std::ostream& out, const Results& r) { write_report(out, r.shapes, r.run); });
    if(!o.mesh.empty())
      mesh.emplace(o.mesh);
  }

  void open(const std::string& path, Writer writer)
  {
    if(path.empty())
      return;
    files.emplace_back(path);
    writers.push_back(writer);
  }

  // There may be more files than a process can have open: they are opened, and closed again.
  void try_files_of_inputs() const
  {
    for(const Input_part& part : cloud.parts)
      Output_file(output_of(part));
  }

  std::string output_of(const Input_part& part) const
  {
    return output_of_input(options.output_directory, options.inputs[part.input]);
  }

  void write_file(std::size_t i, const Results& results)
  {
    check_signals();
    writers[i](files[i].stream(), results);
    files[i].close();
  }

  void write_part(const Input_part& part, const Shapes& shapes)
  {
    check_signals();
    const std::string path = output_of(part);
    files.emplace_back(path);
    write_cloud(files.back().stream(), cloud.points, Point_part(cloud.points, part.first, part.last), shapes,
                {output_extension(path), options.colors, options.label_property, part.notes.las_frame});
    files.back().close();
  }

  static std::optional<Las_frame> first_las_frame(const Input_cloud& cloud)
  {
    for(const Input_part& part : cloud.parts)
      if(part.notes.las_frame)
        return part.notes.las_frame;
    return std::nullopt;
  }

  const Options& options;
  const Input_cloud& cloud;
  std::deque<Output_file> files; // a file does not move
  std::vector<Writer> writers;   // of the first files
  std::optional<Output_file> mesh;
};

} // namespace program

#endif // DETECT_PLANES_OUTPUT_FILES_H
