// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Detects the planes of a point cloud file. detect_planes --help explains the options.
// Exit code 0: success; 1: the data or the machine; 2: the command line.

#include "detection.h"
#include "output/Output_file.h"
#include "program_options.h"
#include "ranks/read_inputs.h"

#include <CGAL/Shape_regularization_tandem/cuda.h>
#include <CGAL/Shape_regularization_tandem/version.h>

#include <cmath>
#include <deque>
#include <fstream>

namespace program {

// --- The selection: all shapes, or one for each plane, and of those the ones that fit its options.

// The options that say which shapes the outputs have.
inline std::string selection_of(const Options& o)
{
  std::ostringstream text;
  const auto add = [&text](const char* option, const auto& value) {
    if(value)
      write_shortest(text << option << ' ', *value, ' ');
  };
  text << (o.is_by_plane ? "--by-plane " : "");
  add("--largest", o.largest);
  add("--minimum-area", o.minimum_area);
  add("--minimum-extent", o.minimum_extent);
  add("--minimum-width", o.minimum_width);
  text << (o.is_flat_only ? "--flat-only " : "");
  text << (o.shape_classes.empty() ? "" : "--class " + boost::join(o.shape_classes, ",") + ' ');
  if(o.near_direction)
    text << "--near-direction " << o.near_direction->text << ' ';
  return text.str().substr(0, (std::max)(text.str().size(), std::size_t(1)) - 1);
}

// Notes in the run how many there were; a warning where none is left. Returns the shapes of which some were selected, or
// nothing.
inline std::optional<Shapes> select(const Point_set& points, const Options& o, Run& run, Shapes& shapes,
                                    std::vector<std::string>& warnings)
{
  run.selection = selection_of(o);
  if(run.selection.empty())
    return std::nullopt;
  run.detected_shapes = shapes.number_of_shapes();
  run.detected_points = shapes.statistics().number_of_assigned_points;
  if(o.is_by_plane)
    shapes = joined_shapes(points, shapes);
  std::optional<Shapes> all = shapes;
  shapes = selected_shapes(shapes, points, o);
  if(shapes.number_of_shapes() == 0 && run.detected_shapes > 0)
    warnings.push_back(
      sentence("none of the ", run.detected_shapes, " shapes fits ", run.selection, ": the outputs have no shapes"));
  if(shapes.number_of_shapes() == all->number_of_shapes())
    all.reset();
  return all;
}

// --- Veils, whose points become free.

// Notes in the run how many there were. Known planes stay.
inline void dissolve_veils(const Point_set& points, const Options& o, Run& run, Shapes& shapes)
{
  if(!o.known_planes.empty())
    return;
  Shapes kept = without_veils(shapes, points);
  run.veils = shapes.number_of_shapes() - kept.number_of_shapes();
  run.veil_points = shapes.statistics().number_of_assigned_points - kept.statistics().number_of_assigned_points;
  shapes = std::move(kept);
}

// --- The outward sides of planes and of estimated normals. Given normals have a side; estimated ones get that of the place
// from which their points were seen.

// All ranks call the same members in the same order.
class Outward_sides {
public:
  // After the normals were prepared.
  Outward_sides(const Options& o, Input_cloud& cloud, Processes& processes, Run& run)
    : options(o), points(cloud.points), processes(processes), are_given(run.normals == "given")
  {
    for(const Input_part& part : cloud.parts)
      for(const View& view : views_of(o, part, o.is_oriented))
        if(!are_given)
          views.push_back(view);
    is_seen = processes.largest(double(views.size())) > 0;
    run.has_outward_sides = are_given || is_seen;
    if(is_seen && run.normals != "none")
      run.normals += ", towards the viewpoint";
  }

  // What there is to say of --oriented, or nothing.
  const char* warning() const
  {
    return options.is_oriented && !are_given && !is_seen ? "--oriented: planes have no outward side, because the input "
                                                           "has neither normals nor a viewpoint (pass --viewpoint)"
                                                         : "";
  }

