// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iosfwd>
#include <string>

#include "mapping/base/status.h"

namespace dhpmap {

/// OK if whoever sits at the terminal says "y" or "yes" to the question, which is put as "QUESTION [y/N] ". ABORTED
/// for anything else; FAILED_PRECONDITION, without a question, where `is_terminal` says that nobody sits there.
Status Confirm(const std::string& question, bool is_terminal, std::istream& in, std::ostream& out);

}  // namespace dhpmap
