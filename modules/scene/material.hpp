// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"
#include "scene/surface_law.hpp"

namespace insonify {

/// Acoustic properties of a surface.
struct Material {
  std::string name = "default";
  double lambert_mu = 0.001995262314968880;  ///< [1/sr], cross-section per area and solid angle at normal incidence;
                                             ///< -27 dB: Mackenzie (1961), the usual default for a sea bed. Used by
                                             ///< Lambert's law only
  double coherent_fraction = 0;  ///< fraction of the mean intensity, in [0, 1], that does not fluctuate (E53)
  double relief_slope = 0;       ///< rms slope [rise over run] of relief finer than the surfels (E52); 0: smooth
  double mirror = 0;             ///< 1: its flat parts are mirrors; 0: they are not
  double coherent = 0;           ///< 1: its plates, spheres and cylinders each reflect as one body; 0: they do not
  double reflection = 1;         ///< reflection coefficient of pressure of such mirrors and shapes
  double rms_height = 0;         ///< rms height of their roughness [m]
  SurfaceLaw law{};

  bool operator==(const Material&) const = default;
};

/// Description of one number of a Material, >= 0, for checks, material files, comment lines of clouds, and tiles.
struct MaterialNumber {
  double Material::*member;
  const char* name;       ///< name of the member, for messages
  const char* unit;       ///< "": none
  double most;            ///< [unit] largest valid number; infinity: any finite one
  const char* key;        ///< key in material files
  bool in_decibels;       ///< true: the key holds 10 log10 of the number
  bool required;          ///< true: material files must give it
  double most_in_files;   ///< [unit] largest number in material files
  const char* note;       ///< reason for the limit, for messages; "": none
  const char* help;       ///< description for the docs
  const char* word = "";  ///< word in files for 1, e.g. "true", "fit" (0: the key is absent); "": files give a number
};

/// All numbers of a Material. A new number goes last, so that older files give it its default.
inline constexpr MaterialNumber material_numbers[] = {
    {&Material::lambert_mu, "lambert_mu", "1/sr", std::numeric_limits<double>::infinity(), "lambert_mu_db", true, true,
     1 / pi, "1/pi: no surface sends back more than it receives",
     "Lambert coefficient mu, given as 10 log10(mu / (1/sr)): backscatter of the surface at normal incidence"},
    {&Material::coherent_fraction, "coherent_fraction", "", 1, "coherent_fraction", false, false, 1, "",
     "fraction of the mean intensity that does not fluctuate; 0: full speckle, 1: no speckle"},
    {&Material::relief_slope, "relief_slope", "", std::numeric_limits<double>::infinity(), "relief_slope", false, false,
     1, "rise over run, rms: 45 degrees",
     "rms slope of the relief that is finer than the spacing of the cloud; 0: no such relief"},
    {&Material::mirror, "mirror", "", 1, "mirror", false, false, 1, "",
     "true: the flat parts of this material are mirrors of the scene ([mirrors.md](mirrors.md))", "true"},
    {&Material::coherent, "coherent", "", 1, "coherent", false, false, 1, "",
     "\"fit\": each plate, sphere and cylinder of this material is a calibrated target, which reflects as one body "
     "([mirrors.md](mirrors.md))",
     "fit"},
    {&Material::reflection, "reflection", "", 1, "mirror_reflection", false, false, 1, "",
     "reflection coefficient of pressure of the mirrors and targets of this material"},
    {&Material::rms_height, "rms_height", "m", std::numeric_limits<double>::infinity(), "rms_height_m", false, false, 1,
     "", "rms height of the roughness of the mirrors and targets of this material"},
};

/// Returns true if parts of a material reflect as one body each: mirrors, plates, spheres, cylinders.
inline bool is_smooth(const Material& material) { return material.mirror > 0 || material.coherent > 0; }

/// Throws Error of `kind` unless every number is finite, >= 0 and at most its `most`, and the law is valid
/// (problem_of). If the law has slopes of its own, relief_slope must be 0.
void require_valid(const Material& material, const char* who, ErrorKind kind = ErrorKind::argument);

}  // namespace insonify
