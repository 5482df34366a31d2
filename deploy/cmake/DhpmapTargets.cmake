# dhpmap_library(NAME room_name SOURCES ... PUBLIC ... PRIVATE ...): one static library a room, with our warnings.
# dhpmap_program(NAME ... SOURCES ... LIBS ...): a program in bin/.
# dhpmap_tests(ROOM path LIBS ... [ENVIRONMENT name=value] [COST seconds]): all tests/<path>/*_test.cc as one test binary.
# ctest runs each case on its own, but under sanitizers, where each start takes a third of a second, a binary as a whole:
# the costliest first. COST is what the whole takes in the release build, where that is seconds.

find_program(DHPMAP_CCACHE ccache)
if(DHPMAP_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${DHPMAP_CCACHE})
endif()

# The same sums on every machine: fused multiply-add would round differently where it exists.
add_compile_options(-ffp-contract=off)

if(DHPMAP_SANITIZE STREQUAL "address")
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(DHPMAP_SANITIZED)
elseif(DHPMAP_SANITIZE STREQUAL "thread")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
  add_compile_definitions(DHPMAP_SANITIZED)
elseif(DHPMAP_SANITIZE STREQUAL "fuzzer")  # clang only; tests/fuzz links the fuzzers themselves
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(DHPMAP_SANITIZED)
elseif(DHPMAP_SANITIZE)
  message(FATAL_ERROR "DHPMAP_SANITIZE is '${DHPMAP_SANITIZE}', not address, thread or fuzzer")
endif()

# Under AddressSanitizer, which only CI builds whole, what most sources include is compiled once. The release build goes
# without, so that each source is seen to include what it uses; so does ThreadSanitizer's, half of whose sources see
# another __SANITIZE_THREAD__ (proto/) and could not share it.
if(DHPMAP_SANITIZE STREQUAL "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(DHPMAP_PRECOMPILE ON)
  if(DHPMAP_CCACHE)  # which asks for this beside precompiled headers
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${DHPMAP_CCACHE})
  endif()
endif()

# dhpmap_prelude(NAME LIBS ... HEADERS ...): headers for targets to share by target_precompile_headers(... REUSE_FROM NAME).
function(dhpmap_prelude name)
  cmake_parse_arguments(ARG "" "" "LIBS;HEADERS" ${ARGN})
  if(NOT DHPMAP_PRECOMPILE)
    return()
  endif()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cc CONTENT "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cc)
  target_link_libraries(${name} PRIVATE ${ARG_LIBS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

set(dhpmap_prelude_headers <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <cstring> <deque> <filesystem>
  <fstream> <functional> <map> <memory> <mutex> <numeric> <optional> <random> <set> <span> <sstream> <stop_token> <string>
  <string_view> <thread> <tuple> <unordered_map> <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry>)

add_library(dhpmap_warnings INTERFACE)
target_compile_options(dhpmap_warnings INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -Wno-missing-field-initializers  # designated initialisers leave out what stays default
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # false alarms of GCC 12 on std::string (its bug 105329)
if(DHPMAP_WERROR)  # off under sanitizers, whose instrumentation makes GCC see uninitialised values that are none
  target_compile_options(dhpmap_warnings INTERFACE -Werror)
endif()

function(dhpmap_library)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${ARG_NAME} STATIC ${ARG_SOURCES})
  target_include_directories(${ARG_NAME} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(${ARG_NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:dhpmap_warnings>)
  if(DHPMAP_PRECOMPILE)
    target_precompile_headers(${ARG_NAME} REUSE_FROM dhpmap_sources_prelude)
  endif()
endfunction()

function(dhpmap_program)
  cmake_parse_arguments(ARG "" "NAME" "SOURCES;LIBS" ${ARGN})
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_include_directories(${ARG_NAME} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${ARG_NAME} PRIVATE ${ARG_LIBS} dhpmap_warnings)
  if(DHPMAP_PRECOMPILE)
    target_precompile_headers(${ARG_NAME} REUSE_FROM dhpmap_sources_prelude)
  endif()
endfunction()

# What the sanitizer runs build: every unit test, and the tests of rooms that start threads.
add_custom_target(dhpmap_unit_tests)
add_custom_target(dhpmap_threaded_tests)

function(dhpmap_tests)
  cmake_parse_arguments(ARG "" "ROOM;COST" "LIBS;ENVIRONMENT" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${ARG_ROOM}/*_test.cc)
  if(NOT sources)
    return()
  endif()
  string(REPLACE "/" "_" name ${ARG_ROOM}_test)
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} dhpmap_test_places GTest::gtest GTest::gtest_main dhpmap_warnings)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(DHPMAP_PRECOMPILE)
    target_precompile_headers(${name} REUSE_FROM dhpmap_tests_prelude)
  endif()
  string(REGEX MATCH "^[a-z0-9]+" label ${ARG_ROOM})
  if(label STREQUAL unit)
    add_dependencies(dhpmap_unit_tests ${name})
  endif()
  if(ARG_ROOM MATCHES "^(integration|unit/(server/(app|wire|grpc|http|json|gateway|config|log|metrics)|storage|mapping/(base|refinement|pipeline)))$")
    add_dependencies(dhpmap_threaded_tests ${name})
  endif()
  # One label only, and no property without a value: gtest_discover_tests passes lists on as separate words.
  set(properties LABELS ${label})
  if(ARG_ENVIRONMENT)
    list(APPEND properties ENVIRONMENT ${ARG_ENVIRONMENT})
  endif()
  if(DHPMAP_SANITIZE)  # deploy/count_cases.sh counts by the reports
    if(ARG_COST)
      list(APPEND properties COST ${ARG_COST})
    endif()
    add_test(NAME ${ARG_ROOM} COMMAND ${name} --gtest_output=xml:${CMAKE_BINARY_DIR}/tests/reports/${name}.xml)
    set_tests_properties(${ARG_ROOM} PROPERTIES TIMEOUT 1200 ${properties})
  else()
    gtest_discover_tests(${name} TEST_PREFIX "${ARG_ROOM}/" DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 240 ${properties})
  endif()
endfunction()
