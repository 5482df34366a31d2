find_package(Protobuf REQUIRED)  # before gRPC, see proto/
find_package(gRPC CONFIG REQUIRED)

dhpmap_tests(ROOM unit/server/auth STUBS LIBS dhpmap_auth dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/auth/keys LIBS dhpmap_auth_keys dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/app LIBS dhpmap_app dhpmap_test_map_text dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/config LIBS dhpmap_server_config dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/grpc STUBS LIBS dhpmap_grpc dhpmap_proto dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/log LIBS dhpmap_log)
dhpmap_tests(ROOM unit/server/metrics LIBS dhpmap_metrics)
dhpmap_tests(ROOM unit/server/net LIBS dhpmap_net)
dhpmap_tests(ROOM unit/server/wire STUBS LIBS dhpmap_wire dhpmap_test_scenes)
dhpmap_tests(ROOM unit/server/wire/types STUBS LIBS dhpmap_wire_types dhpmap_test_scenes)
