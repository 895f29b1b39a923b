// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "output/writers.h"

namespace program {

namespace {

// One type for coordinates and normals: some readers want them to agree.
bool has_double(const Output_points& cloud)
{
  return needs_double(cloud.part, [&](Point_set::Index i) { return cloud.points.point(i); }) ||
         needs_double(cloud.part, [&](Point_set::Index i) { return cloud.normal(i); });
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

// write_color(color): as the format has it.
template <class Write_color>
void write_points(Binary_writer& binary, const Output_points& cloud, bool is_double, const Write_color& write_color)
{
  for(Point_set::Index i : cloud.part) {
    const Kernel::Point_3& p = cloud.points.point(i);
    const Kernel::Vector_3 n = cloud.normal(i);
    for(double x : {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()})
      binary.write_real(x, is_double);
    write_color(cloud.color(i));
    if(cloud.intensity)
      binary.write((*cloud.intensity)[i]);
    if(cloud.classification)
      binary.write((*cloud.classification)[i]);
    if(cloud.tolerance)
      binary.write((*cloud.tolerance)[i]);
    binary.write(cloud.shape(i));
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
  Binary_writer binary(out);
  write_points(binary, cloud, is_double, [&](const Color& color) {
    std::for_each(color.begin(), color.end(), [&](std::uint8_t channel) { binary.write(channel); });
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
  Binary_writer binary(out);
  write_points(binary, cloud, is_double, [&](const Color& c) {
    binary.write(std::uint32_t(c[0]) << 16 | std::uint32_t(c[1]) << 8 | std::uint32_t(c[2]));
  });
}

void write_table(std::ostream& out, const Output_points& cloud, char separator, const char* comment)
{
  std::string names = "x y z nx ny nz r g b";
  for(const Attribute& a : attributes_of(cloud))
    names += ' ' + a.name;
  std::replace(names.begin(), names.end(), ' ', separator);
  out << comment << names << '\n';
  for(Point_set::Index i : cloud.part) {
    const Kernel::Point_3& p = cloud.points.point(i);
    const Kernel::Vector_3 n = cloud.normal(i);
    for(double x : {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()})
      write_shortest(out, x, separator);
    for(std::uint8_t channel : cloud.color(i))
      out << int(channel) << separator;
    if(cloud.intensity)
      write_shortest(out, (*cloud.intensity)[i], separator);
    if(cloud.classification)
      out << int((*cloud.classification)[i]) << separator;
    if(cloud.tolerance)
      write_shortest(out, (*cloud.tolerance)[i], separator);
    out << cloud.shape(i) << '\n';
  }
}

} // namespace

void write_cloud(std::ostream& out, const Point_set& points, const Point_part& part, const Shapes& shapes,
                 const Cloud_format& format)
{
  const std::string& extension = format.extension;
  const bool is_las = extension == ".las" || extension == ".laz";
  const Output_points cloud(points, part, shapes, format.colors.empty() ? !is_las : format.colors == "shape",
                            format.label_property);
  if constexpr(has_laszip)
    if(extension == ".laz")
      return write_laz(out, cloud, format.las_frame);
  if(extension == ".las")
    write_las(out, cloud, format.las_frame);
  else if(extension == ".pcd")
    write_pcd(out, cloud);
  else if(extension == ".csv")
    write_table(out, cloud, ',', "");
  else if(extension == ".xyz" || extension == ".txt")
    write_table(out, cloud, ' ', "# ");
  else
    write_ply(out, cloud);
}

} // namespace program
