// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PLY clouds, binary little-endian or read as text, for the measuring programs:
// coordinates and normals of any number type, and an int property `label`, or
// `shape` as detect_planes writes it.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLY_CLOUD_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLY_CLOUD_H

#include "testing/scenes.h"

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

namespace CGAL {
namespace Tandem {
namespace benchmark {

using scenes::Vec;
using Color = std::array<std::uint8_t, 3>; // red, green, blue

struct Ply_cloud {
  std::vector<Vec> points;
  std::vector<Vec> normals;            // empty if there are none
  std::vector<std::int32_t> label;     // empty if there is none
  bool is_double = false;              // how the coordinates were, or shall be, stored
  std::vector<Color> color = {};       // empty if there is none; written, not read
  std::vector<double> tolerances = {}; // of the points; empty: all have that of the task. For Tandem, in this process

  bool has_normals() const { return !normals.empty(); }
  bool has_color() const { return !color.empty(); }
  bool has_label() const { return !label.empty(); }
};

class Ply_reader {
public:
  explicit Ply_reader(const std::string& path) : path_(path), in_(path, std::ios::binary)
  {
    if(!in_)
      fail("cannot be opened");
    read_header();
  }

  Ply_cloud read()
  {
    Ply_cloud cloud;
    int x = find("x"), nx = find("nx"), label = find("label") >= 0 ? find("label") : find("shape");
    if(x < 0 || find("y") < 0 || find("z") < 0)
      fail("has no coordinates");
    cloud.is_double = properties_[std::size_t(x)].size == 8;
    int y = find("y"), z = find("z"), ny = find("ny"), nz = find("nz");
    for(std::size_t i = 0; i < size_; ++i) {
      if(!read_row())
        fail("ends early, at point " + std::to_string(i) + " of " + std::to_string(size_));
      cloud.points.push_back({value(x), value(y), value(z)});
      if(nx >= 0 && ny >= 0 && nz >= 0)
        cloud.normals.push_back({value(nx), value(ny), value(nz)});
      if(label >= 0)
        cloud.label.push_back(std::int32_t(value(label)));
    }
    return cloud;
  }

private:
  enum class Kind { signed_int, unsigned_int, real };
  struct Property {
    std::string name;
    Kind kind;
    std::size_t size, offset;
  };

  [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(path_ + ": " + what); }

  void read_header()
  {
    std::string line, word;
    bool is_vertex = false, is_known = false;
    while(std::getline(in_, line) && line.substr(0, 10) != "end_header") {
      std::istringstream words(line);
      words >> word;
      if(word == "format") {
        is_text_ = line.find("ascii") != std::string::npos;
        is_known = is_text_ || line.find("binary_little_endian") != std::string::npos;
      }
      if(word == "element") {
        is_vertex = size_ == 0 && line.find("vertex") != std::string::npos;
        if(is_vertex)
          words >> word >> size_;
      }
      if(word == "property" && is_vertex)
        add_property(words);
    }
    if(!in_ || !is_known)
      fail("is neither a binary little-endian nor a text PLY file");
    numbers_.resize(properties_.size());
    bytes_.resize(row_size_);
  }

  void add_property(std::istringstream& words)
  {
    std::string type, name;
    words >> type >> name;
    Kind kind = type[0] == 'u' ? Kind::unsigned_int : Kind::signed_int;
    std::size_t size = 4;
    if(type == "float" || type == "float32" || type == "double" || type == "float64") {
      kind = Kind::real;
      size = type == "double" || type == "float64" ? 8 : 4;
    } else if(type.find("char") != std::string::npos || type == "int8" || type == "uint8")
      size = 1;
    else if(type.find("short") != std::string::npos || type == "int16" || type == "uint16")
      size = 2;
    else if(type == "list")
      fail("has a list among the properties of a point");
    properties_.push_back({name, kind, size, row_size_});
    row_size_ += size;
  }

