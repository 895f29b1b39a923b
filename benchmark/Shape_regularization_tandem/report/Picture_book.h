// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pictures of one cloud: as it came, and what each contestant made of it, from
// the same place and in the same colors. Files FOLDER/CLOUD.NAME.png.

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_BOOK_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_BOOK_H

#include "Scene_view.h"

namespace CGAL {
namespace Tandem {
namespace benchmark {

class Picture_book {
public:
  // Writes CLOUD.input.png. The cloud must outlive the book; the folder exists.
  Picture_book(const Ply_cloud& cloud, const Tolerances& tolerances, const std::string& folder, const std::string& name)
    : cloud_(cloud), fidelity_(tolerances), view_(cloud, {}, {480, 360}), stem_(folder + "/" + name + ".")
  {
    view_.draw_input().write_png(stem_ + "input.png");
  }

  // To be added first, where it is known: then it gives the colors.
  void add_truth(const Detection& truth)
  {
    drawn_.push_back(truth);
    draw("truth", truth, std::vector<bool>(truth.label.size(), false));
  }

  // Points that violate the tolerances are black. What looks like another one is not drawn. Colors are those of the
  // truth, else of the first result.
  void add(const std::string& name, const Detection& detection)
  {
    for(const Detection& other : drawn_)
      if(are_same(other, detection))
        return;
    drawn_.push_back(detection);
    draw(name, detection, violations(detection));
  }

private:
  void draw(const std::string& name, const Detection& detection, const std::vector<bool>& is_marked) const
  {
    view_.draw(detection, colors_like(drawn_.front(), detection), is_marked).write_png(stem_ + name + ".png");
  }

  std::vector<bool> violations(const Detection& detection) const
  {
    std::vector<bool> result(detection.label.size(), false);
    for(std::size_t i = 0; i < result.size(); ++i)
      if(detection.label[i] >= 0) {
        const Plane& plane = detection.planes[std::size_t(detection.label[i])];
        result[i] = fidelity_.is_beyond_epsilon(plane, cloud_.points[i]) ||
                    (cloud_.has_normals() && fidelity_.is_beyond_alpha(plane, cloud_.normals[i]));
      }
    return result;
  }

  const Ply_cloud& cloud_;
  Fidelity fidelity_;
  Scene_view view_;
  std::string stem_;
  std::vector<Detection> drawn_;
};

} // namespace benchmark
} // namespace Tandem
} // namespace CGAL

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_BENCHMARK_PICTURE_BOOK_H
