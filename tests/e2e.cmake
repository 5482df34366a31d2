# Real processes.
find_package(OpenCVParts REQUIRED)
dhpmap_library(NAME dhpmap_server_process SOURCES e2e/process.cc e2e/server_process.cc e2e/test_database.cc
  PUBLIC dhpmap_proto PRIVATE dhpmap_test_places dhpmap_test_postgres_cluster)
dhpmap_library(NAME dhpmap_e2e SOURCES e2e/rendered_dataset.cc e2e/same_maps.cc
  PUBLIC dhpmap_server_process dhpmap_test_postgres_cluster dhpmap_test_scenes dhpmap_proto
  PRIVATE OpenCVParts::core OpenCVParts::imgcodecs GTest::gtest)
dhpmap_tests(ROOM e2e STUBS LIBS dhpmap_e2e dhpmap_http_client dhpmap_tls_client dhpmap_rig_kills dhpmap_test_server)
add_dependencies(e2e_test dhpmap-server dhpmap dhpmap-simulate dhpmap-evaluate)
# The same programs on PostgreSQL, where that is installed: what stores, ends, restarts and follows. Without a filter all of
# e2e_test runs so, but for what is about the file itself.
file(GLOB initdb /usr/lib/postgresql/*/bin/initdb)
if(initdb)
  string(JOIN ":" cases Session.* Mapping.AfterARestart* Mapping.EndingTheServer* MapFiles.* EndSignals.* ShutdownGrace.* Replay.*
    EditCommands.ApplyAList* EditCommands.SplitABox* EditCommands.EachIsTried* EditsOverRest.* IfMatch.* ClassNames.* RestFeeders.*
    RestPast.* Watching.As* Watching.APosition* Watching.TheCommand* CommandLine.LogsUndoes* CommandLine.ReadsThePast*
    CommandLine.EditsObjects CommandLine.WhatIsStored* CommandLine.AMapIsRenamed)
  dhpmap_room_of_tests(ROOM e2e_postgres TARGET e2e_test GTEST COST 30 ENVIRONMENT TEST_STORE=postgres
    COMMAND $<TARGET_FILE:e2e_test> --gtest_filter=${cases})
endif()
dhpmap_tests(ROOM e2e/service COST 8 LIBS dhpmap_server_process dhpmap_http_client dhpmap_tls_client dhpmap_test_scenes)
add_dependencies(e2e_service_test dhpmap-server dhpmap)

# What operators read and load, against real programs: docs/operate.md, docs/fleet.md, deploy/monitoring.
if(NOT DHPMAP_SANITIZE)
  add_custom_target(e2e_operate_test DEPENDS dhpmap-server dhpmap dhpmap-simulate)
  foreach(name operate_page fleet_page monitoring)
    dhpmap_room_of_tests(ROOM e2e_${name} TARGET e2e_operate_test COST 5
      COMMAND /usr/bin/python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/e2e/${name}_test.py ${CMAKE_BINARY_DIR}/bin)
  endforeach()
endif()

# The viewer in a real browser, where Debian's Chromium is.
find_program(DHPMAP_CHROMEDRIVER chromedriver PATHS /usr/bin NO_DEFAULT_PATH)
execute_process(COMMAND /usr/bin/python3 -c "import selenium" RESULT_VARIABLE has_no_selenium OUTPUT_QUIET ERROR_QUIET)
if(DHPMAP_CHROMEDRIVER AND NOT has_no_selenium AND NOT DHPMAP_SANITIZE)
  add_custom_target(e2e_web_test DEPENDS dhpmap-server dhpmap dhpmap-simulate)
  dhpmap_room_of_tests(ROOM e2e_web TARGET e2e_web_test COST 60
    COMMAND /usr/bin/python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/e2e_web/viewer_test.py ${CMAKE_BINARY_DIR}/bin)
endif()

# The viewer's units, and whether its bundle is what its sources make: where node and its packages are.
find_program(DHPMAP_NODE node)
if(DHPMAP_NODE AND EXISTS ${CMAKE_SOURCE_DIR}/clients/web/node_modules/esbuild)
  foreach(check test.mjs "build.mjs --check")
    string(REGEX REPLACE "\\..*" "" name ${check})
    string(REPLACE " " ";" arguments ${check})
    list(TRANSFORM arguments PREPEND ${CMAKE_SOURCE_DIR}/clients/web/ AT 0)
    add_custom_target(unit_clients_web_${name})
    dhpmap_room_of_tests(ROOM unit/clients/web/${name} TARGET unit_clients_web_${name} COST 3 COMMAND ${DHPMAP_NODE} ${arguments})
  endforeach()
endif()
