find_package(OpenCVParts REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
dhpmap_tests(ROOM unit/clients/command_line LIBS dhpmap_command_line dhpmap_test_scenes CLI11::CLI11)
dhpmap_tests(ROOM unit/clients/datasets LIBS dhpmap_datasets dhpmap_test_scenes OpenCVParts::core OpenCVParts::imgcodecs)
dhpmap_tests(ROOM unit/clients/cli STUBS LIBS dhpmap_cli dhpmap_test_scenes nlohmann_json::nlohmann_json)
dhpmap_tests(ROOM unit/clients/simulator COST 9 SHARDS 2 LIBS dhpmap_simulator dhpmap_datasets dhpmap_test_scenes nlohmann_json::nlohmann_json
  ALONE apartment_test.cc flat_recording_test.cc panoptic_noise_test.cc renderer_test.cc)
dhpmap_tests(ROOM unit/clients/evaluator/baselines LIBS dhpmap_baselines dhpmap_test_scenes
  ALONE single_map_test.cc)
dhpmap_tests(ROOM unit/clients/evaluator COST 6
  LIBS dhpmap_evaluator dhpmap_test_scenes OpenCVParts::core OpenCVParts::imgcodecs nlohmann_json::nlohmann_json CLI11::CLI11
  ALONE semantic_score_test.cc)
target_sources(unit_clients_evaluator_test PRIVATE ${CMAKE_CURRENT_LIST_DIR}/e2e/rendered_dataset.cc)
