// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The class tandem.PlanarShapes.

#ifndef TANDEM_PYTHON_RESULT_H
#define TANDEM_PYTHON_RESULT_H

#include "../shape_columns.h"
#include "detection.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace tandem_python {

namespace py = pybind11;
using namespace py::literals;

using Rows = py::array_t<double, py::array::c_style>;

// What the shapes were detected with. Normals and tolerances are arrays that nobody else has, the points may be those of
// the caller.
struct Given {
  std::optional<Rows> normals, tolerances;
  std::size_t zeros = 0;                     // points at 0 0 0, which had no coordinates
  std::optional<Rows> points = std::nullopt; // of a result
};

class Result {
public:
  Result(Shapes shapes, Given given) : shapes_(std::move(shapes)), given_(std::move(given)) {}

  const Shapes& shapes() const { return shapes_; }
  std::size_t size() const { return shapes_.number_of_shapes(); }
  const Given& given() const { return given_; }

  // Estimated normals are unpacked once, where they are asked for.
  const Rows& normals()
  {
    if(given_.normals)
      return *given_.normals;
    if(!estimated_normals_) {
      const std::size_t points = shapes_.number_of_points();
      estimated_normals_.emplace(std::vector<py::ssize_t>{py::ssize_t(points), 3});
      double* to = estimated_normals_->mutable_data();
      for(std::size_t i = 0; i < points; ++i) {
        const Kernel::Vector_3 normal = shapes_.estimated_normal(i);
        to = std::copy_n(normal.cartesian_begin(), 3, to);
      }
    }
    return *estimated_normals_;
  }

private:
  Shapes shapes_;
  Given given_;
  std::optional<Rows> estimated_normals_;
};

// An array on memory of the object `owner`, which lives as long as the array; of rows, if there are columns.
template <class As, class Item>
py::array array_on(const py::object& owner, const Item* data, std::size_t items, py::ssize_t columns = 0)
{
  static_assert(sizeof(Item) % sizeof(As) == 0, "the array has the same memory");
  const auto size = py::ssize_t(items * (sizeof(Item) / sizeof(As)));
  const std::vector<py::ssize_t> shape =
    columns > 0 ? std::vector<py::ssize_t>{size / columns, columns} : std::vector<py::ssize_t>{size};
  return py::array(py::dtype::of<As>(), shape, data, owner);
}