  // The shapes that the files get; the cloud gets the normals, if some file has them. The detection knows nothing of
  // sides, so its shapes, their hash and the mesh stay as they are.
  const Shapes& operator()(const Shapes& shapes)
  {
    const bool has_oriented_planes = options.is_oriented && (are_given || is_seen);
    if(!is_seen && !has_oriented_planes)
      return shapes;
    std::vector<long long> votes;
    processes.together([&] { votes = votes_of(shapes); });
    votes = processes.sums(votes);
    processes.together([&] {
      Shapes::Data data = shapes.data();
      data.points = shapes.point_groups();
      for(std::size_t s = 0; s < votes.size() && is_seen; ++s)
        data.is_flipped[s] = votes[s] < 0;
      for(std::size_t s = 0; s < data.coefficients.size() && has_oriented_planes; ++s)
        if(std::exchange(data.is_flipped[s], char(0)) != 0)
          for(double& x : data.coefficients[s])
            x = 0. - x; // no -0
      turned.emplace(std::move(data));
      if(is_seen)
        turn_normals(shapes);
    });
    return *turned;
  }

private:
  // How many more of the own points of each shape were seen from the side of its normal than from the other one. The
  // normal of the plane tells that better than those of the points, where they were seen at a small angle.
  std::vector<long long> votes_of(const Shapes& shapes) const
  {
    std::vector<long long> votes(shapes.number_of_shapes(), 0);
    for(const View& view : views)
      for(Point_set::Index i : part_of(points, view.first, view.last))
        if(const int s = shapes.shape_index(i); s >= 0) {
          const auto& c = shapes.coefficients(std::size_t(s));
          const double height = Kernel::Vector_3(c[0], c[1], c[2]) * (view.from - points.point(i));
          votes[std::size_t(s)] += height > 0 ? 1 : height < 0 ? -1 : 0;
        }
    return votes;
  }

  void turn_normals(const Shapes& shapes)
  {
    if(options.output.empty() && options.output_directory.empty() && options.vg.empty())
      return;
    if(!points.has_normal_map() && !shapes.has_estimated_normals())
      return;
    if(!points.has_normal_map()) {
      points.add_normal_map();
      for(Point_set::Index i : points)
        points.normal(i) = shapes.estimated_normal(i);
    }
    for(const View& view : views)
      for(Point_set::Index i : part_of(points, view.first, view.last))
        if(Kernel::Vector_3& n = points.normal(i); n * (view.from - points.point(i)) < 0)
          n = Kernel::Vector_3(0. - n.x(), 0. - n.y(), 0. - n.z());
  }

  const Options& options;
  Point_set& points;
  Processes& processes;
  bool are_given;          // the normals
  std::vector<View> views; // of the own inputs
  bool is_seen = false;    // some input of any rank has a viewpoint
  std::optional<Shapes> turned;
};

// --- The files.

// The files to be written, opened before the work starts, so that a bad name costs no time. What one process writes for
// all is written by the first one, the file of an input by the one that has read it.
class Output_files {
public:
  // Before this, --output-directory has been made.
  Output_files(const Options& o, const Input_cloud& cloud, bool is_first) : options(o), cloud(cloud)
  {
    // There may be more files than a process can have open: they are opened, and closed again.
    for(std::size_t i = 0; i < cloud.parts.size() && !o.output_directory.empty(); ++i)
      Output_file(output_of(cloud.parts[i]));
    if(is_first) // some of them may be in that folder
      open_files_of_all();
    if(!o.output_directory.empty())
      written.push_back("one for each input in " + o.output_directory);
  }

  bool has_mesh() const { return mesh.has_value(); }

  // But for the mesh.
  bool is_empty() const { return files.empty() && options.output_directory.empty(); }

  // Of those that were written, when all are.
  std::string names() const { return boost::join(written, ", "); }

