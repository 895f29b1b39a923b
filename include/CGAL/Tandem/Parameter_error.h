// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exception of a parameter that is outside of its range.

#ifndef CGAL_TANDEM_PARAMETER_ERROR_H
#define CGAL_TANDEM_PARAMETER_ERROR_H

#include <stdexcept>
#include <string>

namespace CGAL::Tandem {

/*!
\ingroup PkgShapeRegularizationTandemRef

is thrown where a parameter is outside of its range. With `Mpi_tag`, all processes throw the same one.
*/
class Parameter_error : public std::invalid_argument {
public:
  /// makes the message "NAME is VALUE, allowed is RANGE".
  Parameter_error(const std::string& name, const std::string& value, const std::string& range)
    : std::invalid_argument(name + " is " + value + ", allowed is " + range), name_(name), value_(value), range_(range)
  {}

  /// returns the name of the parameter, such as `maximum_angle`.
  const std::string& name() const { return name_; }
  /// returns the value that was passed, as text.
  const std::string& value() const { return value_; }
  /// returns the allowed values, such as `[0, 45) degrees`.
  const std::string& range() const { return range_; }

private:
  std::string name_, value_, range_;
};

} // namespace CGAL::Tandem

#endif // CGAL_TANDEM_PARAMETER_ERROR_H
