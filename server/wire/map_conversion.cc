// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/map_conversion.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>
#include <google/protobuf/util/time_util.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proto/types/label_conversion.h"
#include "proto/types/resource_names.h"
#include "server/app/states/etag.h"

namespace dhpmap {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// From the message MapConfig to a field of it or of a message in it: the fields on the way, that one last.
using FieldPath = std::vector<const FieldDescriptor*>;

/// Of a dotted key.
FieldPath FindPath(std::string_view key) {
  FieldPath path;
  const auto* type = v1::MapConfig::descriptor();
  while (true) {
    const std::size_t dot = key.find('.');
    path.push_back(type->FindFieldByName(std::string(key.substr(0, dot))));
    GOOGLE_CHECK(path.back() != nullptr) << "proto MapConfig lacks " << key;
    if (dot == std::string_view::npos) return path;
    type = path.back()->message_type();
    key.remove_prefix(dot + 1);
  }
}

/// Of each key, in the order of VisitFields. Looked up once: a page of maps has some thousand of them.
const std::vector<FieldPath>& ConfigPaths() {
  static const std::vector<FieldPath> paths = [] {
    std::vector<FieldPath> found;
    const MapConfig config;
    VisitFields(config, [&found](const char* key, const auto&, double, double, const char*) {
      found.push_back(FindPath(key));
    });
    return found;
  }();
  return paths;
}

/// The message that contains the field, and the field. Writing creates the messages on the way.
template <typename AnyMessage>
std::pair<AnyMessage*, const FieldDescriptor*> Locate(AnyMessage& root, const FieldPath& path) {
  AnyMessage* message = &root;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if constexpr (std::is_const_v<AnyMessage>) message = &message->GetReflection()->GetMessage(*message, path[i]);
    else message = message->GetReflection()->MutableMessage(message, path[i]);
  }
  return {message, path.back()};
}

void Read(const Message& message, const FieldDescriptor* field, double& value, Status&) {
  value = message.GetReflection()->GetDouble(message, field);
}
void Read(const Message& message, const FieldDescriptor* field, int& value, Status&) {
  value = message.GetReflection()->GetInt32(message, field);
}
void Read(const Message& message, const FieldDescriptor* field, bool& value, Status&) {
  value = message.GetReflection()->GetBool(message, field);
}
void Read(const Message& message, const FieldDescriptor* field, Weighting& value, Status& bad) {
  const int number = message.GetReflection()->GetEnumValue(message, field);
  if (number == v1::IntegrationConfig::WEIGHTING_UNSPECIFIED) return;
  for (const Weighting known :
       {Weighting::kConstant, Weighting::kInverseDepthSquared, Weighting::kInverseRangeSquared}) {
    const auto* name = field->enum_type()->FindValueByName(std::string(WeightingName(known)));
    if (name != nullptr && name->number() == number) {
      value = known;
      return;
    }
  }
  bad.AddViolation("config.integration." + field->name(), std::to_string(number) + " is not a known value");
}

void Write(Message& message, const FieldDescriptor* field, double value) {
  message.GetReflection()->SetDouble(&message, field, value);
}
void Write(Message& message, const FieldDescriptor* field, int value) {
  message.GetReflection()->SetInt32(&message, field, value);
}
void Write(Message& message, const FieldDescriptor* field, bool value) {
  message.GetReflection()->SetBool(&message, field, value);
}
void Write(Message& message, const FieldDescriptor* field, Weighting value) {
  const auto* name = field->enum_type()->FindValueByName(std::string(WeightingName(value)));
  GOOGLE_CHECK(name != nullptr) << "proto Weighting lacks " << WeightingName(value);
  message.GetReflection()->SetEnum(&message, field, name);
}

void CollectBelow(const Status& status, const std::string& prefix, Status& bad) {
  for (const FieldViolation& violation : status.violations()) {
    bad.AddViolation(prefix + violation.field, violation.description);
  }
}

v1::VerifyMapResponse::Fault::Kind KindOf(MapFault::Kind kind) {
  switch (kind) {
    case MapFault::Kind::kRow: return v1::VerifyMapResponse::Fault::ROW;
    case MapFault::Kind::kBlob: return v1::VerifyMapResponse::Fault::BLOB;
    case MapFault::Kind::kCount: return v1::VerifyMapResponse::Fault::COUNT;
    case MapFault::Kind::kBounds: return v1::VerifyMapResponse::Fault::BOUNDS;
    case MapFault::Kind::kReference: return v1::VerifyMapResponse::Fault::REFERENCE;
  }
  return v1::VerifyMapResponse::Fault::KIND_UNSPECIFIED;
}

}  // namespace

Status MergeConfig(const v1::MapConfig& proto, MapConfig& config) {
  Status bad = InvalidArgument("the map config is not usable").WithReason("BAD_CONFIG");
  const Message& root = proto;
  VisitFields(config, [&root, &bad, path = ConfigPaths().begin()](const char*, auto& value, double, double,
                                                                  const char*) mutable {
    const auto [message, field] = Locate(root, *path++);
    if (message->GetReflection()->HasField(*message, field)) Read(*message, field, value, bad);
  });
  const auto [message, carving] = Locate(root, FindPath("integration.carving"));
  if (message->GetReflection()->GetBool(*message, carving)) {
    bad.AddViolation("config.integration.carving", "is retired: it can only be false");
  }
  return bad.violations().empty() ? Status::Ok() : bad;
}

v1::MapConfig ToProto(const MapConfig& config) {
  v1::MapConfig proto;
  Message& root = proto;
  VisitFields(config, [&root, path = ConfigPaths().begin()](const char*, const auto& value, double, double,
                                                            const char*) mutable {
    const auto [message, field] = Locate(root, *path++);
    Write(*message, field, value);
  });
  return proto;
}

