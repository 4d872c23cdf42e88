// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "files/pending_file.hpp"
#include "formats/grey_fan.hpp"
#include "returns/looks.hpp"
#include "run/run_checks.hpp"
#include "tool/export/product_run.hpp"
#include "view/grey_file.hpp"
#include "view/show_image.hpp"

namespace insonify::tool {

std::size_t png_product(const PlacedRun& run, RunDirectory& directory) {
  constexpr int rows_of_pixels = 720;
  std::unique_ptr<GreyScale> scale;
  nlohmann::ordered_json manifest{{"schema", 1}, {"insonify_version", INSONIFY_VERSION}, {"exported", run.options.run}};
  each_ping(run.pings, [&](const Cube&, const Ping& ping) {
    if (!scale) {
      scale = std::make_unique<GreyScale>(ping);
      manifest["black_db"] = scale->window.min_db;
      manifest["white_db"] = scale->window.max_db;
      manifest["levels"] = "dB re 1 uPa at 1 m";
      manifest["min_range_m"] = ping.gate.min_range;
      manifest["bin_m"] = ping.gate.bin_size;
    }
    const std::string number = fmt::format("{:06}.png", manifest["pings"].size());
    const GreyFan fan = grey_fan(ping, GreyScale::tvg_of(ping), scale->window, rows_of_pixels);
    save_grey_png(directory.file("fan_" + number), fan.grey);
    show_grey(quantise_16(apply_tvg(shown_level_db(ping), ping.gate, GreyScale::tvg_of(ping)), scale->window), ping.fan,
              directory.file("samples_" + number));
    manifest["metres_per_pixel"] = fan.pixel;
    nlohmann::ordered_json pose;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) pose.push_back(ping.world_from_head.matrix()(row, column));
    manifest["pings"].push_back({{"fan", "fan_" + number},
                                 {"samples", "samples_" + number},
                                 {"ping", ping.number},
                                 {"time_s", run.start + ping.time},
                                 {"world_from_head", pose}});
  });
  if (!scale) fail(ErrorKind::content, run.options.run, ": has no pings");
  const std::size_t pings = manifest["pings"].size();
  write_manifest(directory, manifest);
  directory.commit();
  return pings;
}

}  // namespace insonify::tool
