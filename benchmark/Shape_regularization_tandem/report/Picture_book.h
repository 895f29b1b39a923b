// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pictures of one cloud: as it came, and what each contestant made of it, in the same colors. They are colored
// clouds, FOLDER/CLOUD.NAME.ply.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_BOOK_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_BOOK_H

#include "shape_colors.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

class Picture_book {
public:
  // Writes CLOUD.input.ply. The cloud must outlive the book; the folder exists.
  Picture_book(const Ply_cloud& cloud, const Tolerances& tolerances, const std::string& folder, const std::string& name)
    : cloud_(cloud), fidelity_(tolerances), stem_(folder + "/" + name + ".")
  {
    Ply_cloud input = cloud;
    input.normals.resize(cloud.points.size(), Vec{0, 0, 0});
    input.color.assign(cloud.points.size(), Color{225, 228, 232});
    input.label.assign(cloud.points.size(), 0);
    write("input", input);
  }

  // To be added first, where it is known: then it gives the colors.
  void add_truth(const Detection& truth)
  {
    drawn_.push_back(truth);
    write("truth", colored(cloud_, truth, colors_of(truth)));
  }

  // Points that violate the tolerances are black. What equals another one is not drawn. Colors are those of the truth,
  // else of the first result.
  void add(const std::string& name, const Detection& detection)
  {
    for(const Detection& other : drawn_)
      if(are_same(other, detection))
        return;
    drawn_.push_back(detection);
    Ply_cloud picture = colored(cloud_, detection, colors_like(drawn_.front(), detection));
    for(std::size_t i = 0; i < picture.color.size(); ++i)
      if(detection.label[i] >= 0 && violates(detection.planes[std::size_t(detection.label[i])], i))
        picture.color[i] = {20, 20, 20};
    write(name, picture);
  }

private:
  static constexpr std::size_t maximum_points = 100000; // more cannot be seen in a small picture

  void write(const std::string& name, const Ply_cloud& picture) const
  {
    write_ply(stem_ + name + ".ply",
              picture.points.size() > maximum_points ? subset(picture, maximum_points) : picture);
  }

  bool violates(const Plane& plane, std::size_t point) const
  {
    return !fidelity_.fits(plane, cloud_.points, cloud_.normals, point);
  }

  const Ply_cloud& cloud_;
  Fidelity fidelity_;
  std::string stem_;
  std::vector<Detection> drawn_;
};

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_BOOK_H
