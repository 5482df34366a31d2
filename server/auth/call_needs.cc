// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/call_needs.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include <algorithm>
#include <array>

#include "dhpmap/v1/auth_service.pb.h"
#include "dhpmap/v1/edit_service.pb.h"
#include "dhpmap/v1/fleet_service.pb.h"
#include "dhpmap/v1/map_service.pb.h"
#include "dhpmap/v1/mapping_service.pb.h"
#include "dhpmap/v1/query_service.pb.h"
#include "dhpmap/v1/server_service.pb.h"
#include "dhpmap/v1/submap_service.pb.h"
#include "dhpmap/v1/watch_service.pb.h"

namespace dhpmap::auth {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;
using google::protobuf::MethodDescriptor;
using google::protobuf::ServiceDescriptor;

/// A request has a map, and a message that has a name: deeper fields have no meaning for access control.
constexpr std::size_t kDeepest = 2;

void AddFields(const Descriptor& message, const FieldPath& way, CallNeeds& needs) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor* field = message.field(i);
    FieldPath path = way;
    path.push_back(field);
    const Meaning meaning = field->options().GetExtension(v1::means);
    if (meaning != v1::Access::MEANING_UNSPECIFIED) {
      needs.fields.emplace_back(meaning, path);
      needs.can_only_try |= meaning == v1::Access::VALIDATE_ONLY;
    }
    const bool is_one_message = field->message_type() != nullptr && !field->is_repeated();
    if (is_one_message && path.size() < kDeepest) AddFields(*field->message_type(), path, needs);
  }
}

bool IsOfType(const FieldDescriptor& field, Meaning meaning) {
  const bool is_flag = meaning == v1::Access::VALIDATE_ONLY || meaning == v1::Access::TAKE_OVER;
  return !field.is_repeated() && field.type() == (is_flag ? FieldDescriptor::TYPE_BOOL : FieldDescriptor::TYPE_STRING);
}

/// Whether exactly one field names the map, or several in branches of a oneof, so that at most one is set.
bool NamesOneMap(const CallNeeds& needs) {
  std::vector<const FieldPath*> paths;
  for (const auto& [meaning, path] : needs.fields) {
    if (meaning == v1::Access::MAP || meaning == v1::Access::MAP_ID) paths.push_back(&path);
  }
  const auto branch = [](const FieldPath* path) { return path->front()->real_containing_oneof(); };
  return paths.size() == 1 || (!paths.empty() && branch(paths[0]) != nullptr &&
                               std::all_of(paths.begin(), paths.end(),
                                           [&](const FieldPath* path) { return branch(path) == branch(paths[0]); }));
}

/// Checks the options of one rpc; returns what is wrong, or "".
std::string FaultOf(const CallNeeds& needs) {
  if (needs.need == v1::Access::NEED_UNSPECIFIED) return "does not say what it needs";
  for (const auto& [meaning, path] : needs.fields) {
    if (!IsOfType(*path.back(), meaning)) return path.back()->name() + " is not of the type of what it means";
  }
  if (needs.maps != v1::Access::MAPS_UNSPECIFIED) return {};
  return NamesOneMap(needs) ? "" : "names no map, or more than one, and does not say which maps it is about";
}

CallNeeds NeedsOf(const MethodDescriptor& method) {
  CallNeeds needs{.need = method.options().GetExtension(v1::needs),
                  .maps = method.options().GetExtension(v1::maps),
                  .is_stream = method.client_streaming() || method.server_streaming(),
                  .comes_in_messages = method.client_streaming()};
  AddFields(*method.input_type(), {}, needs);
  return needs;
}

/// The rpcs of gRPC itself: we cannot annotate their protos.
std::vector<std::pair<std::string, CallNeeds>> OfGrpc() {
  const CallNeeds read{.need = v1::Access::READ, .maps = v1::Access::NONE, .is_stream = true};
  return {{"/grpc.reflection.v1.ServerReflection/ServerReflectionInfo", read},
          {"/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", read},
          {"/grpc.health.v1.Health/Watch", read},
          {"/grpc.health.v1.Health/Check", {.need = v1::Access::READ, .maps = v1::Access::NONE, .is_public = true}}};
}

/// That the linker keeps every service, and that all of a package are found: a file that is not here would not be.
std::array<const FileDescriptor*, 9> Files() {
  return {v1::GetServerStatusRequest::descriptor()->file(), v1::WhoAmIRequest::descriptor()->file(),
          v1::ApplyEditsRequest::descriptor()->file(),      v1::GetMapRequest::descriptor()->file(),
          v1::IntegrateFramesRequest::descriptor()->file(), v1::QueryPointsRequest::descriptor()->file(),
          v1::GetSubmapRequest::descriptor()->file(),       v1::WatchMapRequest::descriptor()->file(),
          v1::GetFleetRequest::descriptor()->file()};
}

}  // namespace

std::string PathOf(const MethodDescriptor& method) { return "/" + method.service()->full_name() + "/" + method.name(); }

Result<CallTable> CallTable::Make(const std::vector<const ServiceDescriptor*>& services) {
  CallTable table;
  Status bad = FailedPrecondition("rpcs do not say who may call them");
  for (const ServiceDescriptor* service : services) {
    for (int i = 0; i < service->method_count(); ++i) {
      CallNeeds needs = NeedsOf(*service->method(i));
      const std::string path = PathOf(*service->method(i)), fault = FaultOf(needs);
      if (!fault.empty()) bad.AddViolation(path, fault);
      table.calls_.emplace(path, std::move(needs));
    }
  }
  if (!bad.violations().empty()) return bad;
  for (auto& [path, needs] : OfGrpc()) table.calls_.emplace(path, needs);
  return table;
}

Result<CallTable> CallTable::OfLinkedServices() {
  std::vector<const ServiceDescriptor*> services;
  for (const FileDescriptor* file : Files()) {
    for (int i = 0; i < file->service_count(); ++i) services.push_back(file->service(i));
  }
  return Make(services);
}

const CallNeeds* CallTable::Find(std::string_view path) const {
  const auto found = calls_.find(path);
  return found == calls_.end() ? nullptr : &found->second;
}

}  // namespace dhpmap::auth
