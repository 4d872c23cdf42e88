#include <string>

#include <dlfcn.h>

#include "core/error.hpp"
#include "scene_io/gdal_library_internal.hpp"

namespace insonify {

void* find_in_gdal(const char* name) {
  static void* const library = dlopen(INSONIFY_GDAL, RTLD_LAZY | RTLD_LOCAL);
  if (!library)
    fail(ErrorKind::runtime, "rasters are read by GDAL, whose library ", INSONIFY_GDAL,
         " is not there; install it, or convert the raster: gdal2xyz.py -csv in.tif out.xyz");
  void* const function = dlsym(library, name);
  if (!function)
    fail(ErrorKind::runtime, INSONIFY_GDAL, " lacks ", name, "; install the GDAL that insonify was built with");
  return function;
}

}  // namespace insonify
