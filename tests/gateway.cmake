# Messages with every kind of field, a blocking HTTP client, a gRPC server with canned answers.
set(json_tests ${CMAKE_CURRENT_SOURCE_DIR}/unit/server/json)
set(json_out ${CMAKE_CURRENT_BINARY_DIR}/json)
file(MAKE_DIRECTORY ${json_out})
add_custom_command(OUTPUT ${json_out}/json_test.pb.cc ${json_out}/json_test.pb.h
  COMMAND protobuf::protoc --cpp_out=${json_out} -I${json_tests} -I${DHPMAP_GOOGLEAPIS_DIR} ${json_tests}/json_test.proto
  DEPENDS ${json_tests}/json_test.proto)
add_custom_target(dhpmap_json_test_generated DEPENDS ${json_out}/json_test.pb.cc ${json_out}/json_test.pb.h)
add_dependencies(dhpmap_generated dhpmap_json_test_generated)
find_package(Protobuf REQUIRED)
find_package(gRPC CONFIG REQUIRED)
# An object library: the linker must not drop the descriptors.
add_library(dhpmap_json_test_proto OBJECT ${json_out}/json_test.pb.cc)
target_compile_options(dhpmap_json_test_proto PRIVATE -w)
target_include_directories(dhpmap_json_test_proto SYSTEM PUBLIC ${json_out})
target_link_libraries(dhpmap_json_test_proto PUBLIC dhpmap_proto)

set(gateway_tests ${CMAKE_CURRENT_SOURCE_DIR}/unit/server/gateway)
add_library(dhpmap_http_client STATIC ${CMAKE_CURRENT_SOURCE_DIR}/unit/server/http/http_client.cc)
target_include_directories(dhpmap_http_client PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(dhpmap_http_client PUBLIC dhpmap_http PRIVATE dhpmap_warnings)
add_library(dhpmap_canned_server STATIC ${gateway_tests}/canned_server.cc)
target_include_directories(dhpmap_canned_server PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(dhpmap_canned_server PUBLIC dhpmap_gateway dhpmap_proto PRIVATE dhpmap_warnings)

dhpmap_tests(ROOM unit/server/http STUBS LIBS dhpmap_http_client dhpmap_http dhpmap_proto_types dhpmap_proto)
dhpmap_tests(ROOM unit/server/json STUBS LIBS dhpmap_json_test_proto dhpmap_json dhpmap_proto)
dhpmap_tests(ROOM unit/server/gateway STUBS COST 6
  LIBS dhpmap_canned_server dhpmap_http_client dhpmap_json_test_proto dhpmap_gateway dhpmap_proto)

# Both doors of a server with keys.
add_library(dhpmap_locked_server STATIC EXCLUDE_FROM_ALL ${CMAKE_CURRENT_SOURCE_DIR}/integration/auth/locked_server.cc)
target_include_directories(dhpmap_locked_server PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(dhpmap_locked_server PUBLIC dhpmap_test_server dhpmap_http_client dhpmap_gateway dhpmap_auth
  GTest::gtest PRIVATE dhpmap_warnings)
dhpmap_tests(ROOM integration/auth STUBS COST 6 LIBS dhpmap_locked_server)
dhpmap_tests(ROOM integration/fleet STUBS COST 6 LIBS dhpmap_client dhpmap_locked_server dhpmap_test_postgres_cluster dhpmap_tls_client dhpmap_net)
