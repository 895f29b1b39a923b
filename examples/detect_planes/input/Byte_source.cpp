// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/Input_buffer.h"

#include "Built_with.h"
#include "file_names.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace program {

namespace {

class File_source final : public Byte_source {
public:
  explicit File_source(const std::string& path) : size_(std::uint64_t(std::filesystem::file_size(path)))
  {
    if(!file.open(path, std::ios::in | std::ios::binary))
      throw std::runtime_error("cannot be opened");
  }

  std::uint64_t size() const override { return size_; }
  void seek(std::uint64_t position) override { file.pubseekpos(std::streamoff(position), std::ios::in); }
  std::size_t read(char* bytes, std::size_t count) override
  {
    return std::size_t(file.sgetn(bytes, std::streamsize(count)));
  }

private:
  std::filebuf file;
  std::uint64_t size_;
};

} // namespace

std::unique_ptr<Byte_source> open_bytes(const std::string& path)
{
  if(!is_gzip(path))
    return std::make_unique<File_source>(path);
  if constexpr(has_gzip)
    return open_gzip(path);
  throw std::runtime_error("this program was built without zlib; decompress the file with gunzip");
}

} // namespace program
