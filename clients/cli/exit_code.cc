// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/exit_code.h"

namespace dhpmap {

ExitCode ExitCodeOf(client::StatusCode code) {
  switch (code) {
    case client::StatusCode::kOk: return ExitCode::kOk;
    case client::StatusCode::kInvalidArgument:
    case client::StatusCode::kOutOfRange:
    case client::StatusCode::kFailedPrecondition:
    case client::StatusCode::kUnimplemented: return ExitCode::kBadRequest;
    case client::StatusCode::kNotFound: return ExitCode::kNotFound;
    case client::StatusCode::kAlreadyExists:
    case client::StatusCode::kAborted: return ExitCode::kConflict;
    case client::StatusCode::kUnavailable:
    case client::StatusCode::kDeadlineExceeded: return ExitCode::kUnreachable;
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
