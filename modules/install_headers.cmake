# SPDX-License-Identifier: BSD-3-Clause
# Installs the public headers below include/insonify, where they include each other as <insonify/...>: so `include` is the only
# folder that a user's compiler searches, and no header of theirs is mistaken for one of insonify's.
foreach(header IN LISTS headers)
  file(READ ${modules}/${header} text)
  string(REGEX REPLACE "#include \"([a-z_]+(/[a-z0-9_]+)+\\.hpp)\"" "#include <insonify/\\1>" text "${text}")
  file(WRITE "$ENV{DESTDIR}${destination}/${header}" "${text}")
  list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${destination}/${header}")
endforeach()
list(LENGTH headers count)
message(STATUS "Installed: ${count} headers in $ENV{DESTDIR}${destination}")
