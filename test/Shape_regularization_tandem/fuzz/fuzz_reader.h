// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_FUZZ_READER_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_FUZZ_READER_H

#include <cstddef>
#include <cstdint>

// Reads the bytes as a file with this extension. Ends the process where a cloud comes out that the bytes cannot hold.
// `least_size` is that of a point. Returns the number of points, 0 if the file is rejected.
std::size_t read_as_file(const std::uint8_t* bytes, std::size_t size, const char* extension, double least_size);

// Ends the process with a message if the condition is false.
void expect(bool is_true, const char* what);

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_FUZZ_READER_H
