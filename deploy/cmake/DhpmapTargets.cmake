# dhpmap_library(NAME room_name SOURCES ... PUBLIC ... PRIVATE ... [STUBS]): one static library a room, with our warnings.
# dhpmap_program(NAME ... SOURCES ... LIBS ... [STUBS]): a program in bin/.
# dhpmap_tests(ROOM path LIBS ... [ENVIRONMENT name=value] [COST seconds] [STUBS]): all tests/<path>/*_test.cc
# as one test binary; COST is what it takes in the release build, where that is seconds: the costliest run first.
# STUBS: most of its sources include messages or gRPC; they share those headers too.
# Sources of a room are compiled 24 together: the names of their helpers are unique in the room.

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

# Half of the time that GNU ld takes; lld where clang compiles.
find_program(DHPMAP_GOLD ld.gold)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  add_link_options(-fuse-ld=lld-14)
elseif(DHPMAP_GOLD)
  add_link_options(-fuse-ld=gold)
endif()

# The same sums on every machine: fused multiply-add would round differently where it exists.
add_compile_options(-ffp-contract=off)

if(DHPMAP_SANITIZE STREQUAL "address")  # clang only: libFuzzer and the analysis of what a Mutex guards come with it
  # A null pointer ends the program anyway, and AddressSanitizer says where; with the two others, the checks of each access
  # were half of a build.
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize=null,object-size,vptr
    -fno-sanitize-recover=all -fno-omit-frame-pointer -Wthread-safety -Werror=thread-safety)
  add_link_options(-fsanitize=address,undefined)
  add_compile_definitions(DHPMAP_SANITIZED)
elseif(DHPMAP_SANITIZE STREQUAL "thread")
  # Where protobuf's headers see __SANITIZE_THREAD__, they give every map field two more members, which Debian's library
  # does not know of. Only the standard library needs to be told, of what else reads it.
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer -U__SANITIZE_THREAD__)
  add_link_options(-fsanitize=thread)
  add_compile_definitions(DHPMAP_SANITIZED DHPMAP_THREAD_SANITIZER _GLIBCXX_TSAN=1)
elseif(DHPMAP_SANITIZE)
  message(FATAL_ERROR "DHPMAP_SANITIZE is '${DHPMAP_SANITIZE}', not address or thread")
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

# Templates that each source of a room would instantiate anew, 24 of them do once: the other half of a build from scratch.
# A build that is mended source by source is quicker without.
option(DHPMAP_TOGETHER "Compile sources of a room together" ${DHPMAP_PRECOMPILE})

function(dhpmap_compile_together target)
  if(DHPMAP_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 24)
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)  # takes all but one for headers
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
set(dhpmap_stub_test_options ${dhpmap_test_options} -O0)

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
if(DHPMAP_SANITIZE STREQUAL "address")
  set(dhpmap_unaligned -fno-sanitize=alignment)
endif()

