// SPDX-License-Identifier: BSD-3-Clause
// A program that is not ours: eight of its threads take memory and locks all the time while others read files of every
// format, which must give what was read before there were threads.
//
//   busy_host SEEDS READS     (folders of tests/fuzz/make_seeds.sh; READS of each format)
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include <insonify/formats/aris_file.hpp>
#include <insonify/formats/oculus_file.hpp>
#include <insonify/formats/xtf_file.hpp>
#include <insonify/scene_io/load_scene.hpp>
#include <insonify/store/cube.hpp>
#include <insonify/store/environment_file.hpp>
#include <insonify/tiles/tiled_scene.hpp>

using namespace insonify;

namespace {

/// A number that differs between two files.
using Read = std::function<double(const std::string& path)>;

double of_scene(const std::string& path) {
  LoadOptions options;
  options.threads = 1;
  double sum = 0;
  const LoadedScene loaded = load_scene(path, options);
  for (std::size_t i = 0; i < loaded.scene.size(); ++i)
    sum += static_cast<double>(i + 1) * loaded.scene.point[i].sum() + loaded.scene.area[i];
  return sum + loaded.scene.origin.sum();
}

double of_cube(const std::string& path) {
  double sum = 0;
  for (const Ping& ping : read_cube(path).pings) sum += ping.pressure.abs().sum();
  return sum;
}

double of_tiles(const std::string& path) {
  const TiledScene tiles(path);
  return tiles.load(tiles.select_all(), 0, 1).point[0].sum() + static_cast<double>(tiles.info().surfels);
}

double of_xtf(const std::string& path) {
  double sum = 0;
  for (const XtfPing& ping : read_xtf(path).pings)
    for (const XtfTrace& trace : ping.traces) sum += std::accumulate(trace.samples.begin(), trace.samples.end(), 0.0);
  return sum;
}

std::map<std::string, Read> readers() {
  std::map<std::string, Read> all = {
      {"cube", of_cube},
      {"tiles", of_tiles},
      {"environment", [](const std::string& path) { return slowest_sound(load_environment(path)); }},
      {"aris", [](const std::string& path) { return level_db(read_aris_frame(path, 0)).sum(); }},
      {"oculus", [](const std::string& path) { return level_db(read_oculus_ping(path, 0)).sum(); }},
      {"xtf", of_xtf}};
  for (const char* format : {"pcd", "ply", "obj", "stl", "vtk", "vtp", "gltf", "glb", "xyz", "pts", "ptx", "dae", "fbx",
                             "off", "x3d", "csv", "asc", "las", "tiff"})
    all[format] = of_scene;
  return all;
}

/// The files of a format and what each gives before there are threads; those that are no scene by themselves are left out.
std::vector<std::pair<std::string, double>> files_of(const std::filesystem::path& folder, const Read& read) {
  std::vector<std::pair<std::string, double>> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) try {
      files.emplace_back(entry.path().string(), read(entry.path().string()));
    } catch (const Error&) {
    }
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::atomic<bool> done = false;
  std::mutex busy;
  std::atomic<std::size_t> wrong = 0, read = 0;
  std::map<std::string, std::vector<std::pair<std::string, double>>> files;
  for (const auto& [format, reader] : readers()) {
    files[format] = files_of(std::filesystem::path(argv[1]) / format, reader);
    if (files[format].empty()) std::cerr << format << ": no file could be read\n", ++wrong;
  }
  std::vector<std::jthread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      while (!done) {
        const std::lock_guard lock(busy);
        std::map<int, std::string> words;
        for (int i = 0; i < 100; ++i) words[i * t % 17] += std::to_string(i);
      }
    });
  {
    std::vector<std::jthread> loading;
    for (const auto& [name, reader] : readers())
      loading.emplace_back([&, format = name, call = reader] {
        const auto& all = files[format];
        for (long i = 0; i < std::atol(argv[2]) && !all.empty(); ++i, ++read) {
          const auto& [path, expected] = all[static_cast<std::size_t>(i) % all.size()];
          try {
            if (const double got = call(path); got != expected)
              std::cerr << path << ": " << got << " instead of " << expected << '\n', ++wrong;
          } catch (const std::exception& error) {
            std::cerr << error.what() << '\n', ++wrong;
          }
        }
      });
  }
  done = true;
  threads.clear();
  std::cout << read << " files read beside eight threads, " << wrong << " wrong\n";
  return wrong == 0 ? 0 : 1;
}
