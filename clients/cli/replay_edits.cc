// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/replay_edits.h"

#include <charconv>
#include <functional>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "clients/cpp/calls/error.h"

namespace dhpmap {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

/// Fields with names of maps, objects or edits in the editing requests.
bool NamesSomething(const FieldDescriptor& field) {
  static const std::set<std::string> names = {"map", "name", "submap", "merged_submaps", "support", "edit"};
  return field.cpp_type() == FieldDescriptor::CPPTYPE_STRING && names.contains(field.name());
}

bool IsOfItsTime(const FieldDescriptor& field) {
  static const std::set<std::string> names = {"etag", "expected_revision", "request_id"};
  return field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE && names.contains(field.name());
}

}  // namespace

/// Makes edits of one RPC; returns the answer's revision.
struct ReplayEdits::Method {
  std::function<client::Result<std::int64_t>(ReplayEdits&, const std::string& request)> make;
};

template <typename Request, typename Response, typename Stub>
ReplayEdits::Method ReplayEdits::MethodOf(grpc::Status (Stub::*call)(grpc::ClientContext*, const Request&, Response*)) {
  return {[call](ReplayEdits& self, const std::string& bytes) -> client::Result<std::int64_t> {
    Request request;
    if (!request.ParseFromString(bytes)) {
      return client::Error(client::StatusCode::kDataLoss, "a recorded edit is no request");
    }
    self.Translate(request);
    if constexpr (std::is_same_v<Request, v1::RestoreRevisionRequest>) {
      const std::int64_t here = self.RevisionHere(request.revision());
      if (here == 0) {
        return client::Error(client::StatusCode::kFailedPrecondition, "the record does not tell which state revision " +
                                                                          std::to_string(request.revision()) + " was");
      }
      request.set_revision(here);
    }
    const auto response = self.caller_->Call(call, request, 0, client::Again::kNo);
    if (!response.ok()) return response.status();
    return response->revision();
  }};
}

const std::map<std::string, ReplayEdits::Method>& ReplayEdits::Methods() {
  using Edits = v1::EditService::Stub;
  using Submaps = v1::SubmapService::Stub;
  static const std::map<std::string, Method> methods = {
      {"EditService/ApplyEdits", MethodOf(&Edits::ApplyEdits)},
      {"EditService/UndoEdits", MethodOf(&Edits::UndoEdits)},
      {"EditService/RedoEdits", MethodOf(&Edits::RedoEdits)},
      {"EditService/RestoreRevision", MethodOf(&Edits::RestoreRevision)},
      {"SubmapService/UpdateSubmap", MethodOf(&Submaps::UpdateSubmap)},
      {"SubmapService/CloneSubmap", MethodOf(&Submaps::CloneSubmap)},
      {"SubmapService/DeleteSubmap", MethodOf(&Submaps::DeleteSubmap)},
      {"SubmapService/UndeleteSubmap", MethodOf(&Submaps::UndeleteSubmap)},
      {"MapService/UpdateMap", MethodOf(&v1::MapService::Stub::UpdateMap)}};
  return methods;
}

ReplayEdits::ReplayEdits(std::shared_ptr<client::Caller> caller, std::string recorded_map, std::string map)
    : caller_(std::move(caller)), recorded_map_(std::move(recorded_map)), map_(std::move(map)) {}

bool ReplayEdits::Knows(const v1::RecordedEdit& edit) { return Methods().contains(edit.method()); }

client::Status ReplayEdits::Make(const v1::RecordedEdit& edit) {
  const auto revision = Methods().at(edit.method()).make(*this, edit.request());
  if (revision.ok()) revisions_[edit.revision()] = *revision;
  return revision.status();
}

client::Status ReplayEdits::KeepClear(const v1::RecordStart& start) {
  if (start.ignored_regions().empty()) return {};
  v1::ApplyEditsRequest request;
  request.set_map(map_);
  for (const v1::IgnoredRegion& region : start.ignored_regions()) {
    v1::IgnoreRegionEdit& keep = *request.add_edits()->mutable_ignore_region();
    keep.set_name(region.name());
    if (region.has_box()) *keep.mutable_box() = region.box();
    else *keep.mutable_sphere() = region.sphere();
  }
  return caller_->Call(&v1::EditService::Stub::ApplyEdits, request, 0, client::Again::kNo).status();
}

/// A record has only those revisions between frames that an edit made or met.
std::int64_t ReplayEdits::RevisionHere(std::int64_t recorded) const {
  const auto edit = revisions_.lower_bound(recorded);
  if (edit == revisions_.end()) return 0;
  if (edit->first == recorded) return edit->second;
  return edit->first == recorded + 1 ? edit->second - 1 : 0;
}

/// Replaces names of the recorded map by those of this one, and drops preconditions.
void ReplayEdits::Translate(Message& request) const {
  const Reflection& reflection = *request.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(request, &fields);
  for (const FieldDescriptor* field : fields) {
    const int num = field->is_repeated() ? reflection.FieldSize(request, field) : 1;
    if (IsOfItsTime(*field)) {
      reflection.ClearField(&request, field);
    } else if (NamesSomething(*field)) {
      for (int i = 0; field->is_repeated() && i < num; ++i) {
        reflection.SetRepeatedString(&request, field, i, Translated(reflection.GetRepeatedString(request, field, i)));
      }
      if (field->is_repeated()) continue;
      reflection.SetString(&request, field, Translated(reflection.GetString(request, field)));
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      for (int i = 0; i < num; ++i) {
        Translate(field->is_repeated() ? *reflection.MutableRepeatedMessage(&request, field, i)
                                       : *reflection.MutableMessage(&request, field));
      }
    }
  }
}

std::string ReplayEdits::Translated(const std::string& name) const {
  if (name == recorded_map_) return map_;
  if (!name.starts_with(recorded_map_ + "/")) return name;
  const std::string rest = name.substr(recorded_map_.size());
  constexpr std::string_view kEdits = "/edits/";
  if (!rest.starts_with(kEdits)) return map_ + rest;
  std::int64_t revision = 0;
  const auto [end, error] = std::from_chars(rest.data() + kEdits.size(), rest.data() + rest.size(), revision);
  const auto found = revisions_.find(revision);
  const bool is_known = error == std::errc() && end == rest.data() + rest.size() && found != revisions_.end();
  return map_ + (is_known ? std::string(kEdits) + std::to_string(found->second) : rest);
}

}  // namespace dhpmap
