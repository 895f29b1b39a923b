// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exceptions as text, so that the one of one rank can be thrown by all. Types of the standard library are kept; others
// become std::runtime_error.

#ifndef CGAL_TANDEM_INTERNAL_MPI_MESSAGES_FAILURE_H
#define CGAL_TANDEM_INTERNAL_MPI_MESSAGES_FAILURE_H

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace CGAL {
namespace Tandem {
namespace internal {

// The first letter is the type, the rest is the message.
inline std::string encoded_failure(std::exception_ptr failure)
{
  try {
    std::rethrow_exception(failure);
  } catch(const std::invalid_argument& e) {
    return std::string("i") + e.what();
  } catch(const std::length_error& e) {
    return std::string("l") + e.what();
  } catch(const std::logic_error& e) {
    return std::string("L") + e.what();
  } catch(const std::range_error& e) {
    return std::string("r") + e.what();
  } catch(const std::bad_alloc&) {
    return "b";
  } catch(const std::exception& e) {
    return std::string("e") + e.what();
  } catch(...) {
    return "eanother rank has failed";
  }
}

[[noreturn]] inline void throw_failure(const std::string& encoded)
{
  const std::string message = encoded.substr(1);
  switch(encoded.at(0)) {
  case 'i':
    throw std::invalid_argument(message);
  case 'l':
    throw std::length_error(message);
  case 'L':
    throw std::logic_error(message);
  case 'r':
    throw std::range_error(message);
  case 'b':
    throw std::bad_alloc();
  default:
    throw std::runtime_error(message);
  }
}

// The failure of another rank, on which all ranks have agreed.
class Agreed_failure {
public:
  explicit Agreed_failure(const std::string& encoded) : encoded_(encoded) {}
  [[noreturn]] void rethrow() const { throw_failure(encoded_); }

private:
  std::string encoded_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_TANDEM_INTERNAL_MPI_MESSAGES_FAILURE_H
