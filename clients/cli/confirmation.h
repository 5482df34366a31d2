// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "mapping/base/status.h"

namespace dhpmap {

/// Asks "QUESTION [y/N] "; OK if the answer is "y" or "yes", else ABORTED. FAILED_PRECONDITION, without asking, if
/// `is_terminal` is false.
Status Confirm(const std::string& question, bool is_terminal, std::istream& in, std::ostream& out);

}  // namespace dhpmap
