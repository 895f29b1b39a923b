// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What several outputs tell of the shapes, and what writes the larger outputs.

#ifndef DETECT_PLANES_WRITERS_H
#define DETECT_PLANES_WRITERS_H

#include "Options.h"
#include "input/read_cloud.h"
#include "output/report.h"

#include <CGAL/Shape_regularization_tandem/polygons.h>

#include <memory>

namespace program {

// --- The areas that the points of the shapes cover, an entry for each shape; and coplanar shapes as one.

using Shape_areas = CGAL::Tandem::Shape_polygons_3<Kernel>;

// One shape for each plane.
Shapes joined_shapes(const Point_set& points, const Shapes& shapes);

// Of the entries without polygons: a sentence.
inline std::string why_empty(const Shape_areas& areas)
{
  const std::size_t n = areas.number_of_empty_entries();
  return sentence(n, " of ", areas.number_of_entries(), " shapes ", n == 1 ? "has" : "have",
                  " too few points for an outline: ", n == 1 ? "it has" : "they have", " neither polygons nor lines");
}

// Those of the shapes that are no veils. The points have the places from which they were seen.
Shapes without_veils(const Shapes& shapes, const Point_set& points);

// Those of the shapes that fit: of the points of this rank and others, the same on all ranks.
Shapes selected_shapes(const Shapes& shapes, const Point_set& points, const Options& o);

// The shapes of a cloud, both of which outlive it, with what several outputs tell of them. Areas and table are made when
// they are asked for first.
class Described_shapes {
public:
  // all: of which the shapes were selected, or nothing
  Described_shapes(const Point_set& points, const Shapes& shapes, const std::array<double, 3>& up,
                   const Shapes* all = nullptr)
    : points(points), shapes(shapes), up(up), all(all)
  {}

  const Shape_areas& areas() const;

  // With a row for each shape: that of --shapes, which the page of --view has, too. A list for each column: a number or
  // a word for each shape, null or not a number if it has none. Neighbors that are not selected count, too.
  const Json& table() const;

  // The area of all shapes, and how much of it is curved; null where no other output has made the table, which may take
  // longer than the detection.
  Json surface() const;

  const Point_set& points;
  const Shapes& shapes;
  const std::array<double, 3> up; // the direction upward

private:
  const Shapes* all;
  mutable std::optional<Shape_areas> areas_;
  mutable std::optional<Json> table_;
};

// As CSV, with a line of names, and the number of the shape in front.
void write_shape_table(std::ostream& out, const Json& table);

// --- Text formats of faces, for polygons and closed surfaces.

// The coordinates, with a text before each point.
template <class Points>
void write_vertices(std::ostream& out, const Points& points, const char* before)
{
  out << std::setprecision(17);
  for(const Kernel::Point_3& p : points)
    out << before << p << '\n';
}

// Positions of points, each with a blank before it; the formats count from `first` on.
template <class Corners>
std::ostream& write_corners(std::ostream& out, const Corners& corners, int first)
{
  for(std::size_t corner : corners)
    out << ' ' << corner + std::size_t(first);
  return out;
}

// Of a collection of features: "features": [ comes last.
inline void begin_geojson(std::ostream& out, const Options& o)
{
  out << R"({"type": "FeatureCollection", )";
  if(!o.crs.empty())
    out << R"("crs": {"type": "name", "properties": {"name": )" << ascii(Json(utf8(o.crs))) << "}}, ";
  out << R"("features": [)";
}

// --- A cloud.

using Input_parts = CGAL::Iterator_range<std::vector<Input_part>::const_iterator>;

// The records that an output of this format gets: all parts have such ones, of one layout. Else null.
inline const Input_records* common_records(const Input_parts& parts, const std::string& extension)
{
  const Input_records* common = nullptr;
  for(const Input_part& part : parts) {
    if(part.first == part.last && parts.size() > 1)
      continue;
    const Input_records* const own = part.notes.records.get();
    if(own == nullptr || !is_same_format(own->format, extension) ||
       (common != nullptr && (own->is_whole || common->is_whole || own->layout != common->layout)))
      return nullptr;
    common = common != nullptr ? common : own;
  }
  return common;
}

// Parts of the cloud with the result, as the formats of --output get them.
class Output_points {
public:
  // The parts follow each other. extension: of the format.
  Output_points(const Point_set& points, const Input_parts& parts, const Shapes& shapes, const std::string& extension,
                const Options& o)
    : points(points), parts(parts), part(part_of(points, parts.begin()->first, std::prev(parts.end())->last)),
      shapes(shapes), label_property(o.label_property), has_shape_colors(o.colors == "shape"),
      records(common_records(parts, extension)), intensity(find_property<float>(points, intensity_name)),
      classification(find_property<std::uint8_t>(points, classification_name))
  {
    if(o.tolerance_column.empty() || records == nullptr)
      tolerance = find_property<double>(points, tolerance_name);
    if(has_shape_colors)
      return;
    colors = find_property<Input_color>(points, color_name);
    has_narrow_colors =
      colors && std::all_of(part.begin(), part.end(), [&](Point_set::Index i) {
        return std::all_of((*colors)[i].begin(), (*colors)[i].end(), [](std::uint16_t c) { return c <= 255; });
      });
  }

