// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the command line of detect_planes says.

#ifndef DETECT_PLANES_OPTIONS_H
#define DETECT_PLANES_OPTIONS_H

#include "errors.h"
#include "mesh/footprints.h"

#include <CGAL/Tandem/Parameters.h>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/erase.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/algorithm/string/split.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#ifndef DETECT_PLANES_PARTS // what compiles some of the sources only has none
#define DETECT_PLANES_PARTS ""
#endif

namespace program {

// --- The parts that may be missing in a build. CMake finds out which there are.

constexpr bool has_part(std::string_view name)
{
  return std::string_view(" " DETECT_PLANES_PARTS " ").find(name) != std::string_view::npos;
}

constexpr bool has_tbb = has_part(" tbb "), has_cuda = has_part(" cuda "), has_gzip = has_part(" gzip ");
constexpr bool has_laszip = has_part(" laszip "), has_view = has_part(" view "), has_mpi = has_part(" mpi ");
constexpr bool has_mpi_cuda = has_part(" mpi_cuda ");

// What a program was built with. Its help does not offer what needs the rest.
struct Built_with {
  bool tbb = true, cuda = true, mpi = true, gzip = true, laszip = true, view = true;

  std::vector<std::string> backends() const
  {
    std::vector<std::string> names = {"auto", "sequential"};
    if(tbb)
      names.emplace_back("parallel");
    if(cuda)
      names.emplace_back("cuda");
    return names;
  }
};

// Of this program.
inline Built_with built_with() { return {has_tbb, has_cuda, has_mpi, has_gzip, has_laszip, has_view}; }

// --- The noise of a sensor by the range: the value of --noise.

// The standard deviation at the range r is c[0] + c[1] r + c[2] r^2.
struct Noise_model {
  std::array<double, 3> c = {0, 0, 0};

  // The same with every compiler.
  double operator()(double range) const { return std::fma(range, std::fma(range, c[2], c[1]), c[0]); }
};

// Reads a sum of terms in any order. A term is a product of numbers and powers of r, where the sign of a product may be
// left out: 2.8e-3*r^2, 2.8e-3 r r, r*.0028*r.
class Noise_parser {
public:
  explicit Noise_parser(std::string_view expression) : text(expression), rest(expression) {}

  Noise_model parse()
  {
    Noise_model noise;
    skip("");
    do
      read_term(noise);
    while(!rest.empty());
    if(noise.c == std::array<double, 3>())
      fail("is 0 at every range");
    if(!std::all_of(noise.c.begin(), noise.c.end(), [](double c) { return std::isfinite(c); }))
      fail("has too large a number");
    return noise;
  }

private:
  [[noreturn]] void fail(const std::string& reason) const
  {
    throw_error<Usage_error>("--noise is '", text, "', which ", reason,
                             "; it must be a sum of numbers and powers of the range r, as in 0.001 + 0.0028*r^2");
  }

  [[noreturn]] void fail_where(const char* expected) const
  {
    const std::string_view word = rest.substr(0, rest.find_first_of(" \t+-*")).substr(0, 20);
    fail(rest.empty() ? text_of("ends where ", expected, " is expected")
                      : text_of("has '", word, "' where ", expected, " is expected"));
  }

  bool is_at(std::string_view letters) const { return !rest.empty() && letters.find(rest[0]) != letters.npos; }

  // And the blanks behind it.
  bool skip(std::string_view token)
  {
    if(rest.substr(0, token.size()) != token)
      return false;
    rest.remove_prefix(token.size());
    rest.remove_prefix((std::min)(rest.find_first_not_of(" \t\r\n"), rest.size()));
    return true;
  }

  template <class Number>
  bool read(Number& number)
  {
    const auto end = std::from_chars(rest.data(), rest.data() + rest.size(), number);
    return end.ec == std::errc() && skip(rest.substr(0, std::size_t(end.ptr - rest.data())));
  }

  void read_term(Noise_model& noise)
  {
    double value = 1;
    unsigned power = 0;
    read_factor(value, power);
    while(skip("*") || is_at("rR"))
      read_factor(value, power);
    if(!rest.empty() && !is_at("+-"))
      fail_where("+ or -");
    if(power >= noise.c.size())
      fail("has r^" + std::to_string(power) + ", but the largest power is r^2");
    noise.c[power] += value;
  }

