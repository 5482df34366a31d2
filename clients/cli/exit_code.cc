// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/exit_code.h"

namespace dhpmap {

ExitCode ExitCodeOf(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::OK: return ExitCode::kOk;
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::OUT_OF_RANGE:
    case grpc::StatusCode::FAILED_PRECONDITION:
    case grpc::StatusCode::UNIMPLEMENTED: return ExitCode::kBadRequest;
    case grpc::StatusCode::NOT_FOUND: return ExitCode::kNotFound;
    case grpc::StatusCode::ALREADY_EXISTS:
    case grpc::StatusCode::ABORTED: return ExitCode::kConflict;
    case grpc::StatusCode::UNAVAILABLE:
    case grpc::StatusCode::DEADLINE_EXCEEDED: return ExitCode::kUnreachable;
    default: return ExitCode::kServerFailed;
  }
}

const char* ExitCodeHelp() {
  return "Exit codes: 0 done; 1 bad command line; 2 the server refused the request (INVALID_ARGUMENT, OUT_OF_RANGE,\n"
         "FAILED_PRECONDITION, UNIMPLEMENTED); 3 NOT_FOUND; 4 ALREADY_EXISTS or ABORTED; 5 the server cannot be "
         "reached or\n"
         "took too long; 6 the server failed; 7 a local file or data set cannot be read or written; 8 frames were "
         "refused,\n"
         "or none could be used; 130 interrupted.";
}

}  // namespace dhpmap
