# HDF5 without MPI. Target: HDF5Serial::HDF5 (CMake's own module needs a C compiler to be enabled).
find_path(HDF5Serial_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(HDF5Serial_LIBRARY NAMES hdf5_serial hdf5)
mark_as_advanced(HDF5Serial_INCLUDE_DIR HDF5Serial_LIBRARY)
if(HDF5Serial_INCLUDE_DIR)
  file(GLOB headers "${HDF5Serial_INCLUDE_DIR}/H5pubconf*.h")
  foreach(header IN LISTS headers)
    file(STRINGS "${header}" line REGEX "#define H5_VERSION \"")
    string(REGEX REPLACE ".*\"([0-9.]+).*\".*" "\\1" HDF5Serial_VERSION "${line}")
  endforeach()
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HDF5Serial REQUIRED_VARS HDF5Serial_LIBRARY HDF5Serial_INCLUDE_DIR
                                  VERSION_VAR HDF5Serial_VERSION)
if(HDF5Serial_FOUND AND NOT TARGET HDF5Serial::HDF5)
  add_library(HDF5Serial::HDF5 UNKNOWN IMPORTED)
  set_target_properties(HDF5Serial::HDF5 PROPERTIES
    IMPORTED_LOCATION "${HDF5Serial_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${HDF5Serial_INCLUDE_DIR}")
endif()
