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

/// Allowed contacts of a robot, from the command line.
struct AllowFlags {
  std::vector<std::string> allowed;  ///< "PART:WHAT"
  std::vector<std::string> links;    ///< a name for each body or sphere
};

/// `parts`: what the links name, such as "body".
void AddAllowFlags(CLI::App& command, const std::string& parts, AllowFlags& flags);

/// Adds the flags to the options. PART is a link, the id of an attached object, or empty for the whole robot; WHAT is a
/// class or the id of an object. INVALID_ARGUMENT if WHAT is missing.
Status AddAllowed(const AllowFlags& flags, const std::string& map, v1::QueryOptions& options);

}  // namespace dhpmap
