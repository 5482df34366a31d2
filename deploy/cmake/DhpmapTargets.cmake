# dhpmap_library(NAME room_name SOURCES ... PUBLIC ... PRIVATE ... [STUBS] [ALONE ...]): one static library a room, with our warnings.
# dhpmap_program(NAME ... SOURCES ... LIBS ... [STUBS] [ALONE ...]): a program in bin/.
# dhpmap_tests(ROOM path LIBS ... [ENVIRONMENT name=value] [COST seconds [SHARDS n]] [STUBS] [ALONE ...]): all tests/<path>/*_test.cc
# as one test binary.
# STUBS: most of its sources include messages or gRPC; they share those headers too.
# ALONE: sources that name a helper like another source of the room does (or a macro); all others are compiled eight together.
# ctest runs each case on its own, but under sanitizers, where each start takes a third of a second, a binary as a whole:
# the costliest first. COST is what the whole takes in the release build, where that is seconds; SHARDS, in how many
# processes it then runs, so that no core waits long for the last of them.

find_program(DHPMAP_CCACHE ccache)
if(DHPMAP_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${DHPMAP_CCACHE})
endif()

add_compile_options(-pthread)  # gRPC's users have it; with it everywhere, one precompiled header serves all

# What most sources include is compiled once and shared: half of a build from scratch went into reading Eigen, gRPC and gtest
# again. check.sh goes without: it sees what lacks an include.
option(DHPMAP_PRECOMPILE "Share precompiled headers" ON)
if(DHPMAP_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC collects its garbage, with what came from a precompiled header each time, once a heap of megabytes has grown by a
  # third: a tenth of what a source takes. None of ours fills a gigabyte.
  add_compile_options("SHELL:--param ggc-min-expand=1000 --param ggc-min-heapsize=1000000")
endif()

# The same sums on every machine: fused multiply-add would round differently where it exists.
add_compile_options(-ffp-contract=off)

if(DHPMAP_SANITIZE STREQUAL "address")
  # A null pointer ends the program anyway, and AddressSanitizer says where; with the two others, the checks of each access
  # were half of a build.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,object-size,vptr -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(DHPMAP_SANITIZED)
elseif(DHPMAP_SANITIZE STREQUAL "thread")
  # Where protobuf's headers see __SANITIZE_THREAD__, they give every map field two more members, which Debian's library
  # does not know of. Only the standard library needs to be told, of what else reads it.
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer -U__SANITIZE_THREAD__)
  add_link_options(-fsanitize=thread)
  add_compile_definitions(DHPMAP_SANITIZED DHPMAP_THREAD_SANITIZER _GLIBCXX_TSAN=1)
elseif(DHPMAP_SANITIZE STREQUAL "fuzzer")  # clang only; tests/fuzz links the fuzzers themselves
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(DHPMAP_SANITIZED)
elseif(DHPMAP_SANITIZE)
  message(FATAL_ERROR "DHPMAP_SANITIZE is '${DHPMAP_SANITIZE}', not address, thread or fuzzer")
endif()

