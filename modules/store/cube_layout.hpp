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
constexpr DatasetName range_name{"/range", "m"};
constexpr DatasetName azimuth_name{"/azimuth", "rad"};
constexpr DatasetName elevation_name{"/elevation", "rad"};
constexpr DatasetName pose_name{"/pose", "m"};
constexpr DatasetName time_name{"/time", "s"};
constexpr DatasetName ping_name{"/ping", ""};

}  // namespace insonify
