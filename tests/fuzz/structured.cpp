// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/structured.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

#include <unistd.h>

#include "files/sha256.hpp"
#include "support/tile_parts.hpp"

namespace fs = std::filesystem;

namespace insonify {

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

namespace {

/// Puts a number that is extreme, or near the one that is there, into an array of numbers of this type.
template <typename Number>
void poke(std::span<char> bytes, const DamageSource& source) {
  const std::size_t count = bytes.size() / sizeof(Number);
  if (count == 0) return;
  char* const at = bytes.data() + source.below(count) * sizeof(Number);
  Number value;
  std::memcpy(&value, at, sizeof value);
  using Limits = std::numeric_limits<Number>;
  if constexpr (std::is_floating_point_v<Number>) {
    const Number values[] = {Limits::quiet_NaN(),
                             Limits::infinity(),
                             -Limits::infinity(),
                             Limits::max(),
                             Limits::denorm_min(),
                             0,
                             -1,
                             1,
                             static_cast<Number>(1e9),
                             static_cast<Number>(1e30),
                             -value,
                             2 * value,
                             value / 1000,
                             std::nextafter(value, Limits::max())};
    value = values[source.below(std::size(values))];
  } else {
    const Number values[] = {0,
                             1,
                             2,
                             Limits::max(),
                             Limits::max() / 2 + 1,
                             static_cast<Number>(value + 1),
                             static_cast<Number>(value - 1),
                             static_cast<Number>(2 * value),
                             static_cast<Number>(source.below(64)),
                             static_cast<Number>(source.below(4096))};
    value = values[source.below(std::size(values))];
  }
  std::memcpy(at, &value, sizeof value);
}

/// Replaces a child by another row or node, or gives a node the children of another one.
void relink(TileParts& parts, const DamageSource& source) {
  if (parts.node.empty() || parts.child.empty()) return;
  TileNode& node = parts.node[source.below(parts.node.size())];
  const TileNode& other = parts.node[source.below(parts.node.size())];
  std::uint32_t& child = parts.child[source.below(parts.child.size())];
  switch (source.below(6)) {
    case 0:
      child = parts.child[source.below(parts.child.size())];
      break;
    case 1:
      child = static_cast<std::uint32_t>(parts.rows.size() + source.below(parts.node.size() + 1));
      break;
    case 2:
      node.first_child = other.first_child, node.children = other.children;
      break;
    case 3:
      node.children = static_cast<std::uint16_t>(source.below(9));
      break;
    case 4:
      node.first_child = static_cast<std::uint32_t>(source.below(parts.child.size() + 1));
      break;
    default:
      std::swap(node, parts.node[source.below(parts.node.size())]);
  }
}

void damage(TileParts& parts, const DamageSource& source) {
  TileDirectory& d = parts.directory;
  const auto poke_number = [&](std::span<char> bytes) {
    source.below(2) ? poke<float>(bytes, source) : poke<std::uint32_t>(bytes, source);
  };
  const auto poke_wide = [&](std::span<char> bytes) {
    source.below(2) ? poke<double>(bytes, source) : poke<std::uint64_t>(bytes, source);
  };
  const std::vector<std::function<void()>> ways = {
      [&] { poke<float>(bytes_in(parts.rows.point), source); },
      [&] { poke<float>(bytes_in(parts.rows.normal), source); },
      [&] { poke<float>(bytes_in(parts.rows.area), source); },
      [&] { poke<std::uint32_t>(bytes_in(parts.rows.id), source); },
      [&] { poke<std::uint16_t>(bytes_in(parts.rows.material), source); },
      [&] { poke_number(bytes_in(parts.node)); },
      [&] { poke<std::uint16_t>(bytes_in(parts.node), source); },
      [&] { poke<std::uint32_t>(bytes_in(parts.child), source); },
      [&] { relink(parts, source); },
      [&] { relink(parts, source); },
      [&] { source.below(2) ? poke_number(bytes_in(d.forests)) : poke_wide(bytes_in(d.forests)); },
      [&] { source.below(2) ? poke_number(bytes_in(d.tiles)) : poke_wide(bytes_in(d.tiles)); },
      [&] {
        poke<double>({reinterpret_cast<char*>(d.info.origin.data()), 24}, source);
      },
      [&] {
        poke<double>({reinterpret_cast<char*>(&d.info.box), sizeof(Bounds)}, source);
      },
      [&] {
        poke<double>({reinterpret_cast<char*>(&d.info.total_area), 8}, source);
      },
      [&] {
        poke<double>({reinterpret_cast<char*>(&d.info.materials.at(0).lambert_mu), 8}, source);
      },
  };
  ways[source.below(ways.size())]();
}

/// Files by their names.
using Files = std::vector<std::pair<std::string, std::string>>;

Files files_in_one(const std::string& bytes) {
  Files files;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = bytes.find('\n', at);
    if (end == bytes.npos) break;
    std::istringstream line(bytes.substr(at, end - at));
    std::string name;
    std::size_t size = 0;
    if (!(line >> name >> size)) break;
    files.emplace_back(name, bytes.substr(end + 1, size));
    at = end + 1 + std::min(size, bytes.size() - end - 1);
  }
  return files;
}

std::string in_one(const Files& files) {
  std::string bytes;
  for (const auto& [name, content] : files) bytes += name + " " + std::to_string(content.size()) + "\n" + content;
  return bytes;
}

/// Writes the present digests of blocks into their marks.
void renew_marks(Files& files) {
  const auto content_of = [&](const std::string& name) -> std::string* {
    for (auto& [other, content] : files)
      if (other == name) return &content;
    return nullptr;
  };
  for (const auto& [name, content] : Files(files)) {
    if (!name.ends_with(".done")) continue;
    const std::string stem = name.substr(0, name.size() - 5);
    for (const auto& [key, ending] : {std::pair("cube_sha256 = \"", ".h5"), std::pair("returns_sha256 = \"", ".ply")}) {
      std::string& mark = *content_of(name);
      const std::string* const block = content_of(stem + ending);
      const std::size_t at = mark.find(key), digits = 64;
      if (block && at != mark.npos && mark.size() >= at + std::strlen(key) + digits)
        mark.replace(at + std::strlen(key), digits, sha256_of(*block));
    }
  }
}

bool stays_below(const std::string& name) {
  const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("._-/", c); };
  return !name.empty() && name.front() != '/' && name.back() != '/' && name.find("..") == name.npos &&
         std::all_of(name.begin(), name.end(), plain);
}

}  // namespace

