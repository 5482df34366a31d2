// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dhpmap/v1/query_options.pb.h"
#include "mapping/base/status.h"

namespace CLI {
class App;
}

namespace dhpmap {

/// What of a robot may touch what.
struct AllowFlags {
  std::vector<std::string> allowed;  ///< "PART:WHAT"
  std::vector<std::string> links;    ///< a name a body, or sphere
};

/// `parts`: what links have a name for, "body".
void AddAllowFlags(CLI::App& command, const std::string& parts, AllowFlags& flags);

/// Adds them to the options. PART is a link or the id of something attached, or none: the whole robot; WHAT is a class
/// or the id of an object. INVALID_ARGUMENT for one without WHAT.
Status AddAllowed(const AllowFlags& flags, const std::string& map, v1::QueryOptions& options);

}  // namespace dhpmap
