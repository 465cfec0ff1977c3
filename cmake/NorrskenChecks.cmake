# The checks of the sources and objects as ctest cases: include arrows, the scene reference, symbols of the kernels, the
# installed package.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

function(norrsken_script_test name)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMAND_EXPAND_LISTS)
endfunction()

set(scripts ${PROJECT_SOURCE_DIR}/scripts)
norrsken_script_test(check_includes.self_test ${scripts}/check_includes.py --self-test)
norrsken_script_test(check_includes ${scripts}/check_includes.py ${PROJECT_SOURCE_DIR})
norrsken_script_test(promises.self_test ${scripts}/check_promises.py --self-test)
norrsken_script_test(promises ${scripts}/check_promises.py)
add_executable(list_plugins ${scripts}/list_plugins.cpp)
target_link_libraries(list_plugins PRIVATE norrsken norrsken_options)
set_target_properties(list_plugins PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
norrsken_script_test(scene_docs ${scripts}/make_scene_docs.py --check --plugins $<TARGET_FILE:list_plugins>)
norrsken_script_test(check_installed.self_test ${scripts}/check_installed.py --self-test)
norrsken_script_test(check_symbols.self_test ${scripts}/check_symbols.py --self-test ${CMAKE_CXX_COMPILER})

# Without optimisation, or instrumented, the compiler emits a copy of every inline function of the standard library:
# true of the objects, of no use to users.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT NORRSKEN_SANITIZE)
  foreach(set IN ITEMS scalar sse42 avx2 avx512)
    if(TARGET norrsken_kernels_${set})
      norrsken_script_test(check_symbols.${set} ${scripts}/check_symbols.py ${set}
        $<TARGET_OBJECTS:norrsken_kernels_${set}>)
    endif()
  endforeach()
endif()

# Installs into the build folder and builds a program against what was installed.
if(TARGET norrsken AND NOT NORRSKEN_SANITIZE)
  set(prefix ${PROJECT_BINARY_DIR}/consumer/prefix)
  add_test(NAME consumer.install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
  add_test(NAME consumer.build_and_run COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${PROJECT_SOURCE_DIR}/tests/consumer ${PROJECT_BINARY_DIR}/consumer/build
    --build-generator ${CMAKE_GENERATOR}
    --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release
    --test-command consumer)
  set_tests_properties(consumer.install PROPERTIES FIXTURES_SETUP installed)
  set_tests_properties(consumer.build_and_run PROPERTIES FIXTURES_REQUIRED installed TIMEOUT 300)
  # Debuggers' information names the sources.
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    norrsken_script_test(consumer.names_no_build_folder ${scripts}/check_installed.py ${prefix} ${PROJECT_SOURCE_DIR}
      ${PROJECT_BINARY_DIR})
    set_tests_properties(consumer.names_no_build_folder PROPERTIES FIXTURES_REQUIRED installed)
  endif()

  # With the sources as a part of it, which takes as long to build as the library does: otherwise it is configured alone.
  set(part_of_it -S ${PROJECT_SOURCE_DIR}/tests/consumer -B ${PROJECT_BINARY_DIR}/consumer/with_sources
    -G ${CMAKE_GENERATOR} -DNORRSKEN_SOURCES=${PROJECT_SOURCE_DIR} -DNORRSKEN_ISAS=scalar -DCMAKE_BUILD_TYPE=Release)
  add_test(NAME consumer.add_subdirectory COMMAND ${CMAKE_COMMAND} ${part_of_it})
  set_tests_properties(consumer.add_subdirectory PROPERTIES FIXTURES_SETUP configured)
  if(NORRSKEN_THOROUGH_TESTS)
    add_test(NAME consumer.build_with_sources
      COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR}/consumer/with_sources --target consumer)
    add_test(NAME consumer.run_with_sources COMMAND ${PROJECT_BINARY_DIR}/consumer/with_sources/consumer)
    set_tests_properties(consumer.build_with_sources PROPERTIES
      FIXTURES_REQUIRED configured FIXTURES_SETUP built_with_sources LABELS slow TIMEOUT 3600)
    set_tests_properties(consumer.run_with_sources PROPERTIES FIXTURES_REQUIRED built_with_sources LABELS slow)
  endif()
endif()
