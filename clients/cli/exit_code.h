// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/status.h"

namespace dhpmap {

/// Exit codes of the program, for scripts. Part of the interface: numbers never change their meaning.
enum class ExitCode : int {
  kOk = 0,
  kUsage = 1,         ///< bad command line
  kBadRequest = 2,    ///< INVALID_ARGUMENT, OUT_OF_RANGE, FAILED_PRECONDITION, UNIMPLEMENTED
  kNotFound = 3,      ///< NOT_FOUND
  kConflict = 4,      ///< ALREADY_EXISTS, ABORTED
  kUnreachable = 5,   ///< UNAVAILABLE, DEADLINE_EXCEEDED
  kServerFailed = 6,  ///< INTERNAL, DATA_LOSS and every other code
  kLocalFile = 7,     ///< a local file or data set cannot be read or written
  kPartly = 8,        ///< frames were refused, or none could be used
  kInterrupted = 130,
};

ExitCode ExitCodeOf(client::StatusCode code);

/// The table above as text for --help.
const char* ExitCodeHelp();

}  // namespace dhpmap
