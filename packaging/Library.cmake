# find_package(Tourmaline) gives Tourmaline::tourmaline.
include(CMakePackageConfigHelpers)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/Tourmaline)

target_link_options(tourmaline_lib INTERFACE
  $<INSTALL_INTERFACE:-Wl,--version-script=$<INSTALL_PREFIX>/${config}/hidden-symbols.map>)
install(TARGETS tourmaline_lib EXPORT TourmalineTargets COMPONENT development)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ TYPE INCLUDE COMPONENT development)
install(EXPORT TourmalineTargets NAMESPACE Tourmaline:: DESTINATION ${config} COMPONENT development)

if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(dealii_debug 1)
else()
  set(dealii_debug 0)
endif()
configure_package_config_file(TourmalineConfig.cmake.in TourmalineConfig.cmake INSTALL_DESTINATION ${config})
# Before 1.0 a minor version may change interfaces.
write_basic_package_version_file(TourmalineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/TourmalineConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/TourmalineConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/Parts.cmake ${PROJECT_SOURCE_DIR}/cmake/hidden-symbols.map
  DESTINATION ${config} COMPONENT development)

# The example of a program that uses the library.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libtourmaline-dev/examples
  COMPONENT development PATTERN build EXCLUDE)
