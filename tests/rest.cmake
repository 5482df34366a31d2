# A gRPC server with canned answers, a blocking HTTP client, and messages with every kind of field.
set(rest_dir ${CMAKE_CURRENT_SOURCE_DIR}/unit/server/rest)
set(rest_out ${CMAKE_CURRENT_BINARY_DIR}/rest)
file(MAKE_DIRECTORY ${rest_out})
add_custom_command(OUTPUT ${rest_out}/rest_test.pb.cc ${rest_out}/rest_test.pb.h
  COMMAND protobuf::protoc --cpp_out=${rest_out} -I${rest_dir} -I${DHPMAP_GOOGLEAPIS_DIR} ${rest_dir}/rest_test.proto
  DEPENDS ${rest_dir}/rest_test.proto)
find_package(Protobuf REQUIRED)
find_package(gRPC CONFIG REQUIRED)
# An object library: the linker must not drop the descriptors.
add_library(dhpmap_rest_test_proto OBJECT ${rest_out}/rest_test.pb.cc)
target_compile_options(dhpmap_rest_test_proto PRIVATE -w)
target_include_directories(dhpmap_rest_test_proto SYSTEM PUBLIC ${rest_out})
target_link_libraries(dhpmap_rest_test_proto PUBLIC dhpmap_proto)

add_library(dhpmap_rest_support STATIC ${rest_dir}/canned_server.cc ${rest_dir}/http_client.cc)
target_include_directories(dhpmap_rest_support PUBLIC ${CMAKE_SOURCE_DIR})
target_link_libraries(dhpmap_rest_support PUBLIC dhpmap_rest dhpmap_proto PRIVATE dhpmap_warnings)

dhpmap_tests(ROOM unit/server/rest
  LIBS dhpmap_rest_support dhpmap_rest_test_proto dhpmap_rest dhpmap_app dhpmap_proto)
