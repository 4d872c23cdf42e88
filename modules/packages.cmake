# SPDX-License-Identifier: BSD-3-Clause
# Finds the packages of the modules named in `insonify_modules`, for the build and for find_package(insonify). Each package
# belongs to one module, its door; see docs/decisions.md.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(PkgConfig REQUIRED)

if("beamforming" IN_LIST insonify_modules)
  pkg_check_modules(FFTW3 REQUIRED IMPORTED_TARGET fftw3 fftw3f)  # Debian ships no CMake config for FFTW
  set_property(TARGET PkgConfig::FFTW3 APPEND PROPERTY INTERFACE_LINK_LIBRARIES fftw3_threads fftw3f_threads)  # lock of planners
endif()
if("hdf" IN_LIST insonify_modules)
  pkg_search_module(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial hdf5)  # CMake's own module asks for C
  find_library(HDF5_HL_LIBRARY NAMES hdf5_hl hdf5_serial_hl HINTS ${HDF5_LIBRARY_DIRS} REQUIRED)  # dimension scales
  set_property(TARGET PkgConfig::HDF5 APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${HDF5_HL_LIBRARY})
endif()
if("store" IN_LIST insonify_modules)
  find_package(tomlplusplus REQUIRED)
endif()
if("formats" IN_LIST insonify_modules)
  pkg_check_modules(MCAP_LZ4 QUIET IMPORTED_TARGET liblz4)  # chunks of MCAP, if they are there
  pkg_check_modules(MCAP_ZSTD QUIET IMPORTED_TARGET libzstd)
endif()
if("scene_io" IN_LIST insonify_modules)
  find_package(GDAL QUIET CONFIG)  # rasters as scenes, and map projections, if it is there
  find_package(PCL 1.12 REQUIRED COMPONENTS common io kdtree search features)
endif()
if("scene_io" IN_LIST insonify_modules OR "view" IN_LIST insonify_modules)
  find_package(VTK 9.1 REQUIRED COMPONENTS
    CommonCore CommonDataModel FiltersCore FiltersGeneral FiltersGeometry IOCore IOGeometry IOImage IOLegacy IOPLY IOXML
    RenderingCore RenderingOpenGL2 RenderingFreeType RenderingAnnotation RenderingContextOpenGL2
    RenderingContext2D RenderingUI ChartsCore ViewsContext2D InteractionStyle InteractionWidgets)
  # VTK names MPI::MPI_C, which CMake makes for projects that enable C alone; insonify calls nothing of it.
  if(NOT TARGET MPI::MPI_C)
    add_library(MPI::MPI_C INTERFACE IMPORTED)
  endif()
endif()
if("view" IN_LIST insonify_modules)
  pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)
endif()
if("viewer" IN_LIST insonify_modules)
  find_package(X11 REQUIRED)
endif()