  // All but the mesh. None of them has its name before commit(). Adds a warning where shapes have no polygon.
  void write(const Described_shapes& described, Run& run)
  {
    const Shapes& shapes = described.shapes;
    if(!(options.polygons.empty() && options.lines.empty()) && described.areas().number_of_empty_entries() > 0)
      run.warnings.push_back(why_empty(described.areas()));
    if(!options.output.empty() && leaves_out_fields())
      run.warnings.push_back(options.output + ": the points of the inputs do not have the same format and fields; the "
                                              "output has coordinates, colors, intensity and classification "
                                              "(--output-directory keeps the fields of each input)");
    if(const std::size_t count = las_leaves_out(); count > 0)
      run.warnings.push_back(
        text_of("points that are not finite, which LAS cannot have, are not in the output: ", count));
    for(std::size_t i = 0; i < writers.size(); ++i) {
      check_signals();
      files[i].write([&](std::ostream& out) { writers[i](out, described, run); });
    }
    for(auto part = cloud.parts.begin(); part != cloud.parts.end() && !options.output_directory.empty(); ++part) {
      check_signals();
      files.emplace_back(output_of(*part));
      files.back().write([&](std::ostream& out) { write_points(out, output_of(*part), {part, part + 1}, shapes); });
    }
  }

  // Gives the files their names.
  void commit()
  {
    for(Output_file& file : files)
      file.commit();
  }

  // The surface may take long, or not be there, and then the others are complete. Returns what it is.
  std::string write_mesh(const Described_shapes& described, const CGAL::Tandem::Callback& show)
  {
    const std::shared_ptr<const Mesh> made = make_mesh(described, options, show);
    mesh->write([&](std::ostream& out) { program::write_mesh(out, *made, options); });
    mesh->commit();
    written.push_back(options.mesh);
    std::error_code error;
    if(std::filesystem::is_regular_file(options.view, error)) // else it is nowhere to be read again
      if(Output_file view(options.view); view.replaces_file()) {
        std::ifstream page(options.view, std::ios::binary);
        view.write([&](std::ostream& out) { write_view_with_mesh(out, page, described, *made); });
        view.commit();
      }
    return text_of_mesh(*made, described.shapes, options);
  }

private:
  using Writer = std::function<void(std::ostream&, const Described_shapes&, const Run&)>;

  void open_files_of_all()
  {
    const Options& o = options;
    open(o.output, [this](std::ostream& out, const Described_shapes& d, const Run&) {
      write_points(out, options.output, {cloud.parts.begin(), cloud.parts.end()}, d.shapes);
    });
    open(o.labels, [](std::ostream& out, const Described_shapes& d, const Run&) {
      for(std::int32_t shape : d.shapes.shape_indices())
        write_binary(out, shape);
    });
    open(o.planes, [](std::ostream& out, const Described_shapes& d, const Run&) {
      out << std::setprecision(17);
      for(const auto& c : d.shapes.data().coefficients)
        out << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3] << '\n';
    });
    open(o.shapes, [](std::ostream& out, const Described_shapes& d, const Run&) { write_shape_table(out, d.table()); });
    open(o.vg, [this](std::ostream& out, const Described_shapes& d, const Run&) {
      write_vg(out, d.points, options.has_group_for_each_plane ? joined_shapes(d.points, d.shapes) : d.shapes);
    });
    open(o.polygons,
         [this](std::ostream& out, const Described_shapes& d, const Run&) { write_polygons(out, d, options); });
    open(o.lines,
         [this](std::ostream& out, const Described_shapes& d, const Run& run) { write_lines(out, d, run, options); });
    open(o.view, &write_view);
    open(o.report, [](std::ostream& out, const Described_shapes& d, const Run& run) {
      write_report(out, d.shapes, run, d.surface());
    });
    if(!o.mesh.empty())
      mesh.emplace(o.mesh);
  }

  void open(const std::string& path, const Writer& writer)
  {
    if(path.empty())
      return;
    files.emplace_back(path);
    writers.push_back(writer);
    written.push_back(path);
  }

  std::string output_of(const Input_part& part) const
  {
    return output_of_input(options.output_directory, options.inputs[part.input]);
  }

  void write_points(std::ostream& out, const std::string& path, const Input_parts& parts, const Shapes& shapes) const
  {
    const std::string extension = output_extension(path);
    write_cloud(out, {cloud.points, parts, shapes, extension, options}, extension);
  }

  // The number of points that are not in an output.
  std::size_t las_leaves_out() const
  {
    const auto is_left_out = [this](Point_set::Index i) { return !is_finite(cloud.points.point(i)); };
    return !is_las(output_extension(options.output))
             ? 0
             : std::size_t(std::count_if(cloud.points.begin(), cloud.points.end(), is_left_out));
  }