if(DHPMAP_PRECOMPILE AND DHPMAP_CCACHE)  # which needs care beside precompiled headers
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_CURRENT_LIST_DIR}/ccache.sh ${DHPMAP_CCACHE})
  add_compile_options("$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()

# dhpmap_prelude(NAME LIBS ... [OPTIONS ...] HEADERS ...): headers for targets to share by dhpmap_use_prelude.
function(dhpmap_prelude name)
  cmake_parse_arguments(ARG "" "" "LIBS;OPTIONS;HEADERS" ${ARGN})
  if(NOT DHPMAP_PRECOMPILE)
    return()
  endif()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${name}.cc CONTENT "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cc)
  target_link_libraries(${name} PRIVATE ${ARG_LIBS})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# dhpmap_use_prelude(TARGET KIND STUBS): dhpmap_KIND_prelude (KIND is sources or tests), or with STUBS the one that has those too.
function(dhpmap_use_prelude target kind stubs)
  if(NOT DHPMAP_PRECOMPILE)
    return()
  endif()
  if(stubs)
    set(kind ${kind}_stubs)
  endif()
  target_precompile_headers(${target} REUSE_FROM dhpmap_${kind}_prelude)
endfunction()

# Templates that each source of a room would instantiate anew, eight of them do once: the other half of a build from scratch.
# A build that is mended source by source is quicker without.
option(DHPMAP_TOGETHER "Compile sources of a room together" ${DHPMAP_PRECOMPILE})

# dhpmap_compile_together(TARGET SOURCES...): these sources go by themselves, as they name something of theirs like another source does.
function(dhpmap_compile_together target)
  if(DHPMAP_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)  # takes all but one for headers
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
endfunction()

set(dhpmap_prelude_headers <algorithm> <array> <atomic> <chrono> <cmath> <condition_variable> <cstdint> <cstring> <deque> <filesystem>
  <fstream> <functional> <map> <memory> <mutex> <numeric> <optional> <random> <set> <span> <sstream> <stop_token> <string>
  <string_view> <thread> <tuple> <unordered_map> <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry>)

# Of the tests' own sources; what they test stays as it is released. Expectations expand to much; UndefinedBehaviorSanitizer's
# checks, a third of the time of a source, and those of temporaries' scopes, another fourth, are for what is tested.
# AddressSanitizer's others stay.
set(dhpmap_test_options $<$<CONFIG:Release>:-O1>)
if(DHPMAP_SANITIZE STREQUAL "address")
  list(APPEND dhpmap_test_options -fno-sanitize=undefined -fno-sanitize-address-use-after-scope)
endif()
# Those that come with gRPC's headers compute little and take long to compile: a third less without optimising.
set(dhpmap_stub_test_options ${dhpmap_test_options})
if(DHPMAP_SANITIZE STREQUAL "address")
  list(APPEND dhpmap_stub_test_options -O0)
endif()

add_library(dhpmap_warnings INTERFACE)
target_compile_options(dhpmap_warnings INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -Wno-missing-field-initializers  # designated initialisers leave out what stays default
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # false alarms of GCC 12 on std::string (its bug 105329)
if(DHPMAP_WERROR)  # off under sanitizers, whose instrumentation makes GCC see uninitialised values that are none
  target_compile_options(dhpmap_warnings INTERFACE -Werror)
endif()

# Of what is released; tests write numbers down as they come. Only GCC's: clang counts changes of sign among them.
set(dhpmap_source_options)
if(DHPMAP_WERROR)
  set(dhpmap_source_options $<$<CXX_COMPILER_ID:GNU>:-Wconversion>)
endif()

# Only the rooms that map take numbers for vectors, which have to be aligned.
if(DHPMAP_SANITIZE STREQUAL "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(dhpmap_unaligned -fno-sanitize=alignment)
endif()

function(dhpmap_library)
  cmake_parse_arguments(ARG "STUBS" "NAME" "SOURCES;PUBLIC;PRIVATE;ALONE" ${ARGN})
  add_library(${ARG_NAME} STATIC ${ARG_SOURCES})
  target_include_directories(${ARG_NAME} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(${ARG_NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:dhpmap_warnings>)
  target_compile_options(${ARG_NAME} PRIVATE ${dhpmap_source_options})
  if(NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${CMAKE_SOURCE_DIR}/mapping/")
    target_compile_options(${ARG_NAME} PRIVATE ${dhpmap_unaligned})
  endif()
  dhpmap_use_prelude(${ARG_NAME} sources ${ARG_STUBS})
  dhpmap_compile_together(${ARG_NAME} ${ARG_ALONE})
endfunction()

function(dhpmap_program)
  cmake_parse_arguments(ARG "STUBS" "NAME" "SOURCES;LIBS;ALONE" ${ARGN})
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_include_directories(${ARG_NAME} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${ARG_NAME} PRIVATE ${ARG_LIBS} dhpmap_warnings)
  target_compile_options(${ARG_NAME} PRIVATE ${dhpmap_source_options})
  if(NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${CMAKE_SOURCE_DIR}/mapping/")
    target_compile_options(${ARG_NAME} PRIVATE ${dhpmap_unaligned})
  endif()
  dhpmap_use_prelude(${ARG_NAME} sources ${ARG_STUBS})
  dhpmap_compile_together(${ARG_NAME} ${ARG_ALONE})
endfunction()

# What the sanitizer runs build: unit tests of what is served or talks to a server, those of tools that work on files at
# home, and the tests of rooms that start threads. Tests of the sources' text and of scripts are none of them.
add_custom_target(dhpmap_unit_tests)
add_custom_target(dhpmap_tool_tests)
add_custom_target(dhpmap_threaded_tests)

function(dhpmap_tests)
  cmake_parse_arguments(ARG "STUBS" "ROOM;COST;SHARDS" "LIBS;ENVIRONMENT;ALONE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tests/${ARG_ROOM}/*_test.cc)
  if(NOT sources)
    return()
  endif()
  string(REPLACE "/" "_" name ${ARG_ROOM}_test)
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} dhpmap_test_places GTest::gtest GTest::gtest_main dhpmap_warnings)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(ARG_STUBS)
    target_compile_options(${name} PRIVATE ${dhpmap_stub_test_options})
  else()
    target_compile_options(${name} PRIVATE ${dhpmap_test_options})
  endif()
  dhpmap_use_prelude(${name} tests ${ARG_STUBS})
  list(TRANSFORM ARG_ALONE PREPEND ${CMAKE_SOURCE_DIR}/tests/${ARG_ROOM}/)
  dhpmap_compile_together(${name} ${ARG_ALONE})
  string(REGEX MATCH "^[a-z0-9]+" label ${ARG_ROOM})
  if(ARG_ROOM MATCHES "^unit/clients/(evaluator|simulator)")
    add_dependencies(dhpmap_tool_tests ${name})
  elseif(label STREQUAL unit AND NOT ARG_ROOM MATCHES "^unit/(architecture|deploy)$")
    add_dependencies(dhpmap_unit_tests ${name})
  endif()
  if(ARG_ROOM MATCHES "^(integration|unit/(server/(app|wire|net|grpc|http|json|gateway|config|log|metrics)|storage|mapping/(base|crf|evidence|refinement|pipeline)))$")
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
    if(NOT ARG_SHARDS)
      set(ARG_SHARDS 1)
    endif()
    foreach(shard RANGE 1 ${ARG_SHARDS})
      set(suffix)
      if(ARG_SHARDS GREATER 1)
        set(suffix .${shard}of${ARG_SHARDS})
      endif()
      math(EXPR index "${shard} - 1")
      add_test(NAME ${ARG_ROOM}${suffix} COMMAND ${name} --gtest_output=xml:${CMAKE_BINARY_DIR}/tests/reports/${name}${suffix}.xml)
      set_tests_properties(${ARG_ROOM}${suffix} PROPERTIES TIMEOUT 1200 ${properties})
      set_property(TEST ${ARG_ROOM}${suffix} APPEND PROPERTY ENVIRONMENT GTEST_TOTAL_SHARDS=${ARG_SHARDS} GTEST_SHARD_INDEX=${index})
    endforeach()
  else()
    gtest_discover_tests(${name} TEST_PREFIX "${ARG_ROOM}/" DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 240 ${properties})
  endif()
endfunction()
