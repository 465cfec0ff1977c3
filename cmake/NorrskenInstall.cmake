# Installs the library, its headers, and the CMake package that finds them again as norrsken::norrsken.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/norrsken)
install(TARGETS norrsken EXPORT norrsken ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/norrsken DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT norrsken NAMESPACE norrsken:: FILE norrskenTargets.cmake DESTINATION ${package_dir})

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/norrskenConfig.cmake.in
  ${PROJECT_BINARY_DIR}/norrskenConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/norrskenConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/norrskenConfig.cmake ${PROJECT_BINARY_DIR}/norrskenConfigVersion.cmake
  DESTINATION ${package_dir})
