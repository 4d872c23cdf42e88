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

/// Writes contributors.h5 in bands of beams, so that memory holds only one band:
///
///   beams x bins x per_pixel   /surfel, /id (uint32), /share, /elevation (float32), /material (uint16), /path (uint8);
///                              with double echoes also /surfel_before (uint32)
///   beams x bins               the label images /material_image (uint16) and /instance_image (uint32), e.g. the
///                              material of the strongest contributor, and connected parts of one material from 1
///   text                       /material_names
///   root attributes            schema, content "contributors", and paths, the meaning of the numbers of /path
///
/// Unused entries have surfel and id 4294967295 and material 65535. The same input gives the same bytes. The file is
/// written to a temporary name, then renamed. Throws Error(argument) for invalid contributors or a material without a
/// name, Error(file) if it cannot write.
class ContributorFile {
 public:
  /// Begins a file for beams x bins x per_pixel entries and the names of the materials. With `two_surfaces` it has
  /// /surfel_before, for double echoes.
  ContributorFile(const std::string& path, std::size_t beams, std::size_t bins, std::size_t per_pixel,
                  const std::vector<std::string>& materials, bool two_surfaces = false);
  ~ContributorFile();
  ContributorFile(const ContributorFile&) = delete;
  ContributorFile& operator=(const ContributorFile&) = delete;

  /// Writes the contributors of beams from `first_beam` on.
  void write(const Contributors& band, std::size_t first_beam);
  /// Writes the label images of all beams, e.g. material_image and instance_image of the ping's labels, and gives the
  /// file its final name. Without this call no file remains.
  void finish(const Grid<std::uint16_t>& material_image, const Grid<std::uint32_t>& instance_image);

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

/// Returns the contents of a file of ContributorFile, bit for bit. Throws Error(file) if it is missing,
/// Error(content) if it is not such a file, has another schema or lacks a dataset, naming that.
NamedContributors read_contributor_file(const std::string& path);

/// Returns the memory that the contributors of a file take [bytes]. Throws as read_contributor_file.
std::uintmax_t contributor_bytes(const std::string& path);

}  // namespace insonify
