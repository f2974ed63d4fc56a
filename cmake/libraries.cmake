# Finds every library and bundles them in the target isochor_libraries. Each found library adds
# a line to ISOCHOR_FOUND for the configure summary.

set(ISOCHOR_FOUND "")
set(INSTALL_ADVICE "run scripts/install_packages.sh")

function(require name package)
  foreach(variable IN LISTS ARGN)
    if(NOT ${variable})
      message(FATAL_ERROR "${name} not found (Debian package ${package}): ${INSTALL_ADVICE}")
    endif()
  endforeach()
endfunction()

# The text in the first parentheses of PATTERN in FILE.
function(read_version result file pattern)
  file(STRINGS ${file} line REGEX "${pattern}" LIMIT_COUNT 1)
  string(REGEX MATCH "${pattern}" line "${line}")
  set(${result} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

find_package(deal.II 9.4.1 QUIET HINTS ${DEAL_II_DIR} $ENV{DEAL_II_DIR})
require(deal.II libdeal.ii-dev deal.II_FOUND)
include(${DEAL_II_TARGET_CONFIG})
foreach(feature MPI TRILINOS MUPARSER)
  if(NOT DEAL_II_WITH_${feature})
    message(FATAL_ERROR "deal.II in ${DEAL_II_PATH} was built without ${feature}; "
                        "Debian's libdeal.ii-dev has it: ${INSTALL_ADVICE}")
  endif()
endforeach()
if(CMAKE_BUILD_TYPE STREQUAL Debug)
  set(dealii_target ${DEAL_II_TARGET_DEBUG})
else()
  set(dealii_target ${DEAL_II_TARGET_RELEASE})
endif()
get_target_property(dealii_library ${dealii_target} LOCATION)
list(APPEND ISOCHOR_FOUND "deal.II ${DEAL_II_PACKAGE_VERSION}: ${dealii_library}")

find_path(MUMPS_INCLUDE_DIR dmumps_c.h)
find_library(DMUMPS_LIBRARY dmumps)
find_library(SMUMPS_LIBRARY smumps)
find_library(MUMPS_COMMON_LIBRARY mumps_common)
require(MUMPS libmumps-dev MUMPS_INCLUDE_DIR DMUMPS_LIBRARY SMUMPS_LIBRARY MUMPS_COMMON_LIBRARY)
read_version(version ${MUMPS_INCLUDE_DIR}/dmumps_c.h "MUMPS_VERSION \"([0-9.]+)\"")
list(APPEND ISOCHOR_FOUND "MUMPS ${version}: ${DMUMPS_LIBRARY}")

find_path(METIS_INCLUDE_DIR metis.h)
find_library(METIS_LIBRARY metis)
require(METIS libmetis-dev METIS_INCLUDE_DIR METIS_LIBRARY)
read_version(major ${METIS_INCLUDE_DIR}/metis.h "METIS_VER_MAJOR +([0-9]+)")
read_version(minor ${METIS_INCLUDE_DIR}/metis.h "METIS_VER_MINOR +([0-9]+)")
read_version(patch ${METIS_INCLUDE_DIR}/metis.h "METIS_VER_SUBMINOR +([0-9]+)")
list(APPEND ISOCHOR_FOUND "METIS ${major}.${minor}.${patch}: ${METIS_LIBRARY}")

find_path(UMFPACK_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse)
find_library(UMFPACK_LIBRARY umfpack)
require(UMFPACK libsuitesparse-dev UMFPACK_INCLUDE_DIR UMFPACK_LIBRARY)
read_version(version ${UMFPACK_INCLUDE_DIR}/umfpack.h "UMFPACK_VERSION \"UMFPACK V([0-9.]+)")
list(APPEND ISOCHOR_FOUND "UMFPACK ${version}: ${UMFPACK_LIBRARY}")

find_path(GMSH_INCLUDE_DIR gmsh.h)
find_library(GMSH_LIBRARY gmsh)
require(gmsh libgmsh-dev GMSH_INCLUDE_DIR GMSH_LIBRARY)
read_version(version ${GMSH_INCLUDE_DIR}/gmsh.h "GMSH_API_VERSION \"([0-9.]+)\"")
list(APPEND ISOCHOR_FOUND "gmsh, interface ${version}: ${GMSH_LIBRARY}")

find_package(CLI11 QUIET)
require(CLI11 libcli11-dev CLI11_FOUND)
list(APPEND ISOCHOR_FOUND "CLI11 ${CLI11_VERSION}: ${CLI11_DIR}")

# The BLAS that the program will load is the one that deal.II loads, whatever we link.
set(ISOCHOR_BLAS_WARNING "")
execute_process(COMMAND ldd ${dealii_library} OUTPUT_VARIABLE loaded ERROR_QUIET)
if(loaded MATCHES "libblas\\.so\\.3 => ([^ \n]+)")
  file(REAL_PATH ${CMAKE_MATCH_1} blas)
  if(blas MATCHES "openblas")
    set(version "")
    get_filename_component(folder ${blas} DIRECTORY)
    file(GLOB versioned ${folder}/libopenblas*-r*.so)
    if(versioned MATCHES "-r([0-9.]+)\\.so")
      set(version " ${CMAKE_MATCH_1}")
    endif()
    list(APPEND ISOCHOR_FOUND "OpenBLAS${version}: ${blas}")
  else()
    list(APPEND ISOCHOR_FOUND "BLAS: ${blas}")
    if(NOT blas MATCHES "mkl|blis|atlas")
      set(ISOCHOR_BLAS_WARNING
        "libblas.so.3, which deal.II and MUMPS load, is ${blas}: not OpenBLAS. The reference "
        "BLAS makes factorisations several times slower. Install Debian's libopenblas0-pthread "
        "(scripts/install_packages.sh does), or choose it with: "
        "update-alternatives --config libblas.so.3-${CMAKE_LIBRARY_ARCHITECTURE}")
    endif()
  endif()
else()
  set(ISOCHOR_BLAS_WARNING
    "Could not find out which libblas.so.3 ${dealii_library} loads. Factorisations are slow "
    "unless it is OpenBLAS: install libopenblas0-pthread")
endif()

find_program(MPIRUN_PROGRAM mpirun)
if(ISOCHOR_TESTS)
  find_program(NUMDIFF_PROGRAM numdiff)
  # Debian's own Python first: VTK and matplotlib come as its packages.
  find_program(PYTHON_PROGRAM python3 HINTS /usr/bin NO_CMAKE_ENVIRONMENT_PATH)
  require(numdiff numdiff NUMDIFF_PROGRAM)
  require(mpirun openmpi-bin MPIRUN_PROGRAM)
  require(Python python3 PYTHON_PROGRAM)
endif()

add_library(isochor_libraries INTERFACE)
target_include_directories(isochor_libraries SYSTEM INTERFACE
  ${DEAL_II_INCLUDE_DIRS} ${MUMPS_INCLUDE_DIR} ${METIS_INCLUDE_DIR} ${UMFPACK_INCLUDE_DIR}
  ${GMSH_INCLUDE_DIR})
target_compile_definitions(isochor_libraries INTERFACE
  ${DEAL_II_USER_DEFINITIONS} OMPI_SKIP_MPICXX $<$<CONFIG:Debug>:DEBUG>)
# deal.II's target names two hundred libraries, which take half a minute to link against. Our code
# calls these few of them; the loader finds the rest through libdeal.ii itself.
get_target_property(dealii_libraries ${dealii_target} INTERFACE_LINK_LIBRARIES)
list(FILTER dealii_libraries INCLUDE REGEX
  "/lib(tbb|trilinos_epetra|trilinos_teuchos(core|comm|parameterlist)|petsc[a-z_]*|p?arpack|boost_[a-z]+|mpi|z)\\.so")
list(REMOVE_DUPLICATES dealii_libraries)
target_link_options(isochor_libraries INTERFACE
  -Wl,--as-needed -Wl,--unresolved-symbols=ignore-in-shared-libs)
target_link_libraries(isochor_libraries INTERFACE
  ${dealii_library} ${dealii_libraries} ${DMUMPS_LIBRARY} ${SMUMPS_LIBRARY}
  ${MUMPS_COMMON_LIBRARY} ${METIS_LIBRARY}
  ${UMFPACK_LIBRARY} ${GMSH_LIBRARY} CLI11::CLI11)
