find_package(OpenCVParts REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
dhpmap_tests(ROOM unit/clients/command_line LIBS dhpmap_command_line dhpmap_test_scenes CLI11::CLI11)
dhpmap_tests(ROOM unit/clients/datasets LIBS dhpmap_datasets dhpmap_test_scenes OpenCVParts::core OpenCVParts::imgcodecs)
find_package(octomap REQUIRED)  # reads what we write
dhpmap_tests(ROOM unit/clients/cli STUBS LIBS dhpmap_cli dhpmap_test_scenes nlohmann_json::nlohmann_json octomap octomath)
dhpmap_tests(ROOM unit/clients/cpp STUBS COST 10 LIBS dhpmap_client dhpmap_test_server dhpmap_server_process)
add_dependencies(unit_clients_cpp_test dhpmap-server dhpmap)
if(TARGET dhpmap_ompl)
  dhpmap_tests(ROOM unit/clients/cpp/ompl COST 10 LIBS dhpmap_ompl dhpmap_proto dhpmap_server_process dhpmap_test_scenes)
  add_dependencies(unit_clients_cpp_ompl_test dhpmap-server dhpmap dhpmap-simulate dhpmap-plan-example)
endif()
if(NOT DHPMAP_SANITIZE)  # whose libraries only link with what is sanitized, too
  add_custom_target(package_test DEPENDS dhpmap_client $<TARGET_NAME_IF_EXISTS:dhpmap_ompl> dhpmap-server dhpmap dhpmap-simulate)
  dhpmap_room_of_tests(ROOM package TARGET package_test COST 25
    COMMAND /usr/bin/python3 -B ${CMAKE_CURRENT_LIST_DIR}/package/package_test.py ${CMAKE_BINARY_DIR})
endif()
dhpmap_tests(ROOM unit/clients/simulator COST 9 LIBS dhpmap_simulator dhpmap_datasets dhpmap_test_scenes nlohmann_json::nlohmann_json)
dhpmap_tests(ROOM unit/clients/evaluator/baselines LIBS dhpmap_baselines dhpmap_test_scenes)
dhpmap_tests(ROOM unit/clients/evaluator COST 6
  LIBS dhpmap_evaluator dhpmap_test_scenes OpenCVParts::core OpenCVParts::imgcodecs nlohmann_json::nlohmann_json CLI11::CLI11)
target_sources(unit_clients_evaluator_test PRIVATE ${CMAKE_CURRENT_LIST_DIR}/e2e/rendered_dataset.cc)

if(TARGET python_client)
  add_custom_target(unit_clients_python_test DEPENDS python_client dhpmap-server dhpmap-simulate)
  dhpmap_room_of_tests(ROOM unit/clients/python TARGET unit_clients_python_test COST 20 GTEST
    COMMAND /usr/bin/python3 -B ${CMAKE_SOURCE_DIR}/tests/unit/clients/python/run_cases.py --bin $<TARGET_FILE_DIR:dhpmap-server>)
endif()
