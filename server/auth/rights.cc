// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/rights.h"

#include <google/protobuf/descriptor.h>

#include <string>
#include <utility>

namespace dhpmap::auth {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

Status Denied(std::string message) { return {StatusCode::kPermissionDenied, std::move(message)}; }

bool Has(Role role, Need need) {
  switch (need) {
    case v1::Access::READ: return true;
    case v1::Access::EDIT: return role == Role::kEditor || role == Role::kAdmin;
    case v1::Access::FEED:
    case v1::Access::CREATE: return role == Role::kRobot || role == Role::kAdmin;
    case v1::Access::OPERATE: return role == Role::kAdmin;
    default: return false;  // deny by default
  }
}

Status RoleDenied(const Principal& principal, Need need) {
  std::string message = "the role of '" + principal.name + "' is " + std::string(NameOf(principal.role)) +
                        ": the call needs " + v1::Access::Need_Name(need);
  if (need == v1::Access::EDIT) message += "; with validate_only it may be tried";
  return Denied(std::move(message)).WithReason("ROLE_NOT_ALLOWED");
}

/// The message that contains the last field of the path; null if a message on the way is not set.
Message* HolderOf(const FieldPath& path, Message& request) {
  Message* holder = &request;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (!holder->GetReflection()->HasField(*holder, path[i])) return nullptr;
    holder = holder->GetReflection()->MutableMessage(holder, path[i]);
  }
  return holder;
}

/// The values of one message's fields that matter for access control.
struct Said {
  std::string map;  ///< its id; empty for a malformed name, which only "*" permits
  bool names_map = false;
  std::string session;
  bool has_session = false;
  bool takes_over = false;
  bool only_tries = false;
  Message* author_holder = nullptr;
  const FieldDescriptor* author = nullptr;
};

std::string MapIdOf(const std::string& name) {
  constexpr std::string_view kPrefix = "maps/";
  if (!name.starts_with(kPrefix)) return {};
  return name.substr(kPrefix.size(), name.find('/', kPrefix.size()) - kPrefix.size());
}

void Read(Meaning meaning, const FieldDescriptor& field, Message& holder, Said& said) {
  const auto& reflection = *holder.GetReflection();
  if (meaning == v1::Access::VALIDATE_ONLY) said.only_tries |= reflection.GetBool(holder, &field);
  if (meaning == v1::Access::TAKE_OVER) said.takes_over |= reflection.GetBool(holder, &field);
  if (meaning == v1::Access::MAP || meaning == v1::Access::MAP_ID) {
    const std::string text = reflection.GetString(holder, &field);
    if (text.empty()) return;
    said.names_map = true;
    said.map = meaning == v1::Access::MAP_ID ? text : MapIdOf(text);
  }
  if (meaning == v1::Access::SESSION) {
    said.has_session = true;
    said.session = reflection.GetString(holder, &field);
  }
  if (meaning == v1::Access::AUTHOR) {
    said.author_holder = &holder;
    said.author = &field;
  }
}

Said Read(const CallNeeds& needs, Message& request) {
  Said said;
  for (const auto& [meaning, path] : needs.fields) {
    if (Message* holder = HolderOf(path, request)) Read(meaning, *path.back(), *holder, said);
  }
  return said;
}

/// A feed without a session belongs to nobody. Anybody with FEED may start one, but not end it or take it over.
Status CheckSession(const Principal& principal, const CallNeeds& needs, const Said& said) {
  const bool joins_as_nobody = said.session.empty() && !said.takes_over && needs.is_stream;
  if (joins_as_nobody || principal.sessions.Match(said.session)) return Status::Ok();
  return Denied("'" + principal.name + "' may not feed, take over or end " +
                (said.session.empty() ? "what names no session" : "this session"))
      .WithReason("NOT_YOUR_SESSION");
}

Status CheckAuthor(const Principal& principal, const Said& said) {
  const auto& reflection = *said.author_holder->GetReflection();
  const std::string author = reflection.GetString(*said.author_holder, said.author);
  if (author.empty()) {
    reflection.SetString(said.author_holder, said.author, principal.name);
    return Status::Ok();
  }
  // An admin may repeat the edits of others (`dhpmap replay`).
  if (principal.role == Role::kAdmin || IsOwnName(principal.name, author)) return Status::Ok();
  return Denied("the author must be '" + principal.name + "', or begin with '" + principal.name + "/'")
      .WithReason("NOT_YOUR_NAME");
}

}  // namespace

bool RoleHas(Role role, const CallNeeds& needs) { return Has(role, needs.need) || needs.can_only_try; }

Status CheckRole(const Principal& principal, const CallNeeds& needs) {
  if (!RoleHas(principal.role, needs)) return RoleDenied(principal, needs.need);
  if (needs.maps == v1::Access::ALL && !principal.maps.match_all()) {
    return Denied("the call is about every map, and '" + principal.name + "' is not for all")
        .WithReason("MAP_NOT_ALLOWED");
  }
  return Status::Ok();
}

Status CheckMap(const Principal& principal, std::string_view map_id) {
  if (principal.maps.Match(map_id)) return Status::Ok();
  return Denied("'" + principal.name + "' may not ask for this map").WithReason("MAP_NOT_ALLOWED");
}

Status CheckRequest(const Principal& principal, const CallNeeds& needs, Message& request) {
  const Said said = Read(needs, request);
  if (!Has(principal.role, needs.need) && !(needs.can_only_try && said.only_tries)) {
    return RoleDenied(principal, needs.need);
  }
  if (said.names_map) DHPMAP_RETURN_IF_ERROR(CheckMap(principal, said.map));
  if (said.has_session) DHPMAP_RETURN_IF_ERROR(CheckSession(principal, needs, said));
  return said.author != nullptr ? CheckAuthor(principal, said) : Status::Ok();
}

std::string MapNamed(const CallNeeds& needs, const Message& request) {
  for (const auto& [meaning, path] : needs.fields) {
    if (meaning != v1::Access::MAP && meaning != v1::Access::MAP_ID) continue;
    const Message* holder = &request;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) holder = &holder->GetReflection()->GetMessage(*holder, path[i]);
    const std::string text = holder->GetReflection()->GetString(*holder, path.back());
    if (!text.empty()) return meaning == v1::Access::MAP_ID ? text : MapIdOf(text);
  }
  return {};
}

bool IsOwnName(std::string_view principal, std::string_view author) {
  if (!author.starts_with(principal)) return false;
  author.remove_prefix(principal.size());
  return author.empty() || author.starts_with('/');
}

}  // namespace dhpmap::auth