  int find(const std::string& name) const
  {
    for(std::size_t i = 0; i < properties_.size(); ++i)
      if(properties_[i].name == name)
        return int(i);
    return -1;
  }

  template <class T>
  static double as(const char* bytes)
  {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return double(value);
  }

  bool read_row()
  {
    if(!is_text_)
      return bool(in_.read(bytes_.data(), std::streamsize(row_size_)));
    for(double& number : numbers_)
      in_ >> number;
    return bool(in_);
  }

  // Of the row that was read. A float in text is rounded as a float.
  double value(int property) const
  {
    const Property& p = properties_[std::size_t(property)];
    if(is_text_)
      return p.kind == Kind::real && p.size == 4 ? float(numbers_[std::size_t(property)])
                                                 : numbers_[std::size_t(property)];
    const char* bytes = bytes_.data() + p.offset;
    if(p.kind == Kind::real)
      return p.size == 8 ? as<double>(bytes) : as<float>(bytes);
    bool is_signed = p.kind == Kind::signed_int;
    if(p.size == 1)
      return is_signed ? as<std::int8_t>(bytes) : as<std::uint8_t>(bytes);
    if(p.size == 2)
      return is_signed ? as<std::int16_t>(bytes) : as<std::uint16_t>(bytes);
    return is_signed ? as<std::int32_t>(bytes) : as<std::uint32_t>(bytes);
  }

  std::string path_;
  std::ifstream in_;
  std::vector<Property> properties_;
  std::size_t size_ = 0, row_size_ = 0;
  bool is_text_ = false;
  std::vector<double> numbers_; // of a row of text
  std::vector<char> bytes_;     // of a binary row
};

inline Ply_cloud read_ply(const std::string& path) { return Ply_reader(path).read(); }

// Selection sampling: exactly `count` points, in their order.
inline Ply_cloud subset(const Ply_cloud& cloud, std::size_t count)
{
  Ply_cloud result;
  result.is_double = cloud.is_double;
  scenes::Random random(42);
  const std::size_t n = cloud.points.size();
  for(std::size_t i = 0, chosen = 0; i < n && chosen < count; ++i) {
    if(random.uniform() * double(n - i) >= double(count - chosen))
      continue;
    ++chosen;
    result.points.push_back(cloud.points[i]);
    if(cloud.has_normals())
      result.normals.push_back(cloud.normals[i]);
    if(cloud.has_color())
      result.color.push_back(cloud.color[i]);
    if(cloud.has_label())
      result.label.push_back(cloud.label[i]);
  }
  return result;
}

template <class T>
void append(std::string& bytes, T value)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

inline std::string ply_header(const Ply_cloud& cloud)
{
  std::ostringstream header;
  const char* type = cloud.is_double ? "double" : "float";
  header << "ply\nformat binary_little_endian 1.0\nelement vertex " << cloud.points.size() << "\n";
  for(const char* name : {"x", "y", "z"})
    header << "property " << type << " " << name << "\n";
  if(cloud.has_normals())
    header << "property float nx\nproperty float ny\nproperty float nz\n";
  if(cloud.has_color())
    header << "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if(cloud.has_label())
    header << "property int label\n";
  header << "end_header\n";
  return header.str();
}

inline void write_ply(const std::string& path, const Ply_cloud& cloud)
{
  std::string bytes = ply_header(cloud);
  auto append_all = [&](const Vec& v, bool is_double) {
    for(double c : {v.x, v.y, v.z}) {
      if(is_double)
        append(bytes, c);
      else
        append(bytes, float(c));
    }
  };
  for(std::size_t i = 0; i < cloud.points.size(); ++i) {
    append_all(cloud.points[i], cloud.is_double);
    if(cloud.has_normals())
      append_all(cloud.normals[i], false);
    if(cloud.has_color())
      bytes.append(cloud.color[i].begin(), cloud.color[i].end());
    if(cloud.has_label())
      append(bytes, cloud.label[i]);
  }
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  if(!out)
    throw std::runtime_error(path + ": cannot be written");
}

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PLY_CLOUD_H
