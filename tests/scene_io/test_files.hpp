// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene_io/load_scene.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace insonify {

/// Returns the bytes of a number, most significant first if `big`.
template <typename T>
std::string bytes_of(T value, bool big = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// Returns the text of a square plate of `side` x `side` points in z = `height`, `spacing` apart, from (x0, y0).
inline std::string plate_text(int side, double spacing, double x0 = 0, double y0 = 0, double height = 0) {
  std::ostringstream text;
  text.precision(17);
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) text << x0 + i * spacing << ' ' << y0 + j * spacing << ' ' << height << '\n';
  }
  return text.str();
}

/// Returns the sum of the areas of the triangles of a mesh [m^2].
inline double area_of_mesh(const LoadedScene& loaded) {
  double sum = 0;
  for (std::size_t t = 0; t < loaded.mesh->triangle.size(); ++t) sum += area_of(corners_of(*loaded.mesh, t));
  return sum;
}

/// Returns a caller's statement about one item of a file's meaning.
inline MeaningOverride meaning_override(const std::string& key, const std::string& text) {
  MeaningOverride said;
  std::ranges::find(meaning_options(), key, &MeaningOption::key)->parse(text, said);
  return said;
}

inline bool has_note(const LoadReport& report, const std::string& part) {
  return std::any_of(report.notes.begin(), report.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace insonify
