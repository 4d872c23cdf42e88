// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "returns/soundings.hpp"
#include "scene_io/load_scene.hpp"

namespace insonify {

/// Returns a scene from a PCL cloud in memory, cleaned, completed and counted as load_scene does. Throws as load_scene
/// for unusable content.
LoadedScene from_pcl(const pcl::PointCloud<pcl::PointNormal>& cloud, const LoadOptions& options = {});
/// Returns a scene from points without normals; the normals are estimated.
LoadedScene from_pcl(const pcl::PointCloud<pcl::PointXYZ>& cloud, const LoadOptions& options = {});
/// Returns a scene from a cloud of any fields, found by name and type.
LoadedScene from_pcl(const pcl::PCLPointCloud2& cloud, const LoadOptions& options = {});
/// Returns a scene from a mesh.
LoadedScene from_pcl(const pcl::PolygonMesh& mesh, const LoadOptions& options = {});

/// Returns soundings as a PCL cloud with the fields x y z level_db range azimuth elevation (float32), ping beam bin
/// (uint32), true_elevation (float32), true_surfel true_material (uint32). Coordinates are float in PCL; those far from
/// zero lose precision.
pcl::PCLPointCloud2 to_pcl(const Soundings& soundings);

/// Returns the points and normals of a scene in world coordinates, in float.
pcl::PointCloud<pcl::PointNormal> to_pcl(const SceneCloud& scene);

}  // namespace insonify
