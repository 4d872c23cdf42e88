# SPDX-License-Identifier: BSD-3-Clause
# Finds the packages of the modules named in `insonify_modules`, for the build and for find_package(insonify). Each package
# belongs to one module, its door; see docs/decisions.md.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(PkgConfig REQUIRED)

if("beamforming" IN_LIST insonify_modules)
  pkg_check_modules(INSONIFY_FFTW REQUIRED IMPORTED_TARGET GLOBAL fftw3 fftw3f)  # Debian ships no CMake config for FFTW
  set_property(TARGET PkgConfig::INSONIFY_FFTW APPEND PROPERTY INTERFACE_LINK_LIBRARIES fftw3_threads fftw3f_threads)  # lock of planners
endif()
if("hdf" IN_LIST insonify_modules)
  pkg_search_module(INSONIFY_HDF5 REQUIRED IMPORTED_TARGET GLOBAL hdf5-serial hdf5)  # CMake's own module asks for C
  find_library(HDF5_HL_LIBRARY NAMES hdf5_hl hdf5_serial_hl HINTS ${INSONIFY_HDF5_LIBRARY_DIRS} REQUIRED)  # dimension scales
  set_property(TARGET PkgConfig::INSONIFY_HDF5 APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${HDF5_HL_LIBRARY})
endif()
if("store" IN_LIST insonify_modules)
  find_package(tomlplusplus REQUIRED)
endif()
if("run" IN_LIST insonify_modules)
  find_package(fmt REQUIRED)
endif()
if("formats" IN_LIST insonify_modules)
  pkg_check_modules(INSONIFY_LZ4 QUIET IMPORTED_TARGET GLOBAL liblz4)  # chunks of MCAP, if they are there
  pkg_check_modules(INSONIFY_ZSTD QUIET IMPORTED_TARGET GLOBAL libzstd)
endif()
if("scene_io" IN_LIST insonify_modules)
  find_package(GDAL QUIET CONFIG)  # rasters as scenes, and map projections, if it is there
  find_package(assimp QUIET CONFIG)  # meshes of robots and CAD, if it is there
  find_package(PCL 1.12 REQUIRED COMPONENTS common io kdtree search features)
  # Not the targets of PCL: they pass -fopenmp on since 1.14, with which Eigen threads its products, in users' sources, too.
  if(NOT TARGET insonify::pcl)
    add_library(insonify::pcl INTERFACE IMPORTED GLOBAL)
    target_include_directories(insonify::pcl INTERFACE ${PCL_INCLUDE_DIRS})
    target_link_libraries(insonify::pcl INTERFACE ${PCL_FEATURES_LIBRARY} ${PCL_SEARCH_LIBRARY} ${PCL_KDTREE_LIBRARY}
      ${PCL_IO_LIBRARY} ${PCL_COMMON_LIBRARY})
  endif()
endif()
if("scene_io" IN_LIST insonify_modules OR "view" IN_LIST insonify_modules)
  find_package(VTK 9.1 REQUIRED COMPONENTS
    CommonCore CommonDataModel IOCore IOImage IOLegacy IOXML RenderingCore RenderingOpenGL2 RenderingFreeType
    RenderingContextOpenGL2 RenderingContext2D RenderingUI ChartsCore InteractionStyle InteractionWidgets)
  # VTK names MPI::MPI_C, which CMake makes for projects that enable C alone; insonify calls nothing of it.
  if(NOT TARGET MPI::MPI_C)
    add_library(MPI::MPI_C INTERFACE IMPORTED GLOBAL)
  endif()
endif()
if("view" IN_LIST insonify_modules)
  pkg_check_modules(INSONIFY_EGL REQUIRED IMPORTED_TARGET GLOBAL egl)
endif()
if("viewer" IN_LIST insonify_modules)
  find_package(X11 REQUIRED)
endif()
