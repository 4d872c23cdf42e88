// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "formats/label_map.hpp"
#include "returns/picture_grid.hpp"
#include "returns/quantise.hpp"
#include "tool/dataset/contact_sheet.hpp"
#include "tool/dataset/dataset_form.hpp"
#include "tool/dataset/dataset_options.hpp"
#include "tool/dataset/dataset_runs.hpp"
#include "tool/dataset/dataset_split.hpp"
#include "tool/dataset/labelled_image.hpp"
#include "tool/dataset/part_objects.hpp"

namespace insonify::tool {

/// Writes images, masks, boxes and lists of a data set into a folder.
class DatasetWriter {
 public:
  /// `classes` are the names of the masks' values: nothing, shadow, then materials.
  DatasetWriter(const RunDirectory& directory, const DatasetOptions& options, std::vector<std::string> classes,
                GreyWindow window);

  /// Adds a ping of one row of beams.
  void add(const DatasetSource& source, const Cube& cube, const Ping& ping, const DatasetImage& image);
  /// Writes what lists all images. Throws Error(content) if no pixel of any image shows a surface.
  void finish();

  std::size_t images() const { return images_; }
  /// Boxes of a form, polar or fan.
  std::size_t boxes_of_polar() const { return polar_.boxes; }
  std::size_t boxes_of_fan() const { return fan_.boxes; }
  /// Objects without a box, since their contrast is too small.
  std::size_t unboxed_of_polar() const { return polar_.unboxed; }
  std::size_t unboxed_of_fan() const { return fan_.unboxed; }
  const SplitTally& tally() const { return tally_; }
  /// Boxes by class, part and form, of all parts that have images.
  nlohmann::ordered_json boxes_by_class() const { return tool::boxes_by_class({&polar_, &fan_}, classes_); }

 private:
  /// How a form shows a ping.
  struct FormOf {
    PictureOf picture;
    LabelMap map;
    Grid<float> level_db;
    const ObjectsOf& objects;
  };
  /// Writes one image; returns the contrasts of its objects, and what has no box for it.
  struct Contrasts {
    std::map<std::uint16_t, std::optional<double>> of{};
    nlohmann::ordered_json unboxed = nlohmann::ordered_json::array();
  };
  Contrasts add_form(DatasetForm& form, const DatasetImage& image, const FormOf& of);
  nlohmann::ordered_json annotation_of(const Annotation& a, const FormOf& of, std::optional<double> contrast);
  /// Keeps what card and manifest say of the sources of all images.
  void note_source(const DatasetSource& source, const Cube& cube, const Ping& ping);
  const FanRaster& raster_of(const Ping& ping);

  const RunDirectory& directory_;
  const DatasetOptions& options_;
  std::vector<std::string> classes_;
  GreyWindow window_;
  std::size_t images_ = 0, annotations_ = 0;
  DatasetForm polar_{"polar"}, fan_{"fan"};
  std::string meta_, sonars_;
  ContactSheet sheet_;                      ///< sheet of fan images
  std::vector<Annotation> boxed_of_sheet_;  ///< annotations of the image that was added last
  nlohmann::ordered_json renumbered_ = nlohmann::ordered_json::object();  ///< ids given to instances, by scene
  std::map<std::string, FanRaster> rasters_;
  SplitTally tally_;
};

/// Levels of a ping as the images show them: with the options' TVG.
Grid<float> dataset_levels(const Ping& ping, const DatasetOptions& options);

}  // namespace insonify::tool
