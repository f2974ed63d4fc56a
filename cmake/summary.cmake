# What was found and what will be built, in one block at the end of the configure run.

list(JOIN ISOCHOR_FOUND "\n--   " libraries)
string(TOUPPER ${CMAKE_BUILD_TYPE} build_type)
message(STATUS "Isochor ${PROJECT_VERSION}, ${CMAKE_BUILD_TYPE}")
message(STATUS "  compiler: ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, flags "
               "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}}")
message(STATUS "  -march=native in Release: ${ISOCHOR_NATIVE}, warnings are errors: "
               "${ISOCHOR_WERROR}, tests: ${ISOCHOR_TESTS}, ccache: ${CCACHE_PROGRAM}")
message(STATUS "  ${libraries}")
if(ISOCHOR_TESTS)
  message(STATUS "  for tests: ${NUMDIFF_PROGRAM}, ${MPIRUN_PROGRAM}, ${PYTHON_PROGRAM}")
endif()
if(ISOCHOR_BLAS_WARNING)
  list(JOIN ISOCHOR_BLAS_WARNING "" text)
  message(WARNING "${text}")
endif()