  // May have several signs, as in + -0.001.
  void read_factor(double& value, unsigned& power)
  {
    double number = 0;
    while(is_at("+-"))
      value = skip("-") ? -value : (skip("+"), value);
    if(skip("r") || skip("R"))
      power += read_power();
    else if(is_at("inIN") || !read(number)) // neither inf nor nan
      fail_where("a number or r");
    else
      value *= number;
  }

  unsigned read_power()
  {
    unsigned power = 1;
    if(skip("\u00b2"))
      return 2;
    if((skip("^") || skip("**")) && (!read(power) || power > 100))
      fail("has no power after r^");
    return power;
  }

  std::string_view text, rest;
};

// ---

// The URL of a coordinate reference system, of AUTHORITY:CODE or urn:ogc:def:crs:AUTHORITY:VERSION:CODE. Empty for other
// names.
inline std::string url_of_crs(const std::string& name)
{
  const std::string urls = "https://www.opengis.net/def/crs/";
  if(boost::starts_with(name, urls))
    return name;
  std::vector<std::string> parts;
  boost::split(parts, boost::erase_first_copy(name, "urn:ogc:def:crs:"), boost::is_any_of(":"));
  if(parts.size() == 2)
    parts.insert(parts.begin() + 1, "");
  if(parts.size() != 3 || parts[0].empty() || parts[2].empty())
    return {};
  return urls + parts[0] + '/' + (parts[1].empty() ? "0" : parts[1]) + '/' + parts[2];
}

// Of estimate_normals: no PCA of a given number of neighbors. Nobody gives that number.
constexpr long long by_library = std::numeric_limits<long long>::min();

constexpr long long fewest_mesh_planes = 4; // that enclose something

// Of the planes that are selected by their normals.
struct Direction_choice {
  enum Of { direction, vertical, horizontal } of = direction;
  std::array<double, 3> normal = {0, 0, 0}; // of `direction`
  std::optional<double> degrees;            // between it and the normals
  std::string text;                         // of the command line
};

// What was not given is left to the library.
struct Options {
  std::vector<std::string> inputs;
  std::string output, output_directory, labels, planes, report, vg, polygons, lines, shapes, mesh, view;
  std::string planes_from;                              // a file
  std::vector<CGAL::Tandem::Coefficients> known_planes; // of it
  std::string footprint;                                // a file of --mesh
  Footprints footprints;                                // of it
  std::string crs;                                      // of --polygons, --lines and --mesh
  std::string columns, classes, format, crop;           // of the inputs
  std::string tolerance_column, noise_text;             // of the tolerance of each point
  std::optional<Noise_model> noise;
  std::string colors;                   // of the output: shape, input or empty
  std::string label_property = "shape"; // of the output
  std::optional<double> maximum_distance, maximum_angle, angle_tolerance, maximum_offset, simplicity, regularity,
    surfel_size, mesh_seconds;
  std::optional<long long> mesh_components, mesh_planes, minimum_region_size, k_neighbors, cell_size, threads,
    estimate_normals, sample;
  bool regularize_parallelism = true, regularize_orthogonality = true, regularize_coplanarity = true;
  std::vector<std::array<double, 3>> fixed_directions;
  std::optional<std::array<double, 3>> symmetry_direction, viewpoint;
  std::optional<std::array<double, 3>> up; // where it is not given, from the detection on
  std::optional<long long> largest;        // shapes that are selected
  std::optional<double> minimum_area, minimum_extent, minimum_width;
  bool is_flat_only = false;              // no facets of curved surfaces
  std::vector<std::string> shape_classes; // of the shapes that are selected; all, if there is none
  std::optional<Direction_choice> near_direction;
  std::string backend = "auto";
  bool has_local_distances = false; // of --maximum-distance auto-local, or of auto where the noise varies
  double estimated_distance = 0;    // of auto
  std::string estimate_note;        // what is said of it
  bool ignores_zeros = false, has_decimal_commas = false;
  std::optional<double> base_height;
  bool is_base_ground = false;
  bool is_upright = false;  // walls and floors become so
  bool is_by_plane = false; // coplanar shapes are one
  bool has_group_for_each_plane = false, has_triangles_only = false, is_oriented = false, is_quiet = false;
  bool wants_help = false, wants_version = false;
};

} // namespace program

#endif // DETECT_PLANES_OPTIONS_H
