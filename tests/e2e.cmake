# Real processes.
find_package(OpenCVParts REQUIRED)
dhpmap_library(NAME dhpmap_e2e SOURCES e2e/process.cc e2e/rendered_dataset.cc e2e/same_maps.cc e2e/server_process.cc
  PUBLIC dhpmap_test_scenes dhpmap_proto
  PRIVATE OpenCVParts::core OpenCVParts::imgcodecs GTest::gtest)
target_compile_definitions(dhpmap_e2e PRIVATE DHPMAP_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
dhpmap_tests(ROOM e2e LIBS dhpmap_e2e dhpmap_test_server)
add_dependencies(e2e_test dhpmap-server dhpmap)
