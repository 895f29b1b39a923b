// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"

namespace program {

namespace {

// One type for coordinates and normals: some readers want them to agree.
bool has_double(const Output_points& cloud)
{
  return std::any_of(cloud.part.begin(), cloud.part.end(), [&](Point_set::Index i) {
    const std::array<double, 6> numbers = cloud.place_and_normal(i);
    return !std::all_of(numbers.begin(), numbers.end(), fits_float);
  });
}

// What a point has behind its color, as the formats describe it.
struct Attribute {
  std::string name;
  const char* ply_type;
  const char *pcd_size, *pcd_type;
};

std::vector<Attribute> attributes_of(const Output_points& cloud)
{
  std::vector<Attribute> attributes;
  if(cloud.intensity)
    attributes.push_back({"intensity", "float", " 4", " F"});
  if(cloud.classification)
    attributes.push_back({"classification", "uchar", " 1", " U"});
  if(cloud.tolerance)
    attributes.push_back({"tolerance", "double", " 8", " F"});
  attributes.push_back({cloud.label_property, "int", " 4", " I"});
  return attributes;
}

// write(number): but for the shape, which is the last.
template <class Write>
void write_attributes(const Output_points& cloud, Point_set::Index i, const Write& write)
{
  if(cloud.intensity)
    write((*cloud.intensity)[i]);
  if(cloud.classification)
    write((*cloud.classification)[i]);
  if(cloud.tolerance)
    write((*cloud.tolerance)[i]);
}

// write_color(color): as the format has it.
template <class Write_color>
void write_points(std::ostream& out, const Output_points& cloud, bool is_double, const Write_color& write_color)
{
  for(Point_set::Index i : cloud.part) {
    for(double x : cloud.place_and_normal(i))
      if(is_double)
        write_binary(out, x);
      else
        write_binary(out, float(x));
    write_color(cloud.color(i));
    write_attributes(cloud, i, [&](auto number) { write_binary(out, number); });
    write_binary(out, cloud.shape(i));
  }
}

void write_ply(std::ostream& out, const Output_points& cloud)
{
  const bool is_double = has_double(cloud);
  out << "ply\nformat binary_little_endian 1.0\ncomment detect_planes of Tandem\nelement vertex " << cloud.part.size();
  for(const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    out << "\nproperty " << (is_double ? "double " : "float ") << name;
  out << "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
  for(const Attribute& a : attributes_of(cloud))
    out << "property " << a.ply_type << ' ' << a.name << '\n';
  out << "end_header\n";
  write_points(out, cloud, is_double, [&](const Color& color) {
    for(std::uint8_t channel : color)
      write_binary(out, channel);
  });
}

void write_pcd(std::ostream& out, const Output_points& cloud)
{
  const bool is_double = has_double(cloud);
  std::string names, sizes = is_double ? " 8 8 8 8 8 8 4" : " 4 4 4 4 4 4 4", types, counts;
  for(const Attribute& a : attributes_of(cloud)) {
    names += ' ' + a.name;
    sizes += a.pcd_size;
    types += a.pcd_type;
    counts += " 1";
  }
  out << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z normal_x normal_y normal_z rgb" << names
      << "\nSIZE" << sizes << "\nTYPE F F F F F F F" << types << "\nCOUNT 1 1 1 1 1 1 1" << counts << "\nWIDTH "
      << cloud.part.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << cloud.part.size() << "\nDATA binary\n";
  write_points(out, cloud, is_double, [&](const Color& c) {
    write_binary(out, std::uint32_t(c[0]) << 16 | std::uint32_t(c[1]) << 8 | std::uint32_t(c[2]));
  });
}

void write_table(std::ostream& out, const Output_points& cloud, char separator, const char* comment)
{
  std::string names = "x y z nx ny nz r g b";
  for(const Attribute& a : attributes_of(cloud))
    names += ' ' + a.name;
  std::replace(names.begin(), names.end(), ' ', separator);
  out << comment << names << '\n';
  const auto write = [&](auto number) { write_shortest(out, number, separator); };
  for(Point_set::Index i : cloud.part) {
    for(double x : cloud.place_and_normal(i))
      write(x);
    for(std::uint8_t channel : cloud.color(i))
      write(channel);
    write_attributes(cloud, i, write);
    out << cloud.shape(i) << '\n';
  }
}

} // namespace

void write_cloud(std::ostream& out, const Output_points& cloud, const std::string& extension,
                 const std::optional<Las_frame>& frame)
{
  if constexpr(has_laszip)
    if(extension == ".laz")
      return write_laz(out, cloud, frame);
  if(extension == ".las")
    write_las(out, cloud, frame);
  else if(extension == ".pcd")
    write_pcd(out, cloud);
  else if(extension == ".csv")
    write_table(out, cloud, ',', "");
  else if(is_in(extension, {".xyz", ".txt"}))
    write_table(out, cloud, ' ', "# ");
  else
    write_ply(out, cloud);
}

} // namespace program