  // f(point, record): of each point, with an empty record where there are none.
  template <class F>
  void for_each(const F& f) const
  {
    for(const Input_part& p : parts)
      for(std::size_t i = p.first; i < p.last; ++i)
        f(*(points.begin() + std::ptrdiff_t(i)),
          records != nullptr ? (*p.notes.records)[i - p.first] : std::string_view());
  }

  std::array<double, 6> place_and_normal(Point_set::Index i) const
  {
    const Kernel::Point_3& p = points.point(i);
    const Kernel::Vector_3 n = normal_used(points, shapes, i);
    return {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()};
  }

  std::int32_t shape(Point_set::Index i) const { return shapes.shape_index(i); }

  bool has_input_colors() const { return colors.has_value(); }

  // Of 16 bits, as the input has it.
  Input_color wide_color(Point_set::Index i) const
  {
    if(colors)
      return (*colors)[i];
    const Color narrow = color_of_shape(shape(i));
    return {std::uint16_t(257 * narrow[0]), std::uint16_t(257 * narrow[1]), std::uint16_t(257 * narrow[2])};
  }

  Color color(Point_set::Index i) const
  {
    if(!colors)
      return color_of_shape(shape(i));
    const Input_color& wide = (*colors)[i];
    const int shift = has_narrow_colors ? 0 : 8;
    return {std::uint8_t(wide[0] >> shift), std::uint8_t(wide[1] >> shift), std::uint8_t(wide[2] >> shift)};
  }

  const Point_set& points;
  const Input_parts parts;
  const Point_part part; // all of them
  const Shapes& shapes;
  const std::string label_property; // the name of the shape of a point
  const bool has_shape_colors;      // in place of those of the input
  const Input_records* records;     // of the first part with points, or null where the output has none
  std::optional<Point_set::Property_map<float>> intensity;
  std::optional<Point_set::Property_map<std::uint8_t>> classification;
  std::optional<Point_set::Property_map<double>> tolerance; // where points have their own that records do not have

private:
  std::optional<Point_set::Property_map<Input_color>> colors; // of the input
  bool has_narrow_colors = false;                             // 8 bits in the lower half of 16
};

// LAS with the shape as extra bytes: the records of the input with all that is around them, or LAS 1.4. Coordinates of
// the latter are rounded to the grid of the input, or to one that is fine for the distances within shapes. Points that
// are not finite are left out.
void write_las(std::ostream& out, const Output_points& cloud);

// Writes to the header where the records behind the points begin.
void set_tail(std::string& header, std::uint64_t first, const Input_records* records);

// The same, compressed by LASzip.
void write_laz(std::ostream& out, const Output_points& cloud);

// --- A closed surface made of the planes of the shapes.

struct Mesh; // of mesh/Mesh.h

// Throws an error that says why where there is none.
std::shared_ptr<const Mesh> make_mesh(const Described_shapes& shapes, const Options& o,
                                      const CGAL::Tandem::Callback& show);

// What the summary says of it.
std::string text_of_mesh(const Mesh& mesh, const Shapes& shapes, const Options& o);

// The format is that of the extension of --mesh: .off, .obj, .ply or .city.json.
void write_mesh(std::ostream& out, const Mesh& mesh, const Options& o);

// ---

// The cloud with the shape of each point.
void write_cloud(std::ostream& out, const Output_points& cloud, const std::string& extension);

// The polygons of the shapes: binary PLY with the shape of each face, OBJ with a group for each shape, OFF with the color
// of the shape, or GeoJSON with a feature for each shape. A vertex that several shapes have is in PLY, OBJ and OFF once.
// Their faces have no holes: polygons with holes are triangles there.
void write_polygons(std::ostream& out, const Described_shapes& shapes, const Options& o);

// The lines at which the shapes meet, and their corners: GeoJSON with a feature for each, DXF or OBJ.
void write_lines(std::ostream& out, const Described_shapes& shapes, const Run& run, const Options& o);

// Vertex groups as text (.vg): the points, their normals, and a group of positions for each shape, as PolyFit, Easy3D and
// programs for kinetic reconstruction read them.
void write_vg(std::ostream& out, const Point_set& points, const Shapes& shapes);

// The page that shows a result in three dimensions: one file, which a browser opens from the disk. three.js and the page
// around the data are parts of the program.
void write_view(std::ostream& out, const Described_shapes& shapes, const Run& run);

// The page that write_view() has written, and the mesh.
void write_view_with_mesh(std::ostream& out, std::istream& page, const Described_shapes& shapes, const Mesh& mesh);

} // namespace program

#endif // DETECT_PLANES_WRITERS_H
