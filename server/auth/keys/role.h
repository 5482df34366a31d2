// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace dhpmap::auth {

/// The role of a key. docs/security.md lists what each role may do.
enum class Role { kViewer, kEditor, kRobot, kAdmin };

inline constexpr std::array kRoles = {Role::kViewer, Role::kEditor, Role::kRobot, Role::kAdmin};

/// "viewer", "editor", "robot", "admin".
constexpr std::string_view NameOf(Role role) {
  switch (role) {
    case Role::kViewer: return "viewer";
    case Role::kEditor: return "editor";
    case Role::kRobot: return "robot";
    case Role::kAdmin: return "admin";
  }
  return "";
}

constexpr std::optional<Role> RoleFromName(std::string_view name) {
  for (const Role role : kRoles) {
    if (NameOf(role) == name) return role;
  }
  return std::nullopt;
}

}  // namespace dhpmap::auth
