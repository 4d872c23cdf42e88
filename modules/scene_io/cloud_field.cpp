// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/cloud_field.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/message.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {

CloudField load_cloud_field(const std::string& path, const std::string& field) {
  ReadOptions options;
  options.extra_field = field;
  const RawCloud raw = read_cloud(path, options);
  if (raw.extra.size() != raw.point.size())
    fail(ErrorKind::content, path, ": has no field '", field, "'; it has ",
         shortened_list(raw.fields, ", ", [](const auto& f) { return f.name; }));
  CloudField cloud;
  for (std::size_t i = 0; i < raw.point.size(); ++i) {
    if (!raw.point[i].allFinite() || !std::isfinite(raw.extra[i])) continue;
    cloud.position.push_back(raw.origin + raw.point[i].cast<double>());
    cloud.value.push_back(raw.extra[i]);
    cloud.id.push_back(raw.id.empty() ? static_cast<std::uint32_t>(i) : raw.id[i]);
  }
  if (cloud.value.empty()) fail(ErrorKind::content, path, ": no point has a finite '", field, "'");
  return cloud;
}

bool has_cloud_field(const std::string& path, const std::string& field) {
  const RawCloud raw = read_cloud(path, {});
  return std::any_of(raw.fields.begin(), raw.fields.end(), [&](const auto& f) { return f.name == field; });
}

}  // namespace insonify
