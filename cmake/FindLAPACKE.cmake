# The C interface of LAPACK. Target: LAPACKE::LAPACKE. The version stands in the .pc file beside the library.
find_path(LAPACKE_INCLUDE_DIR lapacke.h)
find_library(LAPACKE_LIBRARY lapacke)
mark_as_advanced(LAPACKE_INCLUDE_DIR LAPACKE_LIBRARY)
if(LAPACKE_LIBRARY)
  cmake_path(GET LAPACKE_LIBRARY PARENT_PATH folder)
  if(EXISTS "${folder}/pkgconfig/lapacke.pc")
    file(STRINGS "${folder}/pkgconfig/lapacke.pc" line REGEX "^Version:")
    string(REGEX REPLACE "Version: *" "" LAPACKE_VERSION "${line}")
  endif()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LAPACKE REQUIRED_VARS LAPACKE_LIBRARY LAPACKE_INCLUDE_DIR
                                  VERSION_VAR LAPACKE_VERSION)
if(LAPACKE_FOUND AND NOT TARGET LAPACKE::LAPACKE)
  add_library(LAPACKE::LAPACKE UNKNOWN IMPORTED)
  set_target_properties(LAPACKE::LAPACKE PROPERTIES
    IMPORTED_LOCATION "${LAPACKE_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${LAPACKE_INCLUDE_DIR}")
endif()
