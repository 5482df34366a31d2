find_package(OpenCVParts REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
dhpmap_tests(ROOM unit/clients/command_line LIBS dhpmap_command_line dhpmap_test_scenes CLI11::CLI11)
dhpmap_tests(ROOM unit/clients/datasets LIBS dhpmap_datasets dhpmap_test_scenes OpenCVParts::core OpenCVParts::imgcodecs)
find_package(octomap REQUIRED)  # reads what we write
dhpmap_tests(ROOM unit/clients/cli STUBS LIBS dhpmap_cli dhpmap_test_scenes nlohmann_json::nlohmann_json octomap octomath)
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
