// SPDX-License-Identifier: BSD-3-Clause
// Debian's gRPC, protobuf and abseil are built without ThreadSanitizer, so it does not see how they hand memory from
// thread to thread. Our own threads are checked in full where gRPC is not in the way: unit/server/app, storage,
// pipeline.
#if defined(__SANITIZE_THREAD__)
extern "C" __attribute__((visibility("default"))) const char* __tsan_default_suppressions() {
  return "called_from_lib:libgrpc.so\n"
         "called_from_lib:libgrpc++.so\n"
         "called_from_lib:libgpr.so\n"
         "called_from_lib:libprotobuf.so\n"
         "race:^grpc::\n"
         "race:libgrpc.so\n"
         "race:libgrpc++.so\n"
         "race:libprotobuf.so\n"
         "race:google::protobuf\n"
         "race:dhpmap::v1::\n"
         "race:libabsl_\n"
         "deadlock:libabsl_\n"
         "mutex:libOpenNI2.so\n";  // comes with PCL; at exit
}
#endif
