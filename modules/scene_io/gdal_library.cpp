// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <dlfcn.h>

#include "core/error.hpp"
#include "scene_io/gdal_library_internal.hpp"

namespace insonify {

void* find_in_gdal(const char* name) {
  static void* const library = dlopen(INSONIFY_GDAL, RTLD_LAZY | RTLD_LOCAL);
  if (!library)
    fail(ErrorKind::runtime, "GDAL's library ", INSONIFY_GDAL,
         ", which reads rasters and projects places, is not there; install ",
         "libgdal32 or what holds it, or do without: gdal2xyz.py -csv in.tif out.xyz, no --crs");
  void* const function = dlsym(library, name);
  if (!function)
    fail(ErrorKind::runtime, INSONIFY_GDAL, " lacks ", name, "; install the GDAL that insonify was built with");
  return function;
}

std::string beginning_in_zip(const std::string& zip, const std::string& name, std::size_t most) {
  const GdalReading reading;
  VSILFILE* const file = VSIFOpenL(("/vsizip/{" + zip + "}/" + name).c_str(), "rb");
  if (!file) return {};
  std::string begin(most, '\0');
  begin.resize(VSIFReadL(begin.data(), 1, most, file));
  VSIFCloseL(file);
  return begin;
}

}  // namespace insonify
