# SPDX-License-Identifier: BSD-3-Clause
# `cpack -G DEB` in the build folder of the release preset makes the packages for the Debian of this machine; tests/packages.sh tries them.
#   insonify          component program: tool, viewer, presets and materials, and what shells and desktops need
#   libinsonify-dev   component development: headers, static libraries, files for find_package
#   insonify-doc      component documentation: docs/, and the site if docs/make_site.sh has made it
#   python3-insonify  component python: the module of Python, if it is built
set(doc ${CMAKE_INSTALL_DATADIR}/doc)
install(DIRECTORY docs DESTINATION ${doc}/insonify-doc COMPONENT documentation PATTERN "*.sh" EXCLUDE PATTERN "site" EXCLUDE)
install(FILES README.md DESTINATION ${doc}/insonify-doc COMPONENT documentation)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/site/ DESTINATION ${doc}/insonify-doc/html COMPONENT documentation OPTIONAL)
install(FILES apps/01_first_ping.cpp apps/03_many_pings.cpp DESTINATION ${doc}/libinsonify-dev/examples COMPONENT development)
set(packages program:insonify development:libinsonify-dev documentation:insonify-doc)
if(INSONIFY_PYTHON)
  list(APPEND packages python:python3-insonify)
  install(FILES apps/05_dataset.py apps/06_sweep.py apps/07_reconstruction.py apps/08_synthetic_aperture.py apps/grey_png.py DESTINATION ${doc}/python3-insonify/examples COMPONENT python)
endif()
set(CPACK_COMPONENTS_ALL "")
foreach(of IN LISTS packages)
  string(REGEX MATCH "(.*):(.*)" matched ${of})
  install(FILES LICENSE DESTINATION ${doc}/${CMAKE_MATCH_2} RENAME copyright COMPONENT ${CMAKE_MATCH_1})
  string(TOUPPER ${CMAKE_MATCH_1} component)
  set(CPACK_DEBIAN_${component}_PACKAGE_NAME ${CMAKE_MATCH_2})
  set(CPACK_DEBIAN_${component}_FILE_NAME DEB-DEFAULT)
  list(APPEND CPACK_COMPONENTS_ALL ${CMAKE_MATCH_1})
endforeach()

set(CPACK_PACKAGE_NAME insonify)
set(CPACK_PACKAGE_VENDOR "the insonify authors")
set(CPACK_PACKAGE_CONTACT "the insonify authors <insonify@example.org>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
  WORLD_EXECUTE)

set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "simulates imaging sonar on captured scenes: tool and viewer
Forward-looking, multibeam, side-scan and scanning sonar over point clouds and
meshes: complex time series per beam, sonar pictures, returns as point clouds.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Pictures: letters, and OpenGL in software where there is no graphics card.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-dejavu-core, libegl-mesa0, libgl1-mesa-dri")
# GDAL and Assimp are not linked, so that their packages are not found by that.
if(INSONIFY_ASSIMP MATCHES "^libassimp[.]so[.]([0-9]+)$")
  string(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS ", libassimp${CMAKE_MATCH_1}")
endif()
if(INSONIFY_GDAL MATCHES "^libgdal[.]so[.]([0-9]+)$")
  string(APPEND CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS ", libgdal${CMAKE_MATCH_1}")
endif()

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "simulates imaging sonar on captured scenes: C++ library
Headers, static libraries and files for CMake's find_package(insonify).")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libfftw3-dev, liblz4-dev, libssl-dev, pkg-config")
if(EMBREE_LIBRARY)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libembree-dev")
endif()
if(LASZIP_LIBRARY)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", liblaszip-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "insonify (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), cmake,
 libhdf5-dev, libzstd-dev, libtomlplusplus-dev, libfmt-dev, libpcl-dev, libvtk9-dev, libgdal-dev, libassimp-dev, libglew-dev, libegl-dev, libx11-dev")
string(REPLACE "\n" "" CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "${CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS}")

set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "simulates imaging sonar on captured scenes: documentation
Walk through the program, file formats, equations and their verification,
accuracy, and the reference of the C++ library.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)

set(CPACK_COMPONENT_PYTHON_DESCRIPTION "simulates imaging sonar on captured scenes: Python module
Pings, soundings and labels as NumPy arrays: `import insonify`.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
if(INSONIFY_PYTHON)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "insonify (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), python3-numpy,
 python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor})")
  string(REPLACE "\n" "" CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS}")
  # Compiled by apt, so that root's first import leaves nothing that a purge would not remove.
  foreach(script IN ITEMS postinst:py3compile prerm:py3clean)
    string(REGEX MATCH "(.*):(.*)" matched ${script})
    set(path ${PROJECT_BINARY_DIR}/debian/${CMAKE_MATCH_1})
    file(WRITE ${path} "#!/bin/sh\nset -e\nif command -v ${CMAKE_MATCH_2} >/dev/null; then ${CMAKE_MATCH_2} -p python3-insonify; fi\n")
    file(CHMOD ${path} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
    list(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${path})
  endforeach()
endif()
include(CPack)
