# Library, headers, program and the CMake package: find_package(perimode) then perimode::perimode.
include(CMakePackageConfigHelpers)
set(perimode_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/perimode")
if(NOT DEFINED BUILD_SHARED_LIBS)
  set(BUILD_SHARED_LIBS OFF)
endif()

install(TARGETS perimode EXPORT perimode-targets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
  RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}"
  FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
if(TARGET perimode_cli)
  install(TARGETS perimode_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
if(TARGET perimode_slepc)
  install(TARGETS perimode_slepc LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/perimode")
endif()
install(EXPORT perimode-targets NAMESPACE perimode:: DESTINATION "${perimode_package_dir}")

configure_package_config_file(cmake/perimode-config.cmake.in perimode-config.cmake
  INSTALL_DESTINATION "${perimode_package_dir}")
write_basic_package_version_file(perimode-config-version.cmake COMPATIBILITY SameMinorVersion)
file(GLOB find_modules "${CMAKE_CURRENT_SOURCE_DIR}/cmake/Find*.cmake")
install(FILES ${find_modules}
  "${CMAKE_CURRENT_BINARY_DIR}/perimode-config.cmake"
  "${CMAKE_CURRENT_BINARY_DIR}/perimode-config-version.cmake"
  DESTINATION "${perimode_package_dir}")
install(FILES docs/case.schema.json DESTINATION "${CMAKE_INSTALL_DATADIR}/perimode")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