# dhpmap_compile_as_source(TARGET STUBS): as what is released; under tests/, what comes with gRPC's headers as tests are.
function(dhpmap_compile_as_source target stubs)
  target_compile_options(${target} PRIVATE ${dhpmap_source_options})
  if(NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${CMAKE_SOURCE_DIR}/mapping/")
    target_compile_options(${target} PRIVATE ${dhpmap_unaligned})
  endif()
  set(kind sources)
  if(stubs AND CMAKE_CURRENT_SOURCE_DIR MATCHES "^${CMAKE_SOURCE_DIR}/tests")
    set(kind tests)
    target_compile_options(${target} PRIVATE ${dhpmap_stub_test_options})
    target_link_libraries(${target} PRIVATE GTest::gtest)  # whose definitions the precompiled headers were made with
  endif()
  dhpmap_use_prelude(${target} ${kind} ${stubs})
  dhpmap_compile_together(${target})
endfunction()

function(dhpmap_library)
  cmake_parse_arguments(ARG "STUBS" "NAME" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${ARG_NAME} STATIC ${ARG_SOURCES})
  target_include_directories(${ARG_NAME} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(${ARG_NAME} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:dhpmap_warnings>)
  dhpmap_compile_as_source(${ARG_NAME} ${ARG_STUBS})
endfunction()

function(dhpmap_program)
  cmake_parse_arguments(ARG "STUBS" "NAME" "SOURCES;LIBS" ${ARGN})
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  target_include_directories(${ARG_NAME} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${ARG_NAME} PRIVATE ${ARG_LIBS} dhpmap_warnings)
  dhpmap_compile_as_source(${ARG_NAME} ${ARG_STUBS})
endfunction()

# dhpmap_room_of_tests(ROOM path TARGET name COMMAND ... [GTEST] [COST seconds] [ENVIRONMENT name=value]): a test of ctest, and a line of
# tests/rooms.json, by which deploy/ci/run_rooms.py finds it.
function(dhpmap_room_of_tests)
  cmake_parse_arguments(ARG "GTEST" "ROOM;TARGET;COST" "COMMAND;ENVIRONMENT" ${ARGN})
  string(REGEX MATCH "^[a-z0-9]+" label ${ARG_ROOM})
  add_test(NAME ${ARG_ROOM} COMMAND ${ARG_COMMAND})
  set_tests_properties(${ARG_ROOM} PROPERTIES LABELS ${label} TIMEOUT 1200)
  if(ARG_ENVIRONMENT)
    set_tests_properties(${ARG_ROOM} PROPERTIES ENVIRONMENT "${ARG_ENVIRONMENT}")
  endif()
  # What sanitizers run it: those that work on files at home are tools, the others serve or talk to a server; some start threads.
  # Tests of the sources' text and of scripts, and of whole processes, are none of them.
  set(kinds)
  if(ARG_ROOM MATCHES "^unit/clients/(evaluator|simulator)")
    list(APPEND kinds tool)
  elseif(label STREQUAL unit AND NOT ARG_ROOM MATCHES "^unit/(architecture|deploy|clients/python|clients/cpp/ompl)$")
    list(APPEND kinds served)
  endif()
  if(ARG_ROOM MATCHES
      "^(integration|unit/(clients/cpp|server/(app|auth|wire|net|grpc|http|json|gateway|config|log|metrics|service)|storage|mapping/(base|crf|evidence|refinement|pipeline)))$")
    list(APPEND kinds threaded)
  endif()
  if(NOT ARG_COST)
    set(ARG_COST 0)
  endif()
  set(entry "{\"room\": \"${ARG_ROOM}\", \"target\": \"${ARG_TARGET}\", \"command\": [\"$<JOIN:${ARG_COMMAND},\", \">\"]")
  string(APPEND entry ", \"is_gtest\": $<IF:$<BOOL:${ARG_GTEST}>,true,false>, \"cost_s\": ${ARG_COST}")
  foreach(name kinds ARG_ENVIRONMENT)
    list(JOIN ${name} "\", \"" ${name}_list)
    if(${name}_list)
      set(${name}_list "\"${${name}_list}\"")
    endif()
  endforeach()
  string(APPEND entry ", \"kinds\": [${kinds_list}], \"environment\": [${ARG_ENVIRONMENT_list}]}")
  set_property(GLOBAL APPEND_STRING PROPERTY dhpmap_rooms_of_tests "${entry},\n")
  set_property(GLOBAL APPEND PROPERTY dhpmap_targets_of_tests ${ARG_TARGET})
endfunction()

# dhpmap_write_rooms_of_tests(): tests/rooms.json, of all rooms named so far, and the target `tests`, which builds them.
function(dhpmap_write_rooms_of_tests)
  get_property(rooms GLOBAL PROPERTY dhpmap_rooms_of_tests)
  string(REGEX REPLACE ",\n$" "" rooms "${rooms}")
  file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/tests/rooms.json CONTENT "[\n${rooms}\n]\n")
  get_property(targets GLOBAL PROPERTY dhpmap_targets_of_tests)
  list(REMOVE_ITEM targets "")
  add_custom_target(tests DEPENDS ${targets})
endfunction()

function(dhpmap_tests)
  cmake_parse_arguments(ARG "STUBS" "ROOM;COST" "LIBS;ENVIRONMENT" ${ARGN})
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
  dhpmap_compile_together(${name})
  dhpmap_room_of_tests(ROOM ${ARG_ROOM} TARGET ${name} COMMAND $<TARGET_FILE:${name}> GTEST COST ${ARG_COST}
    ENVIRONMENT ${ARG_ENVIRONMENT})
endfunction()
