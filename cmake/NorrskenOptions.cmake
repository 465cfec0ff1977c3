# One interface target with what every target of the project is compiled with, and helpers to declare targets.

# A compiler cache is used where there is one.
find_program(NORRSKEN_CCACHE ccache)
mark_as_advanced(NORRSKEN_CCACHE)
if(NORRSKEN_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  # It gives up on precompiled headers unless it is told that nobody asks them for a time or a macro.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${NORRSKEN_CCACHE})
endif()

add_library(norrsken_options INTERFACE)
if(NORRSKEN_WARNINGS)
  target_compile_options(norrsken_options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    # GCC 12 warns wrongly about `"literal" + std::string` (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
endif()
target_compile_options(norrsken_options INTERFACE
  # Results must not depend on what the compiler fuses or reorders: fma is written where it is meant.
  -ffp-contract=off -fno-fast-math)
if(NORRSKEN_WARNINGS_AS_ERRORS)
  target_compile_options(norrsken_options INTERFACE -Werror)
endif()
if(NORRSKEN_SANITIZE)
  target_compile_options(norrsken_options INTERFACE
    -fsanitize=${NORRSKEN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(norrsken_options INTERFACE -fsanitize=${NORRSKEN_SANITIZE})
  # Tests that hold times allow for what instrumentation costs.
  target_compile_definitions(norrsken_options INTERFACE NORRSKEN_SANITIZED)
endif()

# norrsken_layer(NAME SOURCES ... LINK ...): the static library norrsken_NAME of one folder below src/. The property
# NORRSKEN_LAYERS lists all of them.
function(norrsken_layer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(norrsken_${name} STATIC ${ARG_SOURCES})
  target_include_directories(norrsken_${name} PUBLIC
    ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(norrsken_${name} PUBLIC ${ARG_LINK} PRIVATE norrsken_options)
  set_target_properties(norrsken_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  set_property(GLOBAL APPEND PROPERTY NORRSKEN_LAYERS norrsken_${name})
endfunction()

# What takes minutes, or asks the machine's clock: built with NORRSKEN_THOROUGH_TESTS only.
set(NORRSKEN_THOROUGH_LABELS mutants calibration kills benchmarks)
list(JOIN NORRSKEN_THOROUGH_LABELS "|" thorough_labels)
# For `ctest -L`, as `make thorough` calls it.
file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/thorough_labels" CONTENT "^(${thorough_labels})$" @ONLY)

# GoogleTest's headers take longer to read than most tests take to compile: they are read once for all tests.
set(norrsken_test_options $<$<CONFIG:Release>:-O1>
  # With so little optimisation GCC 12 warns wrongly of strings' own buffers.
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-maybe-uninitialized>")
if(NORRSKEN_BUILD_TESTS)
  find_package(GTest REQUIRED)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/generated/precompiled_tests.cpp CONTENT "" @ONLY)
  add_library(norrsken_precompiled_tests OBJECT ${CMAKE_CURRENT_BINARY_DIR}/generated/precompiled_tests.cpp)
  target_link_libraries(norrsken_precompiled_tests PRIVATE norrsken_options GTest::gtest GTest::gmock)
  target_compile_options(norrsken_precompiled_tests PRIVATE ${norrsken_test_options})
  target_precompile_headers(norrsken_precompiled_tests PRIVATE
    <gmock/gmock.h> <gtest/gtest.h> <algorithm> <cmath> <filesystem> <map> <string> <vector>)
endif()

# norrsken_test(NAME [COMPUTES] SOURCES ... LINK ... [LABELS ...] [WITHOUT FILTER]): a GoogleTest program, one ctest case per test. COMPUTES:
# the time is spent in its own code (kernels of one lane, an oracle), which is optimised as the product is. The label `slow`
# says that its tests take longer than a few seconds; those of NORRSKEN_THOROUGH_LABELS say what else they are. WITHOUT: tests
# that are no ctest case by this, but by an `add_test` with labels of its own.
function(norrsken_test name)
  cmake_parse_arguments(ARG "COMPUTES" "WITHOUT" "SOURCES;LINK;LABELS" ${ARGN})
  if(NOT NORRSKEN_BUILD_TESTS)
    return()
  endif()
  foreach(label IN LISTS ARG_LABELS)
    if(label IN_LIST NORRSKEN_THOROUGH_LABELS AND NOT NORRSKEN_THOROUGH_TESTS)
      return()
    endif()
  endforeach()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} norrsken_options GTest::gtest_main GTest::gmock)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  if(NOT ARG_COMPUTES)
    target_compile_options(${name} PRIVATE ${norrsken_test_options})
    target_precompile_headers(${name} REUSE_FROM norrsken_precompiled_tests)
  endif()
  set(filter "")
  if(ARG_WITHOUT)
    set(filter TEST_FILTER "-${ARG_WITHOUT}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 ${filter}
    PROPERTIES TIMEOUT 900 LABELS "${ARG_LABELS}")
endfunction()
