# ARPACK-NG. Target: ARPACK::ARPACK. The headers know no version; the .pc file beside the library does.
find_path(ARPACK_INCLUDE_DIR arpack/arpack.h)
find_library(ARPACK_LIBRARY arpack)
mark_as_advanced(ARPACK_INCLUDE_DIR ARPACK_LIBRARY)
if(ARPACK_LIBRARY)
  cmake_path(GET ARPACK_LIBRARY PARENT_PATH folder)
  if(EXISTS "${folder}/pkgconfig/arpack.pc")
    file(STRINGS "${folder}/pkgconfig/arpack.pc" line REGEX "^Version:")
    string(REGEX REPLACE "Version: *" "" ARPACK_VERSION "${line}")
  endif()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ARPACK REQUIRED_VARS ARPACK_LIBRARY ARPACK_INCLUDE_DIR
                                  VERSION_VAR ARPACK_VERSION)
if(ARPACK_FOUND AND NOT TARGET ARPACK::ARPACK)
  add_library(ARPACK::ARPACK UNKNOWN IMPORTED)
  set_target_properties(ARPACK::ARPACK PROPERTIES
    IMPORTED_LOCATION "${ARPACK_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${ARPACK_INCLUDE_DIR}")
endif()
