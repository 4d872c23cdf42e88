// What a user of PCL writes: a cloud in memory, a ping, soundings back as a PCL cloud.
#include <insonify/core/units.hpp>
#include <insonify/scene_io/pcl_bridge.hpp>
#include <insonify/simulate/simulate_ping.hpp>
#include <insonify/store/sonar_file.hpp>
#include <insonify/view/picture.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

int main() {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int i = 0; i < 100; ++i)
    for (int j = -50; j < 50; ++j) cloud.emplace_back(0.1F * static_cast<float>(i), 0.1F * static_cast<float>(j), 0.0F);
  insonify::LoadOptions options;
  options.viewpoint = Eigen::Vector3d(0, 0, 10);
  const auto loaded = insonify::from_pcl(cloud, options);

  insonify::SonarSpec spec = insonify::find_sonar("p900-45").spec;
  spec.max_range = 8;
  const insonify::SonarHead head = insonify::make_head(spec, insonify::sound_speed({}));
  const auto pose = insonify::pose_from_yaw_pitch_roll({0, 0, 2}, 0, insonify::radians(20), 0);
  const auto result = insonify::simulate_ping(loaded.scene, head, pose, {});
  const auto returns = insonify::to_pcl(result.soundings);
  return returns.width > 100 && !insonify::colour_map_names().empty() ? 0 : 1;
}
