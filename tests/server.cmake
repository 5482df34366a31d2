find_package(Protobuf REQUIRED)  # before gRPC, see proto/
find_package(gRPC CONFIG REQUIRED)

dhpmap_tests(ROOM unit/server/auth STUBS LIBS dhpmap_auth dhpmap_proto dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/auth/keys LIBS dhpmap_auth_keys dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/base LIBS dhpmap_server_base dhpmap_proto)
dhpmap_tests(ROOM unit/server/app LIBS dhpmap_app dhpmap_test_map_text dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/config LIBS dhpmap_server_config dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/grpc STUBS LIBS dhpmap_grpc dhpmap_proto dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/log LIBS dhpmap_log)
dhpmap_tests(ROOM unit/server/metrics LIBS dhpmap_metrics)
dhpmap_tests(ROOM unit/server/service LIBS dhpmap_service dhpmap_server_base dhpmap_test_scenes)
find_package(OpenSSL 3.0 REQUIRED)
set(net_tests ${CMAKE_CURRENT_SOURCE_DIR}/unit/server/net)
add_library(dhpmap_tls_client STATIC ${net_tests}/tls_client.cc ${net_tests}/test_certificates.cc)
target_include_directories(dhpmap_tls_client PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(dhpmap_tls_client PUBLIC dhpmap_net PRIVATE OpenSSL::SSL dhpmap_warnings)
dhpmap_tests(ROOM unit/server/net LIBS dhpmap_net dhpmap_http_client dhpmap_tls_client dhpmap_test_scenes OpenSSL::SSL)
dhpmap_tests(ROOM unit/server/wire STUBS LIBS dhpmap_wire dhpmap_test_scenes)
dhpmap_tests(ROOM unit/proto/types STUBS LIBS dhpmap_proto_types dhpmap_test_scenes)

# How far another process is behind commits to PostgreSQL; not a test.
dhpmap_program(NAME dhpmap_follow_bench SOURCES unit/server/app/follow_bench.cc LIBS dhpmap_app dhpmap_test_postgres_cluster dhpmap_test_scenes)
set_target_properties(dhpmap_follow_bench PROPERTIES EXCLUDE_FROM_ALL ON RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
