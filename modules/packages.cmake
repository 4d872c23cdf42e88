# Finds every package once. Each belongs to one module, its door; see docs/decisions.md.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFTW3 REQUIRED IMPORTED_TARGET fftw3 fftw3f)  # Debian ships no CMake config for FFTW
find_package(HDF5 REQUIRED COMPONENTS C)

# FLANN's pkg-config file pulls in MPI; its templates need only the headers and lz4.
find_path(FLANN_INCLUDE_DIR flann/flann.hpp REQUIRED)
find_library(LZ4_LIBRARY lz4 REQUIRED)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)

if(INSONIFY_SCENE_IO)
  find_package(GDAL QUIET CONFIG)  # rasters as scenes, if it is there
  find_package(PCL 1.12 REQUIRED COMPONENTS common io kdtree search features)
endif()
if(INSONIFY_SCENE_IO OR INSONIFY_VIEW)
  find_package(VTK 9.1 REQUIRED COMPONENTS
    CommonCore CommonDataModel FiltersCore FiltersGeneral FiltersGeometry IOGeometry IOImage IOLegacy IOPLY IOXML
    RenderingCore RenderingOpenGL2 RenderingFreeType RenderingAnnotation RenderingContextOpenGL2
    RenderingContext2D RenderingUI ChartsCore ViewsContext2D InteractionStyle InteractionWidgets)
endif()
if(INSONIFY_VIEW)
  pkg_check_modules(EGL REQUIRED IMPORTED_TARGET egl)
  find_package(X11 REQUIRED)
endif()
