find_package(Protobuf REQUIRED)  # before gRPC, see proto/
find_package(gRPC CONFIG REQUIRED)

# An in-process server with rendered frames to feed it, and what may stand between it and a client.
add_library(dhpmap_test_server STATIC EXCLUDE_FROM_ALL integration/tcp_proxy.cc integration/test_server.cc integration/test_store.cc)
target_include_directories(dhpmap_test_server PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(dhpmap_test_server PUBLIC dhpmap_grpc dhpmap_proto dhpmap_storage dhpmap_test_scenes gRPC::grpc++
  PRIVATE dhpmap_test_postgres_cluster dhpmap_test_wire_frame dhpmap_warnings)
dhpmap_tests(ROOM integration STUBS COST 21 LIBS dhpmap_cli dhpmap_objects dhpmap_record dhpmap_service dhpmap_test_server)

# The same server on PostgreSQL, where that is installed: frames, sessions, edits, undo, watching and past states.
file(GLOB initdb /usr/lib/postgresql/*/bin/initdb)
if(initdb)
  dhpmap_room_of_tests(ROOM integration_postgres TARGET integration_test GTEST COST 20 ENVIRONMENT TEST_STORE=postgres
    COMMAND $<TARGET_FILE:integration_test>
      --gtest_filter=Feeds.*:Mapping.*:Sessions.*:WatchTest.*:EditTest.*:ApplyEditsTest.*:RestoreRevisionTest.*:ReadRevision.*:CarriedOff.*:EditFieldsTest.*)
endif()
