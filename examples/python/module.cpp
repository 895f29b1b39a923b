// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The extension module tandem._tandem. The package, tandem/__init__.py, checks and converts the arguments: arrays that
// come here are contiguous and of the right type.

#include "Result.h"
#include "pickling.h"

#include <CGAL/Shape_regularization_tandem/upward_direction.h>
#include <CGAL/Tandem/Parameters.h>

#include <pybind11/stl.h>

#include <limits>

namespace tandem_python {

using Labels = py::array_t<std::int32_t, py::array::c_style>;

// The arrays outlive what is read of them.
Cloud cloud_of(const Rows& points, const Given& given)
{
  const auto data = [](const std::optional<Rows>& rows) { return rows ? rows->data() : nullptr; };
  return {points.data(), data(given.normals), data(given.tolerances), std::size_t(points.shape(0))};
}

// Other threads of Python run meanwhile. The function may not touch objects of Python.
template <class F>
auto without_gil(const F& f)
{
  const py::gil_scoped_release no_gil;
  return f();
}

// Progress for a function of Python, or none. It is called on the calling thread, where signals are handled, and
// throws what the function raises.
bool report_progress(const py::object& function, double fraction)
{
  const py::gil_scoped_acquire gil;
  if(PyErr_CheckSignals() != 0)
    throw py::error_already_set();
  if(function.is_none())
    return true;
  const py::object answer = function(fraction);
  const int is_true = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
  if(is_true < 0)
    throw py::error_already_set();
  return is_true != 0;
}

Result detect(const Rows& points, const Given& given, const Settings& settings, const py::object& progress)
{
  const Cloud cloud = cloud_of(points, given);
  const auto callback = [&progress](double fraction) { return report_progress(progress, fraction); };
  Given all = given;
  all.points = points;
  return Result(without_gil([&] { return detect_planes(cloud, settings, callback); }), all);
}

std::vector<std::string> warnings_of(const Rows& points, const Given& given, const Settings& settings,
                                     const Result& result)
{
  const Cloud cloud = cloud_of(points, given);
  return without_gil([&] { return warnings(cloud, settings, result.shapes()); });
}

py::tuple estimate(const Rows& points, const std::optional<Rows>& normals)
{
  const Cloud cloud = cloud_of(points, {normals, std::nullopt});
  const CGAL::Tandem::Parameters p = without_gil([&] { return estimate_parameters(cloud); });
  return py::make_tuple(p.maximum_distance, p.maximum_offset, p.minimum_region_size);
}

// A new array.
template <class Number, class Range>
py::array_t<Number> array_of(const Range& values)
{
  py::array_t<Number> result(py::ssize_t(values.size()));
  std::copy(values.begin(), values.end(), result.mutable_data());
  return result;
}

py::array_t<double> estimate_local(const Rows& points, const std::optional<Rows>& normals)
{
  const Cloud cloud = cloud_of(points, {normals, std::nullopt});
  return array_of<double>(without_gil([&] { return estimate_local_distances(cloud); }));
}

// The items of a named tuple, in its order.
py::tuple regularize(const Rows& points, const Labels& labels, const Rows& planes, const Settings& settings)
{
  std::vector<Coefficients> changed(std::size_t(planes.shape(0)));
  std::copy_n(planes.data(), planes.size(), changed.empty() ? nullptr : changed.front().data());
  const Cloud cloud = cloud_of(points, {});
  const std::int32_t* const label = labels.data();
  const CGAL::Tandem::Plane_relations r =
    without_gil([&] { return regularize_planes(cloud, label, settings, changed); });
  py::array_t<double> new_planes({py::ssize_t(changed.size()), py::ssize_t(4)});
  std::copy_n(changed.empty() ? nullptr : changed.front().data(), 4 * changed.size(), new_planes.mutable_data());
  py::array_t<std::int32_t> pairs({py::ssize_t(r.orthogonal_groups.size()), py::ssize_t(2)});
  std::int32_t* next = pairs.mutable_data();
  for(const auto& [first, second] : r.orthogonal_groups) {
    *next++ = first;
    *next++ = second;
  }
  return py::make_tuple(new_planes, array_of<std::int32_t>(r.parallel_group), array_of<std::int32_t>(r.coplanar_group),
                        pairs, array_of<bool>(r.is_changed), array_of<bool>(r.is_rolled_back),
                        array_of<double>(r.angle), array_of<double>(r.largest_distance), r.maximum_distance);
}

std::string violation(const Rows& points, const Result& result)
{
  const Cloud cloud = cloud_of(points, result.given());
  return without_gil([&] { return find_violation(cloud, result.shapes()); });
}

Result select(const Result& result, const std::vector<long long>& indices)
{
  return Result(without_gil([&] { return select_shapes(result.shapes(), indices); }), result.given());
}

Result select_by(const Result& result, const Selection& selection, const py::object& viewpoint)
{
  const auto select = [&](const Cloud& points) { return select_shapes(result.shapes(), points, selection); };
  return Result(with_points(result, select, places_of(result, viewpoint)), result.given());
}

py::array_t<std::int32_t> label(const Result& result, const Rows& points, const Given& given, Labeling labeling)
{
  const Cloud cloud = cloud_of(points, given);
  if(labeling.reach != std::numeric_limits<double>::infinity())
    labeling.shape_points = cloud_of(*result.given().points, {});
  return array_of<std::int32_t>(without_gil([&] { return label_points(result.shapes(), cloud, labeling); }));
}

// --- Models: the items of named tuples, in their order.

py::tuple polygon_arrays(const Result& result, bool one_for_each_plane)
{
  Polygon_tables t =
    with_points(result, [&](const Cloud& points) { return polygons(points, result.shapes(), one_for_each_plane); });
  return py::make_tuple(taken(t.vertices, 3), taken(t.triangles, 3), taken(t.triangle_shape), taken(t.loop_vertices),
                        taken(t.loop_starts), taken(t.polygon_starts), taken(t.polygon_shape));
}

py::tuple line_arrays(const Result& result)
{
  Line_tables t = with_points(result, [&](const Cloud& points) { return lines(points, result.shapes()); });
  return py::make_tuple(taken(t.vertices, 3), taken(t.segments, 2), taken(t.segment_shapes, 2), taken(t.corners),
                        taken(t.corner_shapes), taken(t.corner_starts));
}

py::tuple surface_arrays(const Result& result, std::optional<long long> planes, std::optional<long long> components,
                         std::optional<std::array<double, 3>> upward, std::optional<double> base,
                         const std::vector<std::vector<Surface_settings::Ring>>& footprints)
{
  const Surface_settings settings = {planes, components, upward, base, footprints};
  const auto callback = [](double fraction) { return report_progress(py::none(), fraction); };
  Surface_tables t = with_points(
    result, [&](const Cloud& points) { return closed_surface(points, result.shapes(), settings, callback); });
  return py::make_tuple(taken(t.vertices, 3), taken(t.triangles, 3), taken(t.triangle_face), taken(t.face_vertices),
                        taken(t.face_starts), taken(t.face_plane), taken(t.face_supported), t.supported,
                        t.number_of_points, t.number_of_planes, t.number_of_omitted_planes);
}

// --- Pickling: what makes a result of itself again.

py::tuple state_of(const Result& result)
{
  const Given& given = result.given();
  return py::make_tuple(py::bytes(bytes_of(result.shapes())), *given.points, given.normals, given.tolerances,
                        given.zeros);
}

Result result_of(const py::bytes& bytes, const Rows& points, const std::optional<Rows>& normals,
                 const std::optional<Rows>& tolerances, std::size_t zeros)
{
  return Result(shapes_of(std::string(bytes), std::size_t(points.shape(0))), {normals, tolerances, zeros, points});
}

// ---

// A class of the arguments of functions that have many, and the function that makes them.
template <class Arguments>
py::class_<Arguments> add_arguments(py::module_& module, const char* name, const char* maker)
{
  py::class_<Arguments> arguments(module, name, py::module_local());
  refuse_new(arguments);
  module.def(maker, [] { return Arguments(); });
  return arguments;
}

void add_selection(py::module_& module)
{
  add_arguments<Selection>(module, "Selection", "default_selection")
    .def_readwrite("largest", &Selection::largest)
    .def_readwrite("near_angle", &Selection::near_angle)
    .def_readwrite("near_direction", &Selection::near_direction)
    .def_readwrite("orthogonal_direction", &Selection::orthogonal_direction);
  add_arguments<Labeling>(module, "Labeling", "default_labeling")
    .def_readwrite("maximum_distance", &Labeling::maximum_distance)
    .def_readwrite("maximum_angle", &Labeling::maximum_angle)
    .def_readwrite("reach", &Labeling::reach);
  module.def("select_shapes", &select);
  module.def("select_shapes_by", &select_by);
  module.def("label_points", &label);
  module.def("polygons", &polygon_arrays);
  module.def("lines", &line_arrays);
  module.def("closed_surface", &surface_arrays);
  module.def("upward_direction",
             [](const Result& result) { return triple(CGAL::Tandem::upward_direction(result.shapes()).direction); });
}

void add_settings(py::module_& module)
{
  py::class_<Given> given(module, "Given", py::module_local());
  refuse_new(given);
  module.def("given", [](const std::optional<Rows>& normals, const std::optional<Rows>& tolerances, std::size_t zeros) {
    return Given{normals, tolerances, zeros, std::nullopt};
  });
  add_arguments<Settings>(module, "Settings", "default_settings")
    .def_readwrite("maximum_distance", &Settings::maximum_distance)
    .def_readwrite("maximum_angle", &Settings::maximum_angle)
    .def_readwrite("angle_tolerance", &Settings::angle_tolerance)
    .def_readwrite("maximum_offset", &Settings::maximum_offset)
    .def_readwrite("minimum_region_size", &Settings::minimum_region_size)
    .def_readwrite("simplicity", &Settings::simplicity)
    .def_readwrite("regularity", &Settings::regularity)
    .def_readwrite("fixed_regularity", &Settings::fixed_regularity)
    .def_readwrite("surfel_size", &Settings::surfel_size)
    .def_readwrite("k_neighbors", &Settings::k_neighbors)
    .def_readwrite("cell_size", &Settings::cell_size)
    .def_readwrite("threads", &Settings::threads)
    .def_readwrite("regularize_parallelism", &Settings::regularize_parallelism)
    .def_readwrite("regularize_orthogonality", &Settings::regularize_orthogonality)
    .def_readwrite("regularize_coplanarity", &Settings::regularize_coplanarity)
    .def_readwrite("fixed_directions", &Settings::fixed_directions)
    .def_readwrite("symmetry_direction", &Settings::symmetry_direction)
    .def_readwrite("backend", &Settings::backend);
}

// tandem.ParameterError, a ValueError that has the fields of Parameter_error.
void add_parameter_error(py::module_& module)
{
  static const py::handle type =
    py::exception<CGAL::Tandem::Parameter_error>(module, "ParameterError", PyExc_ValueError);
  type.attr("__module__") = "tandem";
  type.attr("__doc__") = "A parameter is outside of its range: the texts name, value and range say which.";
  py::register_exception_translator([](std::exception_ptr failure) {
    try {
      std::rethrow_exception(failure);
    } catch(const CGAL::Tandem::Parameter_error& e) {
      const py::object error = type(e.what());
      error.attr("name") = e.name();
      error.attr("value") = e.value();
      error.attr("range") = e.range();
      PyErr_SetObject(type.ptr(), error.ptr());
    }
  });
}

} // namespace tandem_python

PYBIND11_MODULE(_tandem, module)
{
  using namespace tandem_python;
  module.doc() = "The compiled part of tandem.";
  module.attr("__version__") = TANDEM_VERSION;
  add_parameter_error(module);
  add_settings(module);
  add_result(module);
  add_selection(module);
  module.def("detect_planes", &detect);
  module.def("warnings", &warnings_of);
  module.def("state_of", &state_of);
  module.def("result_of", &result_of);
  module.def("estimate_parameters", &estimate);
  module.def("estimate_local_distances", &estimate_local);
  module.def("regularize_planes", &regularize);
  module.def("find_violation", &violation);
  module.def("backends", &backends);
}
