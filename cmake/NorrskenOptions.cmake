# One interface target with what every target of the project is compiled with, and helpers to declare targets.

# A compiler cache is used where there is one.
find_program(NORRSKEN_CCACHE ccache)
mark_as_advanced(NORRSKEN_CCACHE)
if(NORRSKEN_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${NORRSKEN_CCACHE}")
endif()

add_library(norrsken_options INTERFACE)
target_compile_options(norrsken_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  # GCC 12 warns wrongly about `"literal" + std::string` (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
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

# norrsken_test(NAME SOURCES ... LINK ... [LABELS slow]): a GoogleTest program, one ctest case per test. Programs whose
# tests take longer than a few seconds are labelled `slow`: `make check` and the sanitizers leave them out.
function(norrsken_test name)
  if(NOT NORRSKEN_BUILD_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} norrsken_options GTest::gtest_main GTest::gmock)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 900 LABELS "${ARG_LABELS}")
endfunction()
