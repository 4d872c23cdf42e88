// SPDX-License-Identifier: BSD-3-Clause
#include "formats/swath_record.hpp"

#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "core/text.hpp"
#include "files/path_status.hpp"
#include "formats/gsf_record.hpp"
#include "formats/kmall_record.hpp"
#include "formats/r2sonic_record.hpp"

namespace insonify {
namespace {

struct SwathReader {
  const char* ending;
  SwathRecord (*read)(const std::string& path);
};
constexpr SwathReader swath_readers[] = {{".gsf", [](const std::string& path) { return swath_of(read_gsf(path)); }},
                                         {".kmall", read_kmall},
                                         {".xtf", read_r2sonic_xtf}};

const SwathReader* swath_reader_of(const std::string& path) {
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  for (const SwathReader& reader : swath_readers)
    if (ending == reader.ending) return &reader;
  return nullptr;
}

}  // namespace

double swath_angle(const SwathSounding& sounding, double head_depth) {
  return std::atan2(sounding.across, sounding.depth - head_depth);  // (E210)
}

SwathRecord read_swath(const std::string& path) {
  if (const SwathReader* reader = swath_reader_of(path)) return reader->read(path);
  fail(ErrorKind::argument, path, ": is no swath; those end with .gsf, .kmall or .xtf");
}

bool is_swath(const std::string& path) {
  const SwathReader* reader = swath_reader_of(path);
  if (!reader) return false;
  return reader->read != read_r2sonic_xtf || is_bathymetry_xtf(path);
}

}  // namespace insonify