std::string damage_tiles(const std::string& bytes, const DamageSource& source) {
  static std::map<std::string, TileParts> known;  // by the bytes of the seed
  const std::string path = fs::temp_directory_path() / ("insonify-damaged-" + std::to_string(getpid()) + ".tiles");
  if (!known.contains(bytes)) {
    write_bytes(path, bytes);
    known.emplace(bytes, load_tile_parts(path));
  }
  TileParts parts = known.at(bytes);
  for (std::size_t left = 1 + source.below(3); left > 0; --left) damage(parts, source);
  save_tile_parts(std::move(parts), path);
  const std::string damaged = bytes_of(path);
  fs::remove(path);
  return damaged;
}

std::string damage_folder(const std::string& bytes, const DamageSource& source) {
  Files files = files_in_one(bytes);
  for (std::size_t left = 1 + source.below(2); left > 0 && !files.empty(); --left) {
    // Another mission or scene makes another survey, which is refused at once: mostly its own folder is damaged.
    std::size_t chosen = source.below(files.size());
    while (!files[chosen].first.starts_with("run/") && source.below(8) > 0) chosen = source.below(files.size());
    std::string& content = files[chosen].second;
    switch (source.below(6)) {
      case 0:
        content.resize(source.below(content.size() + 1));
        break;
      case 1:
        content.assign(content.size(), '\0');
        break;
      case 2:
        content = files[source.below(files.size())].second;
        break;
      case 3:
        files.erase(files.begin() + static_cast<std::ptrdiff_t>(chosen));
        break;
      default:
        content = source.at_random(content);
    }
  }
  if (source.below(2)) renew_marks(files);
  return in_one(files);
}

void unpack_folder(const std::string& bytes, const std::string& folder) {
  for (const auto& [name, content] : files_in_one(bytes)) {
    if (!stays_below(name)) continue;
    std::error_code ignored;
    fs::create_directories((fs::path(folder) / name).parent_path(), ignored);
    write_bytes(fs::path(folder) / name, content);
  }
}

}  // namespace insonify
