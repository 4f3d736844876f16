# Exodus II. Target: Exodus::Exodus
find_path(Exodus_INCLUDE_DIR exodusII.h)
find_library(Exodus_LIBRARY NAMES exoIIv2c exodus)
mark_as_advanced(Exodus_INCLUDE_DIR Exodus_LIBRARY)
if(Exodus_INCLUDE_DIR)
  file(STRINGS "${Exodus_INCLUDE_DIR}/exodusII.h" line REGEX "#define EX_API_VERS +[0-9]")
  string(REGEX REPLACE ".*EX_API_VERS +([0-9.]+).*" "\\1" Exodus_VERSION "${line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Exodus REQUIRED_VARS Exodus_LIBRARY Exodus_INCLUDE_DIR
                                  VERSION_VAR Exodus_VERSION)
if(Exodus_FOUND AND NOT TARGET Exodus::Exodus)
  add_library(Exodus::Exodus UNKNOWN IMPORTED)
  set_target_properties(Exodus::Exodus PROPERTIES
    IMPORTED_LOCATION "${Exodus_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${Exodus_INCLUDE_DIR}")
endif()
