#include <pcl/features/normal_3d_omp.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include "core/parallel.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/pcl_rows_internal.hpp"

namespace insonify {

std::vector<Eigen::Vector3f> estimate_normals(const std::vector<Eigen::Vector3f>& points,
                                              const std::vector<std::uint32_t>& wanted, int neighbours, int threads) {
  const QuietPcl quiet;
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve(points.size());
  for (const Eigen::Vector3f& p : points) cloud->emplace_back(p.x(), p.y(), p.z());
  const auto indices = pcl::make_shared<pcl::Indices>(wanted.begin(), wanted.end());

  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNumberOfThreads(static_cast<unsigned>(thread_count(threads)));
  estimation.setInputCloud(cloud);
  if (wanted.size() < points.size()) estimation.setIndices(indices);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(neighbours);
  pcl::PointCloud<pcl::Normal> found;
  estimation.compute(found);

  // Normalise, since PCL's closed-form eigenvector has unit length only to a few ulp.
  std::vector<Eigen::Vector3f> normals(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector3f n = found[i].getNormalVector3fMap();
    normals[i] = n / n.norm();
  }
  return normals;
}

}  // namespace insonify
