if(TARGET dhpmap_datasets)
  find_package(OpenCVParts REQUIRED)
  dhpmap_tests(ROOM unit/clients/datasets LIBS dhpmap_datasets dhpmap_test_scenes OpenCVParts::core OpenCVParts::imgcodecs)
endif()
