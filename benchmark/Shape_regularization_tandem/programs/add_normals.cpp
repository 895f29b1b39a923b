// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes a cloud with normals by PCA of the k nearest points, so that all
// detectors read the same normals.

#include "clouds/read_ply.h"
#include "scenes/scene_normals.h"

#include <iostream>

using namespace CGAL::Tandem::benchmark;

int main(int argc, char** argv)
try {
  if(argc < 3 || argc > 4)
    throw std::invalid_argument("usage: add_normals INPUT.ply OUTPUT.ply [K, default 20]");
  Ply_cloud cloud = read_ply(argv[1]);
  cloud.normals = CGAL::Tandem::scenes::pca_normals(cloud.points, argc > 3 ? unsigned(std::stoul(argv[3])) : 20);
  write_ply(argv[2], cloud);
  return 0;
} catch(const std::exception& e) {
  std::cerr << "add_normals: " << e.what() << "\n";
  return 1;
}
