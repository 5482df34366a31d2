// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/allow_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "clients/cli/connection.h"

namespace dhpmap {
namespace {

bool IsId(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

void AddAllowFlags(CLI::App& command, const std::string& parts, AllowFlags& flags) {
  command.add_option("--allow-collision", flags.allowed,
                     "PART:TARGET [...]: a link or attached id (empty: the robot), and the class or id it may touch");
  command.add_option("--links", flags.links, "To which link each " + parts + " belongs, a name each");
}

Status AddAllowed(const AllowFlags& flags, const std::string& map, v1::QueryOptions& options) {
  for (const std::string& text : flags.allowed) {
    const std::size_t colon = text.rfind(':');
    const std::string part = colon == std::string::npos ? "" : text.substr(0, colon);
    const std::string what = colon == std::string::npos ? text : text.substr(colon + 1);
    if (what.empty()) return InvalidArgument("--allow-collision '" + text + "' does not say what may be touched");
    v1::AllowedCollision& allowed = *options.add_allowed_collisions();
    if (IsId(part)) allowed.set_attached(MapName(map) + "/submaps/" + part);
    else allowed.set_link(part);
    if (IsId(what)) allowed.set_submap(MapName(map) + "/submaps/" + what);
    else allowed.set_class_name(what);
  }
  return Status::Ok();
}

}  // namespace dhpmap
