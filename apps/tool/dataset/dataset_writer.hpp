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
#include "store/run_directory.hpp"
#include "tool/command/options.hpp"
#include "tool/dataset/contact_sheet.hpp"
#include "tool/dataset/dataset_runs.hpp"
#include "tool/dataset/dataset_split.hpp"
#include "tool/dataset/label_pictures.hpp"
#include "tool/dataset/part_objects.hpp"

namespace insonify::tool {

/// Options of `dataset`.
struct DatasetOptions {
  CommonOptions common;
  std::vector<std::string> runs;
  std::string output, window;
  double share = least_label_share;  ///< of a pixel's energy, at least, for its class
  std::string min_level;             ///< [dB] or black, below which surfaces have no class; empty: none
  int least_pixels = 20;             ///< of an object
  double min_contrast = 3;           ///< [dB] of an object to what is around it, for a box
  int columns = 512;                 ///< of fan pictures
  double tvg = 40;                   ///< [dB per decade of range]
  bool raw = false;                  ///< no TVG
  std::vector<std::string> stuff;    ///< classes that are in masks alone
  std::vector<std::string> things;   ///< classes that have boxes although they have none by default: shadow
  bool polygons = false;             ///< outlines beside the masks of COCO
  std::string row;                   ///< of heads with several rows of beams: a number, all, or empty: the middle one
  std::string split = "80:10:10", split_by = "scene";
  bool force = false;
};

/// An image of a data set.
struct DatasetImage {
  std::string name, split;           ///< split: train, val or test
  std::optional<std::size_t> row{};  ///< of its head's beams, if that has several
};

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
  nlohmann::ordered_json boxes_by_class() const;

 private:
  /// One of the two forms of the images, polar or fan.
  struct Form {
    std::string name;
    std::map<std::string, nlohmann::ordered_json> coco{};  ///< of each split
    std::map<std::string, std::string> lists{};
    std::vector<std::size_t> pixels{};                         ///< of each class
    std::size_t boxes = 0, unboxed = 0;                        ///< unboxed: objects of too little contrast
    std::map<std::string, nlohmann::ordered_json> outlines{};  ///< of each split: polygons of its annotations, in order
  };
  /// The objects of a ping, in either form.
  struct ObjectsOf {
    std::map<std::uint16_t, std::size_t> parts;       ///< of a scene of parts
    std::uint32_t most_given = 0;                     ///< objects of larger numbers are connected pixels
    std::map<std::uint16_t, std::uint8_t> classes{};  ///< that of most pixels of the polar image
  };
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
  Contrasts add_form(Form& form, const DatasetImage& image, const FormOf& of);
  nlohmann::ordered_json annotation_of(const Annotation& a, const FormOf& of, std::optional<double> contrast);
  nlohmann::ordered_json meta_of(const DatasetSource& source, const Cube& cube, const Ping& ping,
                                 const DatasetImage& image, const LabelMap& map);
  nlohmann::ordered_json empty_coco() const;
  std::vector<std::size_t> boxed_classes() const;
  void write_lists(Form& form, const std::vector<std::size_t>& boxed) const;
  std::string card() const;
  std::string yolo_yaml(const Form& form, const std::vector<std::size_t>& boxed) const;
  const FanRaster& raster_of(const Ping& ping);
  /// Whether objects of a class have boxes.
  bool is_thing(std::size_t category) const;

  const RunDirectory& directory_;
  const DatasetOptions& options_;
  std::vector<std::string> classes_;
  GreyWindow window_;
  std::size_t images_ = 0, annotations_ = 0;
  Form polar_{"polar"}, fan_{"fan"};
  std::string meta_, sonars_;
  ContactSheet sheet_;                                                    ///< of fan images
  std::vector<Annotation> boxed_of_sheet_;                                ///< of the image that was added last
  nlohmann::ordered_json renumbered_ = nlohmann::ordered_json::object();  ///< ids given to instances, by scene
  std::map<std::string, FanRaster> rasters_;
  SplitTally tally_;
};

/// Levels of a ping as the images show them: with the options' TVG.
Grid<float> dataset_levels(const Ping& ping, const DatasetOptions& options);

}  // namespace insonify::tool
