// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_BYTE_SOURCE_H
#define DETECT_PLANES_BYTE_SOURCE_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace program {

// The bytes of a file; of one that ends in .gz, those that it had before it was compressed.
class Byte_source {
public:
  virtual ~Byte_source() = default;
  virtual std::uint64_t size() const = 0;
  virtual void seek(std::uint64_t position) = 0;
  virtual std::size_t read(char* bytes, std::size_t count) = 0; // less than `count` at the end
};

std::unique_ptr<Byte_source> open_bytes(const std::string& path);

} // namespace program

#endif // DETECT_PLANES_BYTE_SOURCE_H
