# FFTW in double precision, one thread. Target: FFTW3::FFTW3. The version stands in the .pc file beside the library.
find_path(FFTW3_INCLUDE_DIR fftw3.h)
find_library(FFTW3_LIBRARY fftw3)
mark_as_advanced(FFTW3_INCLUDE_DIR FFTW3_LIBRARY)
if(FFTW3_LIBRARY)
  cmake_path(GET FFTW3_LIBRARY PARENT_PATH folder)
  if(EXISTS "${folder}/pkgconfig/fftw3.pc")
    file(STRINGS "${folder}/pkgconfig/fftw3.pc" line REGEX "^Version:")
    string(REGEX REPLACE "Version: *" "" FFTW3_VERSION "${line}")
  endif()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FFTW3 REQUIRED_VARS FFTW3_LIBRARY FFTW3_INCLUDE_DIR
                                  VERSION_VAR FFTW3_VERSION)
if(FFTW3_FOUND AND NOT TARGET FFTW3::FFTW3)
  add_library(FFTW3::FFTW3 UNKNOWN IMPORTED)
  set_target_properties(FFTW3::FFTW3 PROPERTIES
    IMPORTED_LOCATION "${FFTW3_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${FFTW3_INCLUDE_DIR}")
endif()
