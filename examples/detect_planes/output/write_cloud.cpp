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

void write_coordinates(Binary_writer& binary, const Output_points& cloud, Point_set::Index i, bool is_double)
{
  const Kernel::Point_3& p = cloud.points.point(i);
  const Kernel::Vector_3 n = cloud.normal(i);
  for(double x : {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()})
    binary.write_real(x, is_double);
}

void write_attributes(Binary_writer& binary, const Output_points& cloud, Point_set::Index i)
{
  if(cloud.intensity)
    binary.write((*cloud.intensity)[i]);
  if(cloud.classification)
    binary.write((*cloud.classification)[i]);
  if(cloud.tolerance)
    binary.write((*cloud.tolerance)[i]);
  binary.write(cloud.shape(i));
}

void write_ply(std::ostream& out, const Output_points& cloud)
{
  const bool is_double = has_double(cloud);
  out << "ply\nformat binary_little_endian 1.0\ncomment detect_planes of Tandem\nelement vertex " << cloud.part.size();
  for(const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    out << "\nproperty " << (is_double ? "double " : "float ") << name;
  out << "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
      << (cloud.intensity ? "property float intensity\n" : "")
      << (cloud.classification ? "property uchar classification\n" : "")
      << (cloud.tolerance ? "property double tolerance\n" : "") << "property int " << cloud.label_property
      << "\nend_header\n";
  Binary_writer binary(out);
  for(Point_set::Index i : cloud.part) {
    write_coordinates(binary, cloud, i, is_double);
    for(std::uint8_t channel : cloud.color(i))
      binary.write(channel);
    write_attributes(binary, cloud, i);
  }
}

void write_pcd(std::ostream& out, const Output_points& cloud)
{
  const bool is_double = has_double(cloud);
  const bool has_intensity = bool(cloud.intensity), has_class = bool(cloud.classification),
             has_tolerance = bool(cloud.tolerance);
  const std::string size = is_double ? " 8" : " 4";
  std::string sizes;
  for(int i = 0; i < 6; ++i)
    sizes += size;
  out << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z normal_x normal_y normal_z rgb"
      << (has_intensity ? " intensity" : "") << (has_class ? " classification" : "")
      << (has_tolerance ? " tolerance" : "") << ' ' << cloud.label_property << "\nSIZE" << sizes << " 4"
      << (has_intensity ? " 4" : "") << (has_class ? " 1" : "") << (has_tolerance ? " 8" : "")
      << " 4\nTYPE F F F F F F F" << (has_intensity ? " F" : "") << (has_class ? " U" : "")
      << (has_tolerance ? " F" : "") << " I\nCOUNT 1 1 1 1 1 1 1" << (has_intensity ? " 1" : "")
      << (has_class ? " 1" : "") << (has_tolerance ? " 1" : "") << " 1\nWIDTH " << cloud.part.size()
      << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << cloud.part.size() << "\nDATA binary\n";
  Binary_writer binary(out);
  for(Point_set::Index i : cloud.part) {
    write_coordinates(binary, cloud, i, is_double);
    const Color c = cloud.color(i);
    binary.write(std::uint32_t(c[0]) << 16 | std::uint32_t(c[1]) << 8 | std::uint32_t(c[2]));
    write_attributes(binary, cloud, i);
  }
}

void write_table(std::ostream& out, const Output_points& cloud, char separator, const char* comment)
{
  std::string names = "x y z nx ny nz r g b";
  names += std::string(cloud.intensity ? " intensity" : "") + (cloud.classification ? " classification" : "") +
           (cloud.tolerance ? " tolerance" : "") + ' ' + cloud.label_property;
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
