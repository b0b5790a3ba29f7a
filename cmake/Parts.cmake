# The libraries Tourmaline is made of, all from Debian 12 or 13, each as one imported target. Installed with the library:
# a program that is built against it finds them again with this file. Their packages: packaging/libraries.

find_package(PkgConfig REQUIRED)
find_package(MPI REQUIRED COMPONENTS C)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
pkg_check_modules(TOMLPLUSPLUS REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(MUPARSER REQUIRED IMPORTED_TARGET muparser)
pkg_check_modules(DEFLATE REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(SECCOMP REQUIRED IMPORTED_TARGET libseccomp)

# deal.II's own target drags some 150 Trilinos libraries into the link line, and with them into every
# start of the program. Only the library itself is linked here; `--as-needed` keeps of the two Teuchos
# libraries (which deal.II's headers refer to) what is used. Whether deal.II's debug build is taken follows the
# configuration; programs built against an installed library take the one that the library was built with.
if(NOT DEFINED TOURMALINE_DEALII_DEBUG)
  set(TOURMALINE_DEALII_DEBUG $<CONFIG:Debug>)
endif()
find_package(deal.II 9.4 REQUIRED HINTS /usr)
if(NOT TARGET ${DEAL_II_TARGET_RELEASE})  # 9.4 leaves that to its users, 9.6 does it
  include(${DEAL_II_TARGET_CONFIG})
endif()
# Not every release lists where its headers look for those of Trilinos (Kokkos among them) and PETSc (index_set.h).
find_path(TRILINOS_INCLUDE Teuchos_config.h PATH_SUFFIXES trilinos REQUIRED)
find_path(PETSC_INCLUDE petscis.h PATH_SUFFIXES petsc REQUIRED)
set(dealii_headers ${DEAL_II_INCLUDE_DIRS} ${TRILINOS_INCLUDE} ${PETSC_INCLUDE} ${MPI_C_INCLUDE_DIRS})
list(REMOVE_DUPLICATES dealii_headers)
list(REMOVE_ITEM dealii_headers /usr/include)
add_library(part::dealii INTERFACE IMPORTED)
target_include_directories(part::dealii SYSTEM INTERFACE ${dealii_headers})
target_compile_definitions(part::dealii INTERFACE OMPI_SKIP_MPICXX $<$<BOOL:${TOURMALINE_DEALII_DEBUG}>:DEBUG>)
get_target_property(dealii_release ${DEAL_II_TARGET_RELEASE} IMPORTED_LOCATION_DEBUGRELEASE)
get_target_property(dealii_debug ${DEAL_II_TARGET_DEBUG} IMPORTED_LOCATION_DEBUGRELEASE)
target_link_libraries(part::dealii INTERFACE
  -Wl,--as-needed $<IF:$<BOOL:${TOURMALINE_DEALII_DEBUG}>,${dealii_debug},${dealii_release}>
  tbb trilinos_teuchoscomm trilinos_teuchoscore MPI::MPI_C)

# The MPI build of MUMPS, the one that deal.II, PETSc and Trilinos use; never the `_seq` one beside it.
find_path(MUMPS_INCLUDE dmumps_c.h REQUIRED)
find_library(MUMPS_LIBRARY dmumps REQUIRED)
add_library(part::mumps INTERFACE IMPORTED)
target_include_directories(part::mumps SYSTEM INTERFACE ${MUMPS_INCLUDE})
target_link_libraries(part::mumps INTERFACE ${MUMPS_LIBRARY} MPI::MPI_C)

# The build of PETSc that deal.II uses.
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc)

find_library(METIS_LIBRARY metis REQUIRED)
add_library(part::metis INTERFACE IMPORTED)
target_link_libraries(part::metis INTERFACE ${METIS_LIBRARY})

find_path(UDUNITS_INCLUDE udunits2.h REQUIRED)
find_library(UDUNITS_LIBRARY udunits2 REQUIRED)
add_library(part::udunits INTERFACE IMPORTED)
target_include_directories(part::udunits SYSTEM INTERFACE ${UDUNITS_INCLUDE})
target_link_libraries(part::udunits INTERFACE ${UDUNITS_LIBRARY})

find_library(OPENBLAS_LIBRARY openblas REQUIRED)
add_library(part::openblas INTERFACE IMPORTED)
target_link_libraries(part::openblas INTERFACE ${OPENBLAS_LIBRARY})

# deal.II is linked with libgmsh already, so that this adds nothing to the start of the program.
find_path(GMSH_INCLUDE gmsh.h REQUIRED)
find_library(GMSH_LIBRARY gmsh REQUIRED)
add_library(part::gmsh INTERFACE IMPORTED)
target_link_libraries(part::gmsh INTERFACE ${GMSH_LIBRARY})
