// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scene_bent.h"

namespace CGAL::Tandem::scenes {

Model make_bent_hall()
{
  Model model;
  const Frame upright = Frame().with_axes({1, 0, 0}, {0, 0, 1}); // its normal is -y
  model.add_bent_rectangle(Frame(), 8, 5, -.02);
  model.add_bent_rectangle(Frame().at({0, 5, 3}).with_axes({1, 0, 0}, {0, -1, 0}), 8, 5, .04);
  model.add_rectangle(upright.at({0, 0, -5}), 8, 3);
  model.add_rectangle(upright.at({1, 1, -4.978}), 1.5, 1);
  model.add_rectangle(upright.at({5, 1, -4.94}), 1.5, 1);
  for(int i = 0; i < 3; ++i)
    model.curved.push_back({Frame().at({2. + 2 * i, 2, 0}), .1 * double(1 << i), 3, false});
  model.scanners = {{4, 1, 1.5}};
  return model;
}

Model make_bent_road()
{
  Model model;
  model.add_bent_rectangle(Frame(), 30, 6, -.12);
  const Frame upright = Frame().with_axes({1, 0, 0}, {0, 0, 1});
  model.add_rectangle(upright.at({0, .3, -8}), 30, 4);
  model.add_bent_rectangle(Frame().at({0, 8, 4.3}).turned({1, 0, 0}, .25), 12, 5, .06);
  model.add_bent_rectangle(Frame().at({14, 8, 4.3}).turned({1, 0, 0}, .25), 12, 5, -.06);
  model.scanners = {{15, 2, 2}};
  return model;
}

} // namespace CGAL::Tandem::scenes
