// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/Input_buffer.h"

#include <vector>
#include <zlib.h>

namespace program {

namespace {

// A gzip file does not tell its size: it is read once for that, which finds faults in it, too.
class Gzip_source final : public Byte_source {
public:
  explicit Gzip_source(const std::string& path) : file(gzopen(path.c_str(), "rb"))
  {
    if(!file)
      throw std::runtime_error("cannot be opened");
    gzbuffer(file.get(), 1 << 17);
    std::vector<char> block(1 << 18);
    for(std::size_t n = 1; n > 0; size_ += n) {
      check_signals();
      n = read(block.data(), block.size());
    }
    if(gzdirect(file.get()))
      throw std::runtime_error("is not compressed by gzip (rename it, without .gz)");
    seek(0);
  }

  std::uint64_t size() const override { return size_; }
  void seek(std::uint64_t position) override { gzseek(file.get(), z_off_t(position), SEEK_SET); }

  std::size_t read(char* bytes, std::size_t count) override
  {
    const int n = gzread(file.get(), bytes, unsigned(count));
    int error = Z_OK;
    gzerror(file.get(), &error);
    if(n < 0 || (error != Z_OK && error != Z_STREAM_END))
      throw std::runtime_error("is damaged or truncated: gzip cannot decompress it");
    return std::size_t(n);
  }

private:
  struct Close {
    void operator()(gzFile opened) const { gzclose(opened); }
  };
  std::unique_ptr<gzFile_s, Close> file;
  std::uint64_t size_ = 0;
};

} // namespace

std::unique_ptr<Byte_source> open_gzip(const std::string& path) { return std::make_unique<Gzip_source>(path); }

} // namespace program
