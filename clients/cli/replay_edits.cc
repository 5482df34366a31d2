// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cli/replay_edits.h"

#include <charconv>
#include <functional>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

/// Fields with names of maps, objects and edits, in all requests that edit.
bool NamesSomething(const FieldDescriptor& field) {
  static const std::set<std::string> names = {"map", "name", "submap", "merged_submaps", "support", "edit"};
  return field.cpp_type() == FieldDescriptor::CPPTYPE_STRING && names.contains(field.name());
}

bool IsOfItsTime(const FieldDescriptor& field) {
  static const std::set<std::string> names = {"etag", "expected_revision", "request_id"};
  return field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE && names.contains(field.name());
}

}  // namespace

/// How to make edits of one RPC; the answer's revision.
struct ReplayEdits::Method {
  std::function<grpc::Status(ReplayEdits&, const std::string& request, std::int64_t& revision)> make;
};

template <typename Request, typename Response, typename Stub>
ReplayEdits::Method ReplayEdits::MethodOf(std::unique_ptr<Stub> ReplayEdits::*stub,
                                          grpc::Status (Stub::*call)(grpc::ClientContext*, const Request&, Response*)) {
  return {[stub, call](ReplayEdits& self, const std::string& bytes, std::int64_t& revision) -> grpc::Status {
    Request request;
    if (!request.ParseFromString(bytes)) return {grpc::StatusCode::DATA_LOSS, "a recorded edit is no request"};
    self.Translate(request);
    if constexpr (std::is_same_v<Request, v1::RestoreRevisionRequest>) {
      const std::int64_t here = self.RevisionHere(request.revision());
      if (here == 0) {
        return {grpc::StatusCode::FAILED_PRECONDITION,
                "the record does not tell which state revision " + std::to_string(request.revision()) + " was"};
      }
      request.set_revision(here);
    }
    grpc::ClientContext context;
    Response response;
    const grpc::Status status = ((*(self.*stub)).*call)(&context, request, &response);
    revision = response.revision();
    return status;
  }};
}

const std::map<std::string, ReplayEdits::Method>& ReplayEdits::Methods() {
  using Edits = v1::EditService::Stub;
  using Submaps = v1::SubmapService::Stub;
  static const std::map<std::string, Method> methods = {
      {"EditService/ApplyEdits", MethodOf(&ReplayEdits::edits_, &Edits::ApplyEdits)},
      {"EditService/UndoEdits", MethodOf(&ReplayEdits::edits_, &Edits::UndoEdits)},
      {"EditService/RedoEdits", MethodOf(&ReplayEdits::edits_, &Edits::RedoEdits)},
      {"EditService/RestoreRevision", MethodOf(&ReplayEdits::edits_, &Edits::RestoreRevision)},
      {"SubmapService/UpdateSubmap", MethodOf(&ReplayEdits::submaps_, &Submaps::UpdateSubmap)},
      {"SubmapService/CloneSubmap", MethodOf(&ReplayEdits::submaps_, &Submaps::CloneSubmap)},
      {"SubmapService/DeleteSubmap", MethodOf(&ReplayEdits::submaps_, &Submaps::DeleteSubmap)},
      {"SubmapService/UndeleteSubmap", MethodOf(&ReplayEdits::submaps_, &Submaps::UndeleteSubmap)},
      {"MapService/UpdateMap", MethodOf(&ReplayEdits::maps_, &v1::MapService::Stub::UpdateMap)}};
  return methods;
}

ReplayEdits::ReplayEdits(const std::shared_ptr<grpc::Channel>& channel, std::string recorded_map, std::string map)
    : recorded_map_(std::move(recorded_map)),
      map_(std::move(map)),
      edits_(v1::EditService::NewStub(channel)),
      submaps_(v1::SubmapService::NewStub(channel)),
      maps_(v1::MapService::NewStub(channel)) {}

bool ReplayEdits::Knows(const v1::RecordedEdit& edit) { return Methods().contains(edit.method()); }

grpc::Status ReplayEdits::Make(const v1::RecordedEdit& edit) {
  std::int64_t revision = 0;
  grpc::Status status = Methods().at(edit.method()).make(*this, edit.request(), revision);
  if (status.ok()) revisions_[edit.revision()] = revision;
  return status;
}

grpc::Status ReplayEdits::KeepClear(const v1::RecordStart& start) {
  if (start.ignored_regions().empty()) return grpc::Status::OK;
  v1::ApplyEditsRequest request;
  request.set_map(map_);
  for (const v1::IgnoredRegion& region : start.ignored_regions()) {
    v1::IgnoreRegionEdit& keep = *request.add_edits()->mutable_ignore_region();
    keep.set_name(region.name());
    if (region.has_box()) *keep.mutable_box() = region.box();
    else *keep.mutable_sphere() = region.sphere();
  }
  grpc::ClientContext context;
  v1::ApplyEditsResponse response;
  return edits_->ApplyEdits(&context, request, &response);
}

/// Of the states between frames a record tells those that an edit has made, and those that one met.
std::int64_t ReplayEdits::RevisionHere(std::int64_t recorded) const {
  const auto edit = revisions_.lower_bound(recorded);
  if (edit == revisions_.end()) return 0;
  if (edit->first == recorded) return edit->second;
  return edit->first == recorded + 1 ? edit->second - 1 : 0;
}

/// Names of the recorded map become those of this one; what was asked of the state of then goes.
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