  // Whether fields of an input in the format of --output are not in it.
  bool leaves_out_fields() const
  {
    const std::string extension = output_extension(options.output);
    return common_records({cloud.parts.begin(), cloud.parts.end()}, extension) == nullptr &&
           std::any_of(cloud.parts.begin(), cloud.parts.end(), [&](const Input_part& part) {
             const auto& records = part.notes.records;
             return records && records->has_others && is_same_format(records->format, extension);
           });
  }

  const Options& options;
  const Input_cloud& cloud;
  std::deque<Output_file> files; // a file does not move
  std::vector<Writer> writers;   // of the first files
  std::vector<std::string> written;
  std::optional<Output_file> mesh;
};

// What Planar_shapes_3::hash() is for the points of all ranks, in the order of the inputs: from file to file, the rank
// that has it goes on.
std::uint64_t hash_of_all(const Shapes& shapes, const std::vector<Input_part>& parts,
                          const std::vector<int>& rank_of_input, const Processes& processes)
{
  std::uint64_t hash = Shapes::hash(std::vector<std::int32_t>(), {});
  // A table of the own points, or an empty one.
  const auto add = [&](const auto& table) {
    auto part = parts.begin();
    for(std::size_t input = 0; input < rank_of_input.size(); ++input) {
      if(part != parts.end() && part->input == input) {
        for(std::size_t i = part->first; i < (std::min)(part->last, std::size_t(table.size())); ++i)
          Shapes::add_to_hash(hash, std::uint32_t(table[i]));
        ++part;
      }
      hash = processes.number_of(rank_of_input[input], hash);
    }
  };
  add(shapes.data().shape_of);
  Shapes::add_to_hash(hash, shapes.data().coefficients);
  add(shapes.data().normal);
  return hash;
}

// ---

// rest: for the message, if that fails.
void print(const std::string& text, const char* rest)
{
  errno = 0;
  if(!(std::cout << text << std::flush))
    throw_error("standard output cannot be written", reason_of(errno), rest);
}

// What is to be said of the outlines is said when the line of progress is gone.
void write_files(Output_files& files, const Described_shapes& shapes, const Options& o, bool is_first, Run& run)
{
  const std::size_t said = run.warnings.size();
  {
    const Progress_line progress(!o.is_quiet && is_first, "writing");
    files.write(shapes, run);
  }
  for(std::size_t i = said; i < run.warnings.size(); ++i)
    warn(run.warnings[i]);
}

// Whether there is a surface is not known before. If there is none, the others are complete. Returns why there is none.
std::string write_mesh(Output_files& files, const Described_shapes& shapes, const Options& o, Run& run)
try {
  Progress_line progress(!o.is_quiet && !o.mesh.empty(), "making the mesh");
  const auto show = [&progress](double fraction) {
    progress.show(fraction);
    return true;
  };
  if(files.has_mesh())
    run.mesh = files.write_mesh(shapes, show);
  return {};
} catch(const std::bad_alloc&) {
  return "--mesh: not enough memory";
} catch(const std::exception& e) {
  return e.what();
}

// The mesh and the summary, when all other files are complete.
void finish(Output_files& files, const Described_shapes& shapes, const Options& o, Processes& processes, Run& run)
{
  const std::string failure = write_mesh(files, shapes, o, run);
  run.files = files.names();
  const char* rest = files.is_empty() ? "" : "; the other files are complete";
  if(failure.empty() && !(files.is_empty() && o.mesh.empty()))
    rest = "; the files are complete";
  processes.together([&] {
    if(!o.is_quiet && processes.is_first())
      print(summary(shapes.shapes, run), rest);
    if(!failure.empty())
      throw_error(failure, rest);
  });
}

