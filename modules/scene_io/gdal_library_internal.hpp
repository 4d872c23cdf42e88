// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include "core/library_turn.hpp"

// Private to scene_io: GDAL by its own names, from a library that is loaded when the first of its functions is called.
// If GDAL were linked, it and its seventy libraries would take 0.1 s at every start of a program.
namespace insonify {

/// Returns the address of a function of GDAL. Throws Error(runtime) if the library is missing or lacks it.
void* find_in_gdal(const char* name);

/// A function of GDAL that is called as its header declares it.
template <auto& function>
struct GdalFunction {
  const char* name;
  operator decltype (&function)() const { return reinterpret_cast<decltype(&function)>(find_in_gdal(name)); }
};

#define INSONIFY_GDAL_FUNCTION(name) \
  inline constexpr GdalFunction<::name> name { #name }
INSONIFY_GDAL_FUNCTION(CPLErrorReset);
INSONIFY_GDAL_FUNCTION(CPLGetLastErrorMsg);
INSONIFY_GDAL_FUNCTION(CPLPopErrorHandler);
INSONIFY_GDAL_FUNCTION(CPLPushErrorHandler);
INSONIFY_GDAL_FUNCTION(CPLQuietErrorHandler);
INSONIFY_GDAL_FUNCTION(CSLDestroy);
INSONIFY_GDAL_FUNCTION(CPLSetThreadLocalConfigOption);
INSONIFY_GDAL_FUNCTION(GDALAllRegister);
INSONIFY_GDAL_FUNCTION(GDALAttributeReadAsDoubleArray);
INSONIFY_GDAL_FUNCTION(GDALAttributeReadAsString);
INSONIFY_GDAL_FUNCTION(GDALAttributeRelease);
INSONIFY_GDAL_FUNCTION(GDALClose);
INSONIFY_GDAL_FUNCTION(GDALDatasetGetRootGroup);
INSONIFY_GDAL_FUNCTION(GDALDimensionGetIndexingVariable);
INSONIFY_GDAL_FUNCTION(GDALDimensionGetSize);
INSONIFY_GDAL_FUNCTION(GDALGetDataTypeName);
INSONIFY_GDAL_FUNCTION(GDALGetDatasetDriver);
INSONIFY_GDAL_FUNCTION(GDALGetDescription);
INSONIFY_GDAL_FUNCTION(GDALGetDriverShortName);
INSONIFY_GDAL_FUNCTION(GDALGetGeoTransform);
INSONIFY_GDAL_FUNCTION(GDALGetMaskBand);
INSONIFY_GDAL_FUNCTION(GDALGetMaskFlags);
INSONIFY_GDAL_FUNCTION(GDALGetMetadataItem);
INSONIFY_GDAL_FUNCTION(GDALGetRasterBand);
INSONIFY_GDAL_FUNCTION(GDALGetRasterCount);
INSONIFY_GDAL_FUNCTION(GDALGetRasterDataType);
INSONIFY_GDAL_FUNCTION(GDALGetRasterNoDataValue);
INSONIFY_GDAL_FUNCTION(GDALGetRasterOffset);
INSONIFY_GDAL_FUNCTION(GDALGetRasterScale);
INSONIFY_GDAL_FUNCTION(GDALGetRasterUnitType);
INSONIFY_GDAL_FUNCTION(GDALGetRasterXSize);
INSONIFY_GDAL_FUNCTION(GDALGetRasterYSize);
INSONIFY_GDAL_FUNCTION(GDALGetSpatialRef);
INSONIFY_GDAL_FUNCTION(GDALGroupGetMDArrayNames);
INSONIFY_GDAL_FUNCTION(GDALGroupOpenMDArray);
INSONIFY_GDAL_FUNCTION(GDALGroupRelease);
INSONIFY_GDAL_FUNCTION(GDALMDArrayAsClassicDataset);
INSONIFY_GDAL_FUNCTION(GDALMDArrayGetAttribute);
INSONIFY_GDAL_FUNCTION(GDALMDArrayGetDimensions);
INSONIFY_GDAL_FUNCTION(GDALMDArrayGetView);
INSONIFY_GDAL_FUNCTION(GDALMDArrayRelease);
INSONIFY_GDAL_FUNCTION(GDALOpenEx);
INSONIFY_GDAL_FUNCTION(GDALRasterIO);
INSONIFY_GDAL_FUNCTION(GDALReleaseDimensions);
INSONIFY_GDAL_FUNCTION(GDALGetCacheMax64);
INSONIFY_GDAL_FUNCTION(GDALSetCacheMax64);
INSONIFY_GDAL_FUNCTION(OCTCoordinateTransformationOptionsSetBallparkAllowed);
INSONIFY_GDAL_FUNCTION(OCTDestroyCoordinateTransformation);
INSONIFY_GDAL_FUNCTION(OCTDestroyCoordinateTransformationOptions);
INSONIFY_GDAL_FUNCTION(OCTNewCoordinateTransformationEx);
INSONIFY_GDAL_FUNCTION(OCTNewCoordinateTransformationOptions);
INSONIFY_GDAL_FUNCTION(OCTTransform);
INSONIFY_GDAL_FUNCTION(OSRAxisEnumToName);
INSONIFY_GDAL_FUNCTION(OSRDestroySpatialReference);
INSONIFY_GDAL_FUNCTION(OSRExportToWkt);
INSONIFY_GDAL_FUNCTION(OSRGetAreaOfUse);
INSONIFY_GDAL_FUNCTION(OSRGetAuthorityCode);
INSONIFY_GDAL_FUNCTION(OSRGetAuthorityName);
INSONIFY_GDAL_FUNCTION(OSRGetAxis);
INSONIFY_GDAL_FUNCTION(OSRGetLinearUnits);
INSONIFY_GDAL_FUNCTION(OSRGetName);
INSONIFY_GDAL_FUNCTION(OSRGetTargetLinearUnits);
INSONIFY_GDAL_FUNCTION(OSRImportFromEPSG);
INSONIFY_GDAL_FUNCTION(OSRImportFromWkt);
INSONIFY_GDAL_FUNCTION(OSRIsCompound);
INSONIFY_GDAL_FUNCTION(OSRIsGeocentric);
INSONIFY_GDAL_FUNCTION(OSRIsGeographic);
INSONIFY_GDAL_FUNCTION(OSRIsProjected);
INSONIFY_GDAL_FUNCTION(OSRNewSpatialReference);
INSONIFY_GDAL_FUNCTION(OSRSetAxisMappingStrategy);
INSONIFY_GDAL_FUNCTION(VSIFCloseL);
INSONIFY_GDAL_FUNCTION(VSIFileFromMemBuffer);
INSONIFY_GDAL_FUNCTION(VSIFOpenL);
INSONIFY_GDAL_FUNCTION(VSIFReadL);
INSONIFY_GDAL_FUNCTION(VSIFree);
#undef INSONIFY_GDAL_FUNCTION

/// Keeps GDAL from printing, and keeps its last message for ours.
struct QuietGdalErrors {
  QuietGdalErrors() { CPLPushErrorHandler(CPLQuietErrorHandler), CPLErrorReset(); }
  ~QuietGdalErrors() { CPLPopErrorHandler(); }
  /// Returns GDAL's last message in brackets, after a blank; empty if there is none.
  static std::string reason() {
    const std::string text = CPLGetLastErrorMsg();
    return text.empty() ? text : " (" + text + ")";
  }
};

/// The turn of a thread to read rasters by GDAL, which does not print meanwhile, and shows the vertical systems of GeoTIFF
/// 1.0. Its cache, which exists once per process, is held to 256 MiB: a twentieth of the machine's memory is beyond the
/// limits of a reader process. What was set before is restored.
class GdalReading {
 public:
  GdalReading() {
    GDALAllRegister();
    before_ = GDALGetCacheMax64();
    GDALSetCacheMax64(256 << 20);
    CPLSetThreadLocalConfigOption("GTIFF_REPORT_COMPD_CS", "YES");
  }
  ~GdalReading() {
    CPLSetThreadLocalConfigOption("GTIFF_REPORT_COMPD_CS", nullptr);
    GDALSetCacheMax64(before_);
  }
  GdalReading(const GdalReading&) = delete;
  GdalReading& operator=(const GdalReading&) = delete;

 private:
  Hdf5Turn turn_;
  QuietGdalErrors quiet_;
  GIntBig before_ = 0;
};

/// Returns the first bytes, at most `most`, of a file within a zip; empty if there is none.
std::string beginning_in_zip(const std::string& zip, const std::string& name, std::size_t most);

struct FreeReference {
  void operator()(void* reference) const { OSRDestroySpatialReference(reference); }
};
/// A coordinate system of GDAL.
using GdalReference = std::unique_ptr<void, FreeReference>;

}  // namespace insonify
