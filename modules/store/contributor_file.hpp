// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "returns/contributors.hpp"

namespace insonify {

/// The contents of contributors.h5: contributors, and the names of the scene's materials by index.
struct NamedContributors {
  Contributors contributors;
  std::vector<std::string> materials;
};

/// Writes /surfel, /id (uint32), /share, /elevation (float32), /material (uint16) and /path (uint8) as beams x bins x
/// per_pixel, with echoes by way of two surfaces also /surfel_before (uint32), the label images /material_image (uint16) and /instance_image (uint32) as beams x bins, /material_names
/// (text), and the root attributes schema, content "contributors" and paths, the meaning of the numbers of /path.
/// Unused entries have surfel and id 4294967295 and material 65535. The images are of the strongest contributors: their
/// material, and connected parts of one material, from 1. Byte-identical for identical input.
/// Written to a temporary name, then renamed. Throws Error(argument) for invalid contributors or a material without a
/// name, Error(file) if it cannot write.
void write_contributor_file(const std::string& path, const NamedContributors& named);

/// The same file, written in bands of beams, so that memory need not hold all of them. Throws as
/// write_contributor_file.
class ContributorFile {
 public:
  /// Begins a file for beams x bins x per_pixel entries, and the names of the materials; with /surfel_before if there
  /// may be echoes by way of two surfaces.
  ContributorFile(const std::string& path, std::size_t beams, std::size_t bins, std::size_t per_pixel,
                  const std::vector<std::string>& materials, bool two_surfaces = false);
  ~ContributorFile();
  ContributorFile(const ContributorFile&) = delete;
  ContributorFile& operator=(const ContributorFile&) = delete;

  /// Writes the contributors of beams from `first_beam` on.
  void write(const Contributors& band, std::size_t first_beam);
  /// Writes the label images of all beams, material_image and instance_image of the ping's labels, say, and gives the
  /// file its name; without this call nothing is left.
  void finish(const Grid<std::uint16_t>& material_image, const Grid<std::uint32_t>& instance_image);

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

/// Reads what write_contributor_file wrote, bit for bit. Throws Error(file) if missing, Error(content) if it is not
/// such a file, has another schema or lacks a dataset, naming it.
NamedContributors read_contributor_file(const std::string& path);

/// Bytes of memory that the contributors of a file take; errors as read_contributor_file.
std::uintmax_t contributor_bytes(const std::string& path);

}  // namespace insonify