void run(Options o, Processes& processes, Made_folders& folders)
{
  processes.together([&] {
    check_program(o, processes);
    read_known_planes(o);
    if(!o.footprint.empty())
      o.footprints = read_footprints(o.footprint);
  });
  const Thread_limit limit(o.threads ? int(*o.threads) : processes.threads());
  Run run;
  run.processes = processes.size();
  Input_cloud cloud;
  const std::vector<int> rank_of_input = read_inputs(o, processes, cloud, run);
  Hidden_points hidden(o, cloud.points, processes, run);
  std::optional<Output_files> files;
  // The first rank makes it, so that none has to remove it before another one; the others do where they do not see it.
  for(bool is_turn_of_first : {true, false})
    processes.together([&] {
      if(!o.output_directory.empty() && processes.is_first() == is_turn_of_first)
        folders.make(o.output_directory);
    });
  processes.together([&] {
    files.emplace(o, cloud, processes.is_first());
    prepare_normals(cloud.points, o, run);
  });
  processes.together([&] { choose_tolerances(cloud.points, processes, o); });
  processes.together([&] { prepare_tolerances(o, cloud); });
  Outward_sides sides(o, cloud, processes, run);
  const bool are_seen = !processes.are_many() && note_viewpoints(o, processes, cloud);

  std::optional<Shapes> shapes;
  processes.together([&] {
    shapes.emplace(detect_upward(cloud.points, o, processes, run));
    if(are_seen)
      dissolve_veils(cloud.points, o, run, *shapes);
  });
  // What the back end that was chosen in the end ran on.
  const std::string& backend = shapes->statistics().backend;
  run.device = backend == "cuda" ? CGAL::Tandem::cuda_device_report() : "CPU";
  run.threads = backend == "parallel" ? limit.threads() : 1;
  run.tolerance = tolerance_facts(cloud.points, o, *shapes, processes);
  std::vector<std::string> warnings = all_warnings(cloud.points, *shapes, o, processes, run);
  warnings.emplace_back(sides.warning());
  std::optional<Shapes> all; // before the selection
  processes.together([&] { all = select(cloud.points, o, run, *shapes, warnings); });
  run.hash = processes.are_many() ? hash_of_all(*shapes, cloud.parts, rank_of_input, processes) : shapes->hash();
  run.peak_bytes = std::size_t(processes.largest(double(peak_process_bytes())));
  add_warnings(warnings, processes.is_first(), run);
  hidden.show();
  const Described_shapes described(cloud.points, sides(*shapes), *o.up, all ? &*all : nullptr);
  processes.together([&] { write_files(*files, described, o, processes.is_first(), run); });
  processes.together([&] {
    first_signal_removes = 0; // from here on, all files get their names
    check_signals();
  });
  processes.together([&] {
    files->commit();
    folders.keep();
    end_at_signal();
    if(is_interrupted())
      throw_error("interrupted; the files are complete");
  });
  finish(*files, described, o, processes, run);
}

void run_command_line(int argc, const char* const argv[], Processes& processes, Made_folders& folders)
{
  Command_line command_line;
  std::string all;
  for(int i = 1; i < argc; ++i)
    all += std::string(argv[i]) + '\n';
  processes.check_same(all, "command lines");
  processes.together([&] { command_line = parse(argc, argv, built_with()); });
  const Options& o = command_line.options;
  if(!o.wants_help && !o.wants_version)
    return run(o, processes, folders);
  processes.together([&] {
    if(processes.is_first())
      print(o.wants_help ? command_line.help : "detect_planes (Tandem) " + std::string(CGAL_TANDEM_VERSION) + "\n", "");
  });
}

// If the processes that were started cannot work together, the first one says so.
int main_of_rank(int argc, char* argv[])
{
  Made_folders folders; // they are removed last, after the files of all ranks
  std::unique_ptr<Processes> processes;
  try {
    processes = make_processes(argc, argv);
  } catch(const std::exception& e) {
    return find_launch().rank == 0 ? fail(1, e.what()) : 0;
  }
  try {
    run_command_line(argc, argv, *processes, folders);
    return 0;
  } catch(const Usage_error& e) {
    return processes->end(2, e.what(), " (detect_planes --help lists the options)");
  } catch(const std::bad_alloc&) {
    return processes->end(1, "not enough memory");
  } catch(const std::exception& e) {
    return processes->end(1, e.what());
  }
}

} // namespace program

int main(int argc, char* argv[])
{
  program::catch_signals();
  return program::main_of_rank(argc, argv);
}
