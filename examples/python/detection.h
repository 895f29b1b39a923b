// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the Python module calls, without types of Python, and without the headers of CGAL, which take longest to
// compile. Clouds are rows of three doubles in the caller's memory.

#ifndef TANDEM_PYTHON_DETECTION_H
#define TANDEM_PYTHON_DETECTION_H

#include <CGAL/Tandem/Parameters.h>
#include <CGAL/Tandem/Plane_relations.h>
#include <CGAL/Tandem/Plane_uncertainty.h>
#include <CGAL/Tandem/Shape_facts.h>
#include <CGAL/Tandem/Statistics.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tandem_python {

using Coefficients = std::array<double, 4>;

// The memory is read only while a function runs.
struct Cloud {
  const double* points = nullptr;
  const double* normals = nullptr;    // null: they are estimated
  const double* tolerances = nullptr; // null: all points have the same
  std::size_t size = 0;
};

// What is not given is left to the library.
struct Settings {
  std::optional<double> maximum_distance, maximum_angle, angle_tolerance, maximum_offset, simplicity, regularity,
    surfel_size;
  std::optional<long long> minimum_region_size, k_neighbors, cell_size, threads;
  bool regularize_parallelism = true, regularize_orthogonality = true, regularize_coplanarity = true;
  std::vector<std::array<double, 3>> fixed_directions;
  std::optional<std::array<double, 3>> symmetry_direction;
  std::string backend = "auto";
};

// Numbers that do not change, in memory of the shapes.
template <class Number>
struct Table {
  const Number* data;
  std::size_t size;
};

// The result of a detection. Copies share it.
class Shapes {
public:
  struct Data; // a Planar_shapes_3

  explicit Shapes(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  Table<double> planes() const; // four of each shape
  Table<std::int32_t> labels() const;
  Table<int> parallel_groups() const;
  Table<int> coplanar_groups() const;
  Table<int> orthogonal_pairs() const; // two of each pair
  Table<int> fixed_directions() const; // of each parallel group
  Table<int> symmetry_groups() const;  // of each parallel group
  Table<char> is_flipped() const;      // 0 or 1
  Table<CGAL::Tandem::Plane_uncertainty> uncertainties() const;
  Table<std::uint32_t> points(std::size_t shape) const;
  void copy_estimated_normals(double* to) const; // three of each point
  const CGAL::Tandem::Statistics& statistics() const;
  const CGAL::Tandem::Parameters& parameters() const;
  std::uint64_t hash() const;
  const Data& data() const { return *data_; }

private:
  std::shared_ptr<const Data> data_;
};

// Throws what the library throws. An exception of the callback ends the detection and is passed on.
Shapes detect_planes(const Cloud& cloud, const Settings& settings, const CGAL::Tandem::Callback& callback);

CGAL::Tandem::Parameters estimate_parameters(const Cloud& cloud);

// One for each point, NaN for those that are not valid.
std::vector<double> estimate_local_distances(const Cloud& cloud);

// Changes the planes. There is a label for each point of the cloud, whose normals are not used.
CGAL::Tandem::Plane_relations regularize_planes(const Cloud& cloud, const std::int32_t* labels,
                                                const Settings& settings, std::vector<Coefficients>& planes);

// Of each shape, from the points that it was detected in. Throws std::invalid_argument where these have changed.
std::vector<CGAL::Tandem::Shape_facts> shape_facts(const Cloud& cloud, const Shapes& shapes);

// Empty if the shapes have all that is guaranteed.
std::string find_violation(const Cloud& cloud, const Shapes& shapes);

// Those that can be used on this machine.
std::vector<std::string> backends();

} // namespace tandem_python

#endif // TANDEM_PYTHON_DETECTION_H
