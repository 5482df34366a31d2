find_package(Protobuf REQUIRED)  # before gRPC, see proto/
find_package(gRPC CONFIG REQUIRED)

# An in-process server with rendered frames to feed it, and what may stand between it and a client.
add_library(dhpmap_test_server STATIC EXCLUDE_FROM_ALL integration/tcp_proxy.cc integration/test_server.cc)
target_include_directories(dhpmap_test_server PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(dhpmap_test_server PUBLIC dhpmap_grpc dhpmap_proto dhpmap_storage dhpmap_test_scenes gRPC::grpc++
  PRIVATE dhpmap_test_wire_frame dhpmap_warnings)
dhpmap_tests(ROOM integration STUBS COST 21 LIBS dhpmap_cli dhpmap_objects dhpmap_record dhpmap_service dhpmap_test_server)
