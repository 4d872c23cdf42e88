#pragma once
#include <cstdint>

namespace insonify {

/// Version of the layout of cube.h5; raised when a reader of the old one would go wrong.
constexpr std::int64_t cube_schema = 1;

/// Place of a dataset in the file and its unit, kept in its attribute "units" ("": none).
struct DatasetName {
  const char* path;
  const char* unit;
};
constexpr DatasetName pressure_name{"/pressure", "Pa"};
/// Group of the layers, each a dataset like /pressure; absent if none were kept.
constexpr const char* layers_group = "/layers";
/// Optional maps like /pressure, of one real number per cell.
constexpr DatasetName level_error_name{"/level_error_db", "dB"};
constexpr DatasetName unknown_name{"/unknown", ""};
/// Root attribute of a cube whose pressures are roots of expected intensities; absent from all others.
constexpr const char* expected_level_attribute = "expected_level";
constexpr const char* expected_level_text = "expected level, no speckle";
constexpr DatasetName range_name{"/range", "m"};
constexpr DatasetName azimuth_name{"/azimuth", "rad"};
constexpr DatasetName elevation_name{"/elevation", "rad"};
constexpr DatasetName pose_name{"/pose", "m"};
constexpr DatasetName time_name{"/time", "s"};
constexpr DatasetName ping_name{"/ping", ""};

}  // namespace insonify
