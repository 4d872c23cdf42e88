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
#include "tool/dataset_runs.hpp"
#include "tool/label_pictures.hpp"
#include "tool/options.hpp"

namespace insonify::tool {

/// Options of `dataset`.
struct DatasetOptions {
  CommonOptions common;
  std::vector<std::string> runs;
  std::string output, window;
  double share = least_label_share;  ///< of a pixel's energy, at least, for its class
  int least_pixels = 20;             ///< of an object
  int columns = 512;                 ///< of fan pictures
  double tvg = 40;                   ///< [dB per decade of range]
  bool raw = false;                  ///< no TVG
  std::vector<std::string> stuff;    ///< materials that are in masks alone
  std::string row;                   ///< of heads with several rows of beams: a number, all, or empty: the middle one
  std::string split = "80:10:10";
  bool force = false;
};

/// Writes images, masks, boxes and lists of a data set into a folder.
class DatasetWriter {
 public:
  /// `classes` are the names of the masks' values: nothing, shadow, then materials.
  DatasetWriter(const RunDirectory& directory, const DatasetOptions& options, std::vector<std::string> classes,
                GreyWindow window);

  /// Adds a ping of one row of beams: `row` of its head, if that has several.
  void add(const DatasetSource& source, const Cube& cube, const Ping& ping, const std::string& name,
           std::optional<std::size_t> row = {});
  /// Writes what lists all images. Throws Error(content) if no pixel of any image shows a surface.
  void finish();

  std::size_t images() const { return images_; }
  std::size_t annotations() const { return annotations_; }

 private:
  /// One of the two forms of the images, polar or fan.
  struct Form {
    std::string name;
    std::map<std::string, nlohmann::ordered_json> coco{};  ///< of each split
    std::map<std::string, std::string> lists{};
    std::vector<std::size_t> pixels{};  ///< of each class
  };
  void add_form(Form& form, const DatasetSource& source, const std::string& name, const LabelMap& map);
  void add_meta(const DatasetSource& source, const Cube& cube, const Ping& ping, const std::string& name,
                std::optional<std::size_t> row, const LabelMap& map);
  nlohmann::ordered_json empty_coco() const;
  std::string card() const;
  const FanRaster& raster_of(const Ping& ping);

  const RunDirectory& directory_;
  const DatasetOptions& options_;
  std::vector<std::string> classes_;
  GreyWindow window_;
  std::size_t images_ = 0, annotations_ = 0;
  Form polar_{"polar"}, fan_{"fan"};
  std::string meta_, sonars_;
  std::map<std::string, FanRaster> rasters_;
};

/// Levels of a ping as the images show them: with the options' TVG.
Grid<float> dataset_levels(const Ping& ping, const DatasetOptions& options);

}  // namespace insonify::tool