// To be read only.
template <class As, class Item>
py::array view(const py::object& owner, const Item* data, std::size_t items, py::ssize_t columns = 0)
{
  py::array array = array_on<As>(owner, data, items, columns);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

// Takes the memory of a table of numbers or points.
template <class Item>
py::array taken(std::vector<Item>& table, py::ssize_t columns = 0)
{
  using Number = std::conditional_t<std::is_integral_v<Item>, Item, double>;
  auto kept = std::make_unique<std::vector<Item>>(std::move(table));
  const py::capsule owner(kept.get(), [](void* items) { delete static_cast<std::vector<Item>*>(items); });
  const std::vector<Item>& items = *kept.release();
  return array_on<Number>(owner, items.data(), items.size(), columns);
}

// A property that is a view of a table.
template <class As, class Table, class Data>
auto getter(Table Data::*member, py::ssize_t columns = 0)
{
  return [member, columns](const py::object& self) {
    const Table& table = self.cast<const Result&>().shapes().data().*member;
    return view<As>(self, table.data(), table.size(), columns);
  };
}

inline py::array normals(const py::object& self)
{
  const Rows& rows = self.cast<Result&>().normals();
  return view<double>(self, rows.data(), std::size_t(rows.size()), 3);
}

// As a list of Python: negative numbers count from the end, and those that are too large are an IndexError, too.
inline py::array points_of(const py::object& self, const py::object& index)
{
  const py::ssize_t shape = PyNumber_AsSsize_t(index.ptr(), PyExc_IndexError);
  if(shape == -1 && PyErr_Occurred() != nullptr)
    throw py::error_already_set();
  const Result& result = self.cast<const Result&>();
  const auto n = py::ssize_t(result.size());
  if(shape < -n || shape >= n)
    throw py::index_error("shape is " + std::to_string(shape) + ", but there are " + std::to_string(n) + " shapes");
  const Shapes::Positions points = result.shapes().points(std::size_t(shape < 0 ? shape + n : shape));
  return view<std::uint32_t>(self, points.begin(), points.size());
}

// values(u): so many numbers of each shape, as an array of rows.
template <class Values>
py::array_t<double> columns_of(const Result& result, std::vector<py::ssize_t> row, Values values)
{
  row.insert(row.begin(), py::ssize_t(result.size()));
  py::array_t<double> array(row);
  double* to = array.mutable_data();
  for(const CGAL::Tandem::Plane_uncertainty& u : result.shapes().data().uncertainty)
    for(const double x : values(u))
      *to++ = x;
  return array;
}

inline py::dict uncertainties(const Result& result)
{
  using Uncertainty = CGAL::Tandem::Plane_uncertainty;
  const auto numbers = [&](double Uncertainty::*member) {
    return columns_of(result, {}, [&](const Uncertainty& u) { return std::array<double, 1>{u.*member}; });
  };
  return py::dict("centroid"_a = columns_of(result, {3}, [](const Uncertainty& u) { return u.centroid; }),
                  "noise"_a = numbers(&Uncertainty::noise),
                  "normal_covariance"_a = columns_of(result, {3, 3},
                                                     [](const Uncertainty& u) {
                                                       const auto& c = u.normal_covariance;
                                                       return std::array<double, 9>{c[0], c[1], c[2], c[1], c[3],
                                                                                    c[4], c[2], c[4], c[5]};
                                                     }),
                  "offset_deviation"_a = numbers(&Uncertainty::offset_deviation),
                  "angle_deg"_a = numbers(&Uncertainty::angle_deg));
}

inline py::dict times(const CGAL::Tandem::Stage_times& t)
{
  return py::dict("normals"_a = t.normals, "sort"_a = t.sort, "neighbors"_a = t.neighbors, "growth"_a = t.growth,
                  "regularity"_a = t.regularity, "finish"_a = t.finish, "total"_a = t.total);
}

inline py::dict score(const CGAL::Tandem::Result_score& s)
{
  return py::dict("fit"_a = s.fit, "links"_a = s.links, "size"_a = s.size, "price"_a = s.price, "freedom"_a = s.freedom,
                  "total"_a = s.total());
}

inline py::dict free_points(const CGAL::Tandem::Free_points& f)
{
  return py::dict("without_normal"_a = f.without_normal, "misaligned"_a = f.misaligned, "misfit"_a = f.misfit,
                  "without_neighbors"_a = f.without_neighbors, "in_small_regions"_a = f.in_small_regions,
                  "clutter"_a = f.clutter, "unselected"_a = f.unselected, "total"_a = f.total());
}

inline py::dict statistics(const Result& result)
{
  const CGAL::Tandem::Statistics& s = result.shapes().statistics();
  return py::dict(
    "number_of_points"_a = s.number_of_points,
    "number_of_ignored_coordinates"_a = s.number_of_ignored_coordinates - result.given().zeros,
    "number_of_ignored_zeros"_a = result.given().zeros, "number_of_ignored_normals"_a = s.number_of_ignored_normals,
    "number_of_ignored_tolerances"_a = s.number_of_ignored_tolerances,
    "number_of_far_points"_a = s.number_of_far_points, "number_of_assigned_points"_a = s.number_of_assigned_points,
    "free_points"_a = free_points(s.free_points), "number_of_shapes"_a = s.number_of_shapes,
    "number_of_directions"_a = s.number_of_directions, "number_of_planes"_a = s.number_of_planes,
    "number_of_orthogonal_pairs"_a = s.number_of_orthogonal_pairs, "coverage"_a = s.coverage,
    "mean_distance"_a = s.mean_distance, "degrees_of_freedom"_a = s.degrees_of_freedom, "complexity"_a = s.complexity,
    "score"_a = score(s.score), "number_of_rounds"_a = s.number_of_rounds, "times"_a = times(s.times),
    "peak_bytes"_a = s.peak_bytes, "grid_step"_a = s.grid_step, "is_grid_coarse"_a = s.is_grid_coarse,
    "line_spacing"_a = s.line_spacing, "has_estimated_normals"_a = s.has_estimated_normals,
    "is_cancelled"_a = s.is_cancelled, "estimate_note"_a = s.estimate_note, "angle_note"_a = s.angle_note,
    "backend"_a = s.backend);
}

inline py::tuple triple(const std::array<double, 3>& d) { return py::make_tuple(d[0], d[1], d[2]); }

inline py::list directions(const CGAL::Tandem::Parameters& p)
{
  py::list result;
  for(const auto& d : p.fixed_directions)
    result.append(triple(d));
  return result;
}

inline py::object axis(const CGAL::Tandem::Parameters& p)
{
  return p.regularize_axis_symmetry ? py::object(triple(p.symmetry_direction)) : py::object(py::none());
}

inline py::dict parameters(const Result& result)
{
  const CGAL::Tandem::Parameters& p = result.shapes().parameters();
  return py::dict(
    "maximum_distance"_a = p.maximum_distance, "maximum_angle"_a = p.maximum_angle,
    "angle_tolerance"_a = p.angle_tolerance, "maximum_offset"_a = p.maximum_offset,
    "minimum_region_size"_a = p.minimum_region_size, "simplicity"_a = p.simplicity, "regularity"_a = p.regularity,
    "fixed_regularity"_a = p.fixed_regularity, "surfel_size"_a = p.surfel_size, "k_neighbors"_a = p.k_neighbors,
    "cell_size"_a = p.cell_size, "regularize_parallelism"_a = p.regularize_parallelism,
    "regularize_orthogonality"_a = p.regularize_orthogonality, "regularize_coplanarity"_a = p.regularize_coplanarity,
    "fixed_directions"_a = directions(p), "symmetry_direction"_a = axis(p));
}

inline std::string text(const Result& result)
{
  const CGAL::Tandem::Statistics& s = result.shapes().statistics();
  return "<tandem.PlanarShapes: " + std::to_string(s.number_of_shapes) + " shapes, " +
         std::to_string(s.number_of_directions) + " directions, " + std::to_string(s.number_of_planes) + " planes, " +
         std::to_string(s.number_of_assigned_points) + " of " + std::to_string(s.number_of_points) + " points" +
         (s.is_cancelled ? ", cancelled" : "") + ">";
}

using Class = py::class_<Result>;

inline void add_arrays(Class& result)
{
  result
    .def_property_readonly("planes", getter<double>(&Shapes::Data::coefficients, 4),
                           "(m, 4) float64: a, b, c, d of each shape, with a x + b y + c z + d = 0 and a unit normal.\n"
                           "Parallel shapes have the same normal and coplanar shapes the same plane, bit for bit.")
    .def_property_readonly("labels", getter<std::int32_t>(&Shapes::Data::shape_of),
                           "(n,) int32: the shape of each point, -1 if it has none.")
    .def_property_readonly(
      "parallel_groups", getter<std::int32_t>(&Shapes::Data::parallel_group),
      "(m,) int32: the parallel group of each shape, from 0. Shapes of a group have one direction.")
    .def_property_readonly("coplanar_groups", getter<std::int32_t>(&Shapes::Data::coplanar_group),
                           "(m,) int32: the coplanar group of each shape, from 0. Shapes of a group have one plane.")
    .def_property_readonly(
      "orthogonal_pairs", getter<std::int32_t>(&Shapes::Data::orthogonal_groups, 2),
      "(p, 2) int32: pairs of parallel groups that are orthogonal, the smaller number first, sorted.\n"
      "Their unit normals have a dot product of at most 1e-15.")
    .def_property_readonly("fixed_directions", getter<std::int32_t>(&Shapes::Data::fixed_direction),
                           "(g,) int32: the index in fixed_directions of the direction of each parallel group, -1 if\n"
                           "it has none of these directions.")
    .def_property_readonly(
      "symmetry_groups", getter<std::int32_t>(&Shapes::Data::symmetry_group),
      "(g,) int32: the symmetry group of each parallel group. All groups with one number make the\n"
      "same angle with symmetry_direction, up to 1e-15 of its cosine. -1 without that direction.")
    .def_property_readonly("is_flipped", getter<bool>(&Shapes::Data::is_flipped),
                           "(m,) bool: whether most given normals of the points of a shape are opposite to the normal\n"
                           "of its plane: multiply such planes by -1 to orient them. False for estimated normals.")
    .def_property_readonly("normals", &normals,
                           "(n, 3) float64: the normals that the detection used: a copy of the given normals, or\n"
                           "estimated unit normals. The vector is null for points without a normal.")
    .def("points_of", &points_of, py::arg("shape"),
         "The points of a shape, as an array of indices (uint32, ascending):\n"
         "points[shapes.points_of(0)]. Raises IndexError if there is no such shape.");
}

inline void add_values(Class& result)
{
  result
    .def_property_readonly("statistics", &statistics,
                           "dict: counts, quality, memory in bytes, and times in seconds of the detection.")
    .def_property_readonly(
      "uncertainties", &uncertainties,
      "dict of new arrays, by shape: how accurately its points determine its plane. noise (m,) is the\n"
      "noise of a point across the plane, normal_covariance (m, 3, 3) the covariance of the unit normal\n"
      "in radians, centroid (m, 3) the mean of the points, offset_deviation (m,) the standard deviation\n"
      "of the plane there along its normal, and angle_deg (m,) the largest of the normal, in degrees.")
    .def_property_readonly("parameters", &parameters, "dict: all parameters of the detection, also estimated ones.")
    .def_property_readonly(
      "maximum_distance", [](const Result& r) { return r.shapes().parameters().maximum_distance; },
      "float: the value of the detection, in units of the points.")
    .def_property_readonly(
      "minimum_region_size", [](const Result& r) { return r.shapes().parameters().minimum_region_size; },
      "int: the value of the detection.")
    .def_property_readonly(
      "is_cancelled", [](const Result& r) { return r.shapes().statistics().is_cancelled; },
      "bool: whether progress() has cancelled the detection. The shapes found until then are verified.")
    .def_property_readonly(
      "hash", [](const Result& r) { return r.shapes().hash(); },
      "int: equal for equal results, also for other back ends and the program detect_planes.")
    .def("__len__", &Result::size)
    .def("__repr__", &text);
}

// --- The table of the shapes: PlanarShapes.table()

// number_of(s): of each shape, as a new array of int64, float64 or, of words, str.
template <class F>
py::array array_by_shape(const Result& result, const F& number_of)
{
  using Value = decltype(number_of(0));
  if constexpr(std::is_same_v<Value, const char*>) {
    py::list words;
    for(std::size_t s = 0; s < result.size(); ++s)
      words.append(number_of(s));
    return py::module_::import("numpy").attr("array")(words, "str");
  } else {
    using Number = std::conditional_t<std::is_integral_v<Value>, std::int64_t, double>;
    py::array_t<Number> array(py::ssize_t(result.size()));
    Number* to = array.mutable_data();
    for(std::size_t s = 0; s < result.size(); ++s)
      *to++ = Number(number_of(s));
    return array;
  }
}

// From where the points were seen: one place, or one for each point.
using Places = std::optional<py::array_t<double, py::array::c_style | py::array::forcecast>>;

inline Places places_of(const Result& result, const py::object& viewpoint)
{
  if(viewpoint.is_none())
    return std::nullopt;
  const auto places = Places::value_type::ensure(viewpoint);
  if(!places)
    PyErr_Clear();
  const auto points = py::ssize_t(result.shapes().number_of_points());
  const bool is_one = places && places.ndim() == 1 && places.shape(0) == 3;
  if(!is_one && !(places && places.ndim() == 2 && places.shape(0) == points && places.shape(1) == 3))
    throw py::value_error("viewpoint must be three numbers, or three for each of the " + std::to_string(points) +
                          " points");
  return places;
}

// f(points), where these are of the detection. Other threads of Python run meanwhile. The array of points is the caller's,
// who may have changed it.
template <class F>
auto with_points(const Result& result, const F& f, const Places& viewpoint = {})
{
  Cloud cloud = {result.given().points->data(), nullptr, nullptr, result.shapes().number_of_points()};
  if(viewpoint) {
    cloud.viewpoints = viewpoint->data();
    cloud.viewpoint_step = viewpoint->ndim() == 1 ? 0 : 3;
  }
  const py::gil_scoped_release no_gil;
  try {
    return f(cloud);
  } catch(const CGAL::Tandem::Parameter_error&) {
    throw;
  } catch(const std::invalid_argument& e) {
    throw std::invalid_argument("points were changed after the detection, and this function measures them. " +
                                std::string(e.what()));
  }
}

// The names are those of the columns of detect_planes --shapes.
inline py::dict table(const Result& result, const py::object& viewpoint)
{
  const Places places = places_of(result, viewpoint);
  py::dict dict;
  const auto add = [&](const std::string& name, const auto& number_of) {
    dict[py::str(name)] = array_by_shape(result, number_of);
  };
  add("shape", [](std::size_t s) { return s; });
  const auto facts = with_points(
    result, [&](const Cloud& points) { return shape_facts(points, result.shapes()); }, places);
  tandem_examples::for_each_shape_column(result.shapes(), facts, places.has_value(), add);
  return dict;
}

inline void add_table(Class& result)
{
  result.def(
    "table", &table, py::arg("viewpoint") = py::none(),
    "A dict of new arrays of shape (m,), ready for pandas.DataFrame: a row for each shape, as detect_planes --shapes\n"
    "writes it. Integers are int64, other numbers float64; lengths are in units of the points. What a shape has not "
    "is\n"
    "nan, as the area of one with too few points for an outline.\n\n"
    "shape, points            the shape, and the number of its points\n"
    "a, b, c, d               its plane\n"
    "x, y, z                  the mean of its points\n"
    "area                     the area of the outline of its points\n"
    "length, width            the sides of the smallest rectangle around points and outline, the longer side first\n"
    "lowest, highest          smallest and largest height of its points. Upward is z, or symmetry_direction\n"
    "tilt_deg                 angle between upward and the normal, in [0, 180]; with given normals, the normal of\n"
    "                         the side that is_flipped tells\n"
    "dip_deg                  angle between the plane and the horizontal, in [0, 90]\n"
    "azimuth_deg              direction in which the plane falls, clockwise from y, in [0, 360); 0 for a level plane\n"
    "rms_distance, mean_distance\n"
    "                         root mean square and mean distance of the points to the plane\n"
    "turned_deg, shifted      angle and distance between the plane and the least-squares plane of the points\n"
    "noise, offset_deviation, angle_deviation_deg\n"
    "                         as in uncertainties; the last one is angle_deg\n"
    "curved                   whether the shape is a facet of a curved surface, in [0, 1]: it is above 0.5\n"
    "class                    floor, ceiling, wall, roof, ground or slanted\n"
    "behind                   the shape through which the sensor saw this one, -1 if there is none: a column only if "
    "you\n"
    "                         pass viewpoint, the place of the sensor, or an array (n, 3) of places for each point\n"
    "parallel_group, coplanar_group\n\n"
    "The function reads the array of points of detect_planes() again; the result keeps that array alive. Raises "
    "ValueError\n"
    "if a point in the array has changed and is no longer on its plane. Takes about as long as the detection, mostly\n"
    "for the areas.");
}

// ---

// Objects of the class come from functions of the module only. Python would make them without a value, by __new__() of
// the class or, where that is refused, of its base.
template <class Type>
void refuse_new(Type& type)
{
  type.def_static("__new__", [](const py::args&, const py::kwargs&) {
    throw py::type_error("objects of this class are made by functions of tandem only");
  });
  reinterpret_cast<PyTypeObject*>(type.ptr())->tp_new = [](PyTypeObject* made, PyObject*, PyObject*) -> PyObject* {
    PyErr_Format(PyExc_TypeError, "%s: objects of this class are made by functions of tandem only", made->tp_name);
    return nullptr;
  };
}

inline Class add_result(py::module_& module)
{
  Class result(module, "PlanarShapes", py::module_local(),
               "The planar shapes that detect_planes() has found in a cloud of n points: m shapes, counted from 0.\n\n"
               "A parallel group holds the shapes of one direction, a coplanar group the shapes of one plane. Arrays\n"
               "are read-only views of the memory of the result and keep it alive. len() is the number of shapes.");
  result.attr("__module__") = "tandem";
  refuse_new(result);
  add_arrays(result);
  add_values(result);
  add_table(result);
  return result;
}

} // namespace tandem_python

#endif // TANDEM_PYTHON_RESULT_H
