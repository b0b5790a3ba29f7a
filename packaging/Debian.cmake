# Two packages: tourmaline and libtourmaline-dev.
set(maintainer "Tourmaline maintainers <maintainers@tourmaline.invalid>")
# Every release has libraries of its own, so packages built on several are several versions: 1~debian12 < 1~debian13.
cmake_host_system_information(RESULT system QUERY DISTRIB_INFO)
set(revision 1~${system_ID}${system_VERSION_ID})

# What Debian's policy wants beside every package: copyright, and both changelogs compressed.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian
"tourmaline (${PROJECT_VERSION}-${revision}) ${system_VERSION_CODENAME}; urgency=medium

  * Built for ${system_PRETTY_NAME}; changelog.gz lists the changes.

 -- ${maintainer}  ${date}
")
configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog COPYONLY)
foreach(name changelog changelog.Debian)
  execute_process(COMMAND ${GZIP} -9nkf ${CMAKE_CURRENT_BINARY_DIR}/${name} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(part program:tourmaline development:libtourmaline-dev)
  string(REPLACE ":" ";" part ${part})
  list(GET part 0 component)
  list(GET part 1 name)
  install(FILES copyright ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT ${maintainer})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${revision})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Folders of packages are root's to write.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME tourmaline)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# mpirun.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS openmpi-bin)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS paraview)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Displacement, electric potential and temperature of piezoelectric and
pyroelectric bodies in frictional contact with a foundation, fully coupled, in
two and three dimensions. The quasistatic model is that of Ouafik (2020), with
bilateral contact, Tresca friction and heat exchange. Case files are TOML;
results are VTU and CSV files and a page for the browser.")

file(STRINGS libraries libraries)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS libraries)
list(JOIN libraries ", " libraries)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libtourmaline-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${libraries}, pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, tourmaline")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"This is the library behind the program tourmaline, static and with a CMake
package: case files, meshes, materials, solvers, results. A program that uses
it may bring a friction law of its own.")
include(CPack)
