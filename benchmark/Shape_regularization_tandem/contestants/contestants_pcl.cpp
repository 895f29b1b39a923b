// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PCL's region growing, with a plane fitted to each of its clusters: the fastest
// peer that runs on processors.

#include "Contestant.h"

#ifdef TANDEM_HAS_PCL
#include "testing/fit_plane.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/region_growing.h>
#endif

namespace CGAL::Tandem::benchmark {

#ifdef TANDEM_HAS_PCL
namespace {

using Points = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;

// Relative to the center, since coordinates are floats.
Points::Ptr points_of(const Ply_cloud& cloud, const Vec& center)
{
  Points::Ptr points(new Points);
  points->reserve(cloud.points.size());
  for(const Vec& p : cloud.points)
    points->push_back(pcl::PointXYZ(float(p.x - center.x), float(p.y - center.y), float(p.z - center.z)));
  return points;
}

// Of 20 neighbors, as all peers have them.
Normals::Ptr estimated_normals(const Points::Ptr& points)
{
  Normals::Ptr normals(new Normals);
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(points);
  estimation.setSearchMethod(pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setKSearch(20);
  estimation.compute(*normals);
  return normals;
}

// The curvature, by which the seeds are ordered, comes with the normals where these are given.
Normals::Ptr given_normals(const Ply_cloud& cloud, const Points::Ptr& points)
{
  const Normals::Ptr estimated = estimated_normals(points);
  Normals::Ptr normals(new Normals);
  for(std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec n = unit(cloud.normals[i]);
    pcl::Normal normal(float(n.x), float(n.y), float(n.z));
    normal.curvature = (*estimated)[i].curvature;
    normals->push_back(normal);
  }
  return normals;
}

std::vector<pcl::PointIndices> grow(const Points::Ptr& points, const Normals::Ptr& normals, const Task& task)
{
  pcl::RegionGrowing<pcl::PointXYZ, pcl::Normal> growing;
  growing.setInputCloud(points);
  growing.setInputNormals(normals);
  growing.setNumberOfNeighbours(task.k_neighbors);
  growing.setMinClusterSize(int(task.minimum_region_size));
  growing.setMaxClusterSize(int(points->size()));
  // Normals are compared with that of the seed, and points with their neighbor's plane: of the modes of this
  // detector the one that finds planes best.
  growing.setSmoothModeFlag(false);
  growing.setSmoothnessThreshold(float(task.maximum_angle_deg * 0.017453292519943295));
  growing.setResidualTestFlag(true);
  growing.setCurvatureTestFlag(false);
  growing.setResidualThreshold(float(task.maximum_distance));
  std::vector<pcl::PointIndices> clusters;
  growing.extract(clusters);
  return clusters;
}

Run pcl_step(const Ply_cloud& cloud, const Task& task, const Run&)
{
  const Vec center = extent_of(cloud.points).center;
  const Points::Ptr points = points_of(cloud, center);
  std::vector<Vec> centered;
  for(const Vec& p : cloud.points)
    centered.push_back(p - center);
  const bool estimates = estimates_normals(cloud, task);
  Normals::Ptr normals = estimates ? Normals::Ptr() : given_normals(cloud, points);
  Run run;
  Meter meter;
  if(estimates) {
    normals = estimated_normals(points);
    run.normal_seconds = meter.lap();
    for(const pcl::Normal& n : *normals)
      run.normals.push_back({n.normal_x, n.normal_y, n.normal_z});
  }
  const std::vector<pcl::PointIndices> clusters = grow(points, normals, task);
  run.detection.label.assign(points->size(), -1);
  for(std::size_t s = 0; s < clusters.size(); ++s)
    for(int i : clusters[s].indices)
      run.detection.label[std::size_t(i)] = std::int32_t(s);
  run.detection.planes = fit_planes(centered, run.detection.label, clusters.size());
  run.detection_seconds = meter.lap();
  for(Plane& plane : run.detection.planes)
    plane.offset -= dot(plane.normal, center);
  return finished(run, meter);
}

} // namespace

std::vector<Contestant> pcl_contestants() { return {make_contestant("pcl-growing", "PCL region growing", pcl_step)}; }
#else
std::vector<Contestant> pcl_contestants() { return {}; }
#endif

} // namespace CGAL::Tandem::benchmark
