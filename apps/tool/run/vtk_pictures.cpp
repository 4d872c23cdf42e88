// SPDX-License-Identifier: BSD-3-Clause
#include "tool/run/vtk_pictures.hpp"

#include "view/ping_record.hpp"
#include "view/save_vtk.hpp"
#include "view/show_image.hpp"

namespace insonify::tool {

void VtkPictures::draw_fan(const Ping& ping, const std::string& title, const std::string& path) const {
  PictureOptions options;
  options.title = title;
  options.trim = true;
  show_fan(level_image(ping, Tvg{40, ping.absorption_db_per_m}), options, path);
}

void VtkPictures::write_paths(const SoundPaths& paths, const std::string& path) const {
  LineSet lines{paths.points, {{"level_db", paths.level_db}, {"bounces", {}}}};
  lines.fields[1].values.assign(paths.bounces.begin(), paths.bounces.end());
  save_lines(path, lines);
}

}  // namespace insonify::tool
