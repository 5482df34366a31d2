# Real processes.
find_package(OpenCVParts REQUIRED)
dhpmap_library(NAME dhpmap_server_process SOURCES e2e/process.cc e2e/server_process.cc
  PUBLIC dhpmap_proto PRIVATE dhpmap_test_places)
dhpmap_library(NAME dhpmap_e2e SOURCES e2e/rendered_dataset.cc e2e/same_maps.cc
  PUBLIC dhpmap_server_process dhpmap_test_scenes dhpmap_proto
  PRIVATE OpenCVParts::core OpenCVParts::imgcodecs GTest::gtest)
dhpmap_tests(ROOM e2e STUBS LIBS dhpmap_e2e dhpmap_http_client dhpmap_rig_kills dhpmap_test_server)
add_dependencies(e2e_test dhpmap-server dhpmap dhpmap-simulate dhpmap-evaluate)
