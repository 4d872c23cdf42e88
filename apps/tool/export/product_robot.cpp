// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "formats/mcap_file.hpp"
#include "formats/ros_messages.hpp"
#include "tool/export/product_run.hpp"

namespace insonify::tool {
namespace {

constexpr int fan_rows_of_pixels = 480;

/// Quality of service of a topic whose last message is kept for those who listen later, as ROS 2 records it.
constexpr const char* kept_for_late_listeners =
    "- history: 1\n  depth: 1\n  reliability: 1\n  durability: 1\n  deadline:\n    sec: 9223372036\n    nsec: "
    "854775807\n"
    "  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n  liveliness: 1\n  liveliness_lease_duration:\n"
    "    sec: 9223372036\n    nsec: 854775807\n  avoid_ros_namespace_conventions: false";

/// The compression that is asked for, if this build has it.
McapCompression compression_of(const ProductOptions& o) {
  const McapCompression wanted = o.compression == "zstd"  ? McapCompression::zstd
                                 : o.compression == "lz4" ? McapCompression::lz4
                                                          : McapCompression::none;
  return has_compression(wanted) ? wanted : McapCompression::none;
}

/// Topics of a robot's log, made with the first ping, whose levels give the scale of images.
struct RobotLog {
  McapFile file;
  GreyScale grey;
  SonarImageScale scale;
  Eigen::Vector3d origin;
  std::uint16_t image, fan, points, transforms, fixed_transforms;
  std::optional<std::uint16_t> fix{};  ///< channel of fixes, of a run with a position on the globe

  RobotLog(const PlacedRun& run, const std::string& sonar, const Ping& ping)
      : file(run.options.output, compression_of(run.options)), grey(ping), origin(ping.world_from_head.translation()) {
    const ProductOptions& o = run.options;
    // Single precision holds world coordinates to a millimetre up to some kilometres.
    origin = origin.norm() > 1e4 ? Eigen::Vector3d(origin.array().round()) : Eigen::Vector3d(0, 0, 0);
    scale = {o.linear, grey.window, std::max(1e-12, 4 * static_cast<double>(ping.pressure.abs().maxCoeff()))};
    const std::map<std::string, std::string> greys = {{"black_db", fmt::format("{}", grey.window.min_db)},
                                                      {"white_db", fmt::format("{}", grey.window.max_db)},
                                                      {"reference", "dB re 1 uPa at 1 m"},
                                                      {"law", "level = black_db + value / 255 (white_db - black_db)"},
                                                      {"gain", "40 log10(range) + 2 absorption range"}};
    std::map<std::string, std::string> of_file = greys;
    of_file.insert({{"name", "insonify"}, {"version", INSONIFY_VERSION}, {"sonar", sonar}});
    if (const std::string& start = o.start_utc.empty() ? run.pings.start_utc : o.start_utc; !start.empty())
      of_file.insert({"start_utc", start});
    file.add_metadata("insonify", of_file);
    const std::map<std::string, std::string> numbers = {{"full_scale_pa", fmt::format("{}", scale.full_scale)},
                                                        {"law", "amplitude = value / 4294967295 full_scale_pa"}};
    const std::map<std::string, std::string> metadata = {
        {"origin_m", fmt::format("{},{},{}", origin.x(), origin.y(), origin.z())}};
    const auto add = [&](const char* topic, const RosType& type, const std::map<std::string, std::string>& about) {
      return file.add_topic(topic, type.name, type.text, about);
    };
    image = add("/sonar/image", projected_sonar_image_type(), o.linear ? numbers : greys);
    fan = add("/sonar/fan", image_type(), greys);
    std::map<std::string, std::string> of_points = metadata;
    if (!o.processing_profile.empty()) of_points["processing_profile"] = profile_name(o);
    points = add("/sonar/points", point_cloud_type(), of_points);
    transforms = add("/tf", transforms_type(), metadata);
    fixed_transforms = add("/tf_static", transforms_type(), {{"offered_qos_profiles", kept_for_late_listeners}});
    if (run.georeference) fix = add("/sonar/fix", nav_sat_fix_type(), {{"frame_id", "head"}});
  }
};

}  // namespace

std::string compression_note(const ProductOptions& o) {
  if (o.compression == "none" || compression_of(o) != McapCompression::none) return {};
  return fmt::format("{} is not compressed: this build lacks {}, whose library ({}) was not found", o.output,
                     o.compression, o.compression == "lz4" ? "liblz4-dev" : "libzstd-dev");
}

SoundingCount mcap_product(const PlacedRun& run) {
  std::unique_ptr<RobotLog> log;
  const auto count = each_swath(run, [&](const Cube& cube, const Ping& ping, const BottomSoundings& found) {
    const auto time = static_cast<std::uint64_t>(std::llround((run.start + ping.time) * 1e9));
    if (!log) {
      log = std::make_unique<RobotLog>(run, cube.sonar, ping);
      log->file.add(log->fixed_transforms, time, sonar_transform(time));
    }
    log->file.add(log->transforms, time, head_transform(ping.world_from_head, log->origin, time));
    if (log->fix)
      log->file.add(*log->fix, time,
                    nav_sat_fix(geo_from_world(run.reference(), ping.world_from_head.translation()), time));
    log->file.add(log->image, time,
                  projected_sonar_image(ping, time, cube.centre_frequency, ping.sound_speed, GreyScale::tvg_of(ping),
                                        log->scale));
    log->file.add(log->fan, time,
                  fan_image(ping, time, GreyScale::tvg_of(ping), log->scale.window, fan_rows_of_pixels));
    log->file.add(log->points, time, point_cloud(found, log->origin, time));
  });
  log->file.finish();
  return count;
}

}  // namespace insonify::tool
