// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/Byte_source.h"

#include "formats.h"
#include "signals.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#ifdef DETECT_PLANES_WITH_ZLIB
#include <zlib.h>
#endif

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

#ifdef DETECT_PLANES_WITH_ZLIB

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
      if(is_interrupted())
        throw Interrupted();
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

#endif

} // namespace

std::unique_ptr<Byte_source> open_bytes(const std::string& path)
{
  if(!is_gzip(path))
    return std::make_unique<File_source>(path);
#ifdef DETECT_PLANES_WITH_ZLIB
  return std::make_unique<Gzip_source>(path);
#else
  throw std::runtime_error("this program was built without zlib; decompress the file with gunzip");
#endif
}

} // namespace program