ImportRequest ImportRequestFromProto(const v1::ImportMapRequest& request) {
  return {.name = request.map_id(), .total_bytes = request.total_bytes()};
}

v1::Map ToProto(const MapSummary& map) {
  v1::Map proto;
  proto.set_name(MapResourceName(map.info.name));
  proto.set_display_name(map.info.display_name);
  *proto.mutable_config() = ToProto(map.info.config);
  for (const LabelClass& c : map.info.label_set->classes()) *proto.add_label_classes() = ToProto(c);
  proto.set_revision(map.info.revision);
  proto.set_num_frames(map.info.num_frames);
  proto.set_num_submaps(map.num_submaps);
  *proto.mutable_create_time() = google::protobuf::util::TimeUtil::NanosecondsToTimestamp(map.info.create_time_ns);
  *proto.mutable_update_time() = google::protobuf::util::TimeUtil::NanosecondsToTimestamp(map.info.update_time_ns);
  proto.set_history_id(HistoryText(map.info.history_id));
  proto.set_etag(EtagOf(map.info));
  return proto;
}

v1::MapRevision RevisionToProto(const MapInfo& map) {
  v1::MapRevision proto;
  proto.set_revision(map.revision);
  *proto.mutable_update_time() = google::protobuf::util::TimeUtil::NanosecondsToTimestamp(map.update_time_ns);
  return proto;
}

Result<MapPatch> PatchFromProto(const v1::UpdateMapRequest& request) {
  const auto& paths = request.update_mask().paths();
  Status bad = InvalidArgument("the update mask is not usable").WithReason("BAD_UPDATE_MASK");
  bool renames = paths.empty() && !request.map().display_name().empty();
  for (const std::string& path : paths) {
    if (path == "display_name" || path == "*") renames = true;
    else if (path != "name" && path != "etag") bad.AddViolation("update_mask", "'" + path + "' cannot be changed");
  }
  if (!bad.violations().empty()) return bad;
  return renames ? MapPatch{.display_name = request.map().display_name()} : MapPatch{};
}

Result<MapInfo> InfoFromProto(const v1::CreateMapRequest& request, const MapConfig& default_config) {
  Status bad = InvalidArgument("the map cannot be made like this").WithReason("BAD_MAP");
  MapInfo info;
  info.name = request.map_id();
  info.display_name = request.display_name();
  info.config = default_config;
  const Status name = ValidateMapName(info.name);
  for (const FieldViolation& violation : name.violations()) bad.AddViolation("map_id", violation.description);
  if (info.display_name.size() > kMaxDisplayNameBytes) {
    bad.AddViolation("display_name", "is longer than " + std::to_string(kMaxDisplayNameBytes) + " bytes");
  }
  if (!request.preset().empty()) CollectBelow(ApplyPreset(request.preset(), info.config), "", bad);
  CollectBelow(MergeConfig(request.config(), info.config), "", bad);
  CollectBelow(info.config.Validate(), "config.", bad);
  auto label_set = LabelSetFromProto(request.label_classes());
  CollectBelow(label_set.status(), "", bad);
  if (!bad.violations().empty()) return bad;
  if (!label_set.ok()) return label_set.status();
  info.label_set = std::make_shared<const LabelSet>(std::move(*label_set));
  return info;
}

v1::GetMapStatsResponse ToProto(const MapReport& report) {
  v1::GetMapStatsResponse proto;
  const MapStats& stats = report.stats;
  const std::int64_t num_allocated = stats.num_tsdf_blocks * kBlockVoxels;
  proto.set_revision(report.revision);
  proto.set_num_frames(report.num_frames);
  proto.set_num_things(stats.num_things);
  proto.set_num_stuff(stats.num_stuff);
  proto.set_num_active(stats.num_active);
  proto.set_num_tsdf_blocks(stats.num_tsdf_blocks);
  proto.set_num_label_blocks(stats.num_label_blocks);
  proto.set_num_allocated_voxels(num_allocated);
  proto.set_num_observed_voxels(stats.num_observed_voxels);
  proto.set_memory_bytes(stats.memory_bytes);
  proto.set_disk_bytes(report.disk_bytes);
  if (num_allocated > 0) {
    proto.set_memory_bytes_per_allocated_voxel(static_cast<double>(stats.memory_bytes) /
                                               static_cast<double>(num_allocated));
  }
  return proto;
}

v1::VerifyMapResponse ToProto(const VerifyReport& report) {
  v1::VerifyMapResponse proto;
  proto.set_revision(report.revision);
  proto.set_num_submaps(report.num_submaps);
  proto.set_num_tiles(report.num_tiles);
  proto.set_num_blocks(report.num_blocks);
  proto.set_blob_bytes(report.blob_bytes);
  proto.set_num_shared_voxels(report.num_shared_voxels);
  proto.set_num_faults(report.num_faults);
  proto.set_repaired(report.is_repaired);
  for (const SharedPlace& place : report.shared_places) {
    v1::VerifyMapResponse::SharedBlock& added = *proto.add_shared_blocks();
    added.set_first_instance_id(place.first.value);
    added.set_second_instance_id(place.second.value);
    added.set_block_x(place.block.x);
    added.set_block_y(place.block.y);
    added.set_block_z(place.block.z);
    added.set_num_voxels(place.num_voxels);
  }
  for (const MapFault& fault : report.faults) {
    v1::VerifyMapResponse::Fault& added = *proto.add_faults();
    added.set_kind(KindOf(fault.kind));
    added.set_location(fault.place);
    added.set_description(fault.what);
  }
  return proto;
}

}  // namespace dhpmap
