// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/watch_conversion.h"

#include <google/protobuf/util/time_util.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "proto/types/label_conversion.h"
#include "proto/types/pose_conversion.h"
#include "proto/types/resource_names.h"
#include "server/wire/edit_conversion.h"
#include "server/wire/submap_conversion.h"

namespace dhpmap {
namespace {

constexpr double kDefaultProgress_s = 15, kLeastProgress_s = 0.5, kMostProgress_s = 300;

Status BadPosition(std::string field, std::string why) {
  return InvalidArgument("the position to watch from is not usable")
      .WithReason("BAD_POSITION")
      .WithViolation(std::move(field), std::move(why));
}

std::optional<std::uint64_t> HistoryFromText(const std::string& text) {
  std::uint64_t history_id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), history_id, 16);
  const bool is_good = text.size() == 16 && error == std::errc() && end == text.data() + text.size();
  return is_good ? std::optional(history_id) : std::nullopt;
}

v1::ExportProgress::Kind KindOf(ExportKind kind) {
  switch (kind) {
    case ExportKind::kMapFile: return v1::ExportProgress::MAP_FILE;
    case ExportKind::kBackup: return v1::ExportProgress::BACKUP;
  }
  return v1::ExportProgress::KIND_UNSPECIFIED;
}

v1::ExportProgress::Stage StageOf(ExportStage stage) {
  switch (stage) {
    case ExportStage::kPreparing: return v1::ExportProgress::PREPARING;
    case ExportStage::kSending: return v1::ExportProgress::SENDING;
    case ExportStage::kSent: return v1::ExportProgress::SENT;
    case ExportStage::kLeft: return v1::ExportProgress::CANCELLED;
    case ExportStage::kFailed: return v1::ExportProgress::FAILED;
  }
  return v1::ExportProgress::STAGE_UNSPECIFIED;
}

v1::SubmapEvent::Kind KindOf(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::kCreated: return v1::SubmapEvent::CREATED;
    case ChangeKind::kChanged: return v1::SubmapEvent::CHANGED;
    case ChangeKind::kRemoved: return v1::SubmapEvent::REMOVED;
    case ChangeKind::kMerged: return v1::SubmapEvent::MERGED;
  }
  return v1::SubmapEvent::KIND_UNSPECIFIED;
}

constexpr std::pair<SubmapPart, v1::SubmapEvent::Part> kParts[] = {
    {SubmapPart::kPose, v1::SubmapEvent::POSE},
    {SubmapPart::kLabels, v1::SubmapEvent::LABELS},
    {SubmapPart::kName, v1::SubmapEvent::NAME},
    {SubmapPart::kActivity, v1::SubmapEvent::ACTIVITY},
    {SubmapPart::kGeometry, v1::SubmapEvent::GEOMETRY},
    {SubmapPart::kVoxelLabels, v1::SubmapEvent::VOXEL_LABELS},
    {SubmapPart::kObservation, v1::SubmapEvent::OBSERVATION},
    {SubmapPart::kLock, v1::SubmapEvent::LOCK},
};

constexpr ChangeKind kKinds[] = {ChangeKind::kCreated, ChangeKind::kChanged, ChangeKind::kRemoved, ChangeKind::kMerged};

/// A box in the map frame around the tiles of a submap's grid.
v1::AxisAlignedBox BoxInMap(const TileBox& box, const SubmapInfo& info) {
  const double side_m = kTileSide * kBlockSide * info.voxel_size_m;
  const Eigen::Vector3d low(box.low.x, box.low.y, box.low.z),
      high(box.high.x + 1.0, box.high.y + 1.0, box.high.z + 1.0);
  const Eigen::Vector3d half_m = (high - low) * (side_m / 2);
  const Eigen::Vector3d center_m = info.T_map_submap * Eigen::Vector3d((low + high) * (side_m / 2));
  const Eigen::Vector3d reach_m = info.T_map_submap.linear().cwiseAbs() * half_m;
  v1::AxisAlignedBox proto;
  *proto.mutable_min_m() = ToProto(Eigen::Vector3d(center_m - reach_m));
  *proto.mutable_max_m() = ToProto(Eigen::Vector3d(center_m + reach_m));
  return proto;
}

v1::AxisAlignedBox BoxToProto(const Eigen::AlignedBox3d& box) {
  v1::AxisAlignedBox proto;
  *proto.mutable_min_m() = ToProto(Eigen::Vector3d(box.min()));
  *proto.mutable_max_m() = ToProto(Eigen::Vector3d(box.max()));
  return proto;
}

/// The remaining properties of a removed submap.
v1::Submap ToProtoOfGone(const SubmapInfo& info, const MapInfo& map) {
  v1::Submap proto;
  proto.set_name(SubmapResourceName(map.name, info.id));
  proto.set_instance_id(info.id.value);
  proto.set_kind(ToProto(info.panoptic));
  if (info.panoptic == Panoptic::kUnknown) return proto;
  proto.set_class_id(info.class_id.value);
  if (const LabelClass* c = map.label_set->Find(info.class_id)) proto.set_class_name(c->name);
  return proto;
}

}  // namespace

Result<WatchStart> WatchStartFromProto(const v1::WatchMapRequest& request) {
  if (!request.resume_after().empty()) {
    const auto position = ParsePosition(request.resume_after());
    if (!position) return BadPosition("resume_after", "must be the position of a message of WatchMap");
    return WatchStart{.revision = position->revision + 1, .history_id = position->history_id};
  }
  WatchStart start{.revision = request.start_revision(), .history_id = std::nullopt};
  if (start.revision < 0) return BadPosition("start_revision", "must be 0 or more");
  if (request.history_id().empty()) return start;
  start.history_id = HistoryFromText(request.history_id());
  if (!start.history_id) return BadPosition("history_id", "must be the history_id of a map");
  return start;
}

Result<ChangeFilter> ChangeFilterFromProto(const v1::WatchFilter& filter, const LabelSet& label_set) {
  Status bad = InvalidArgument("the filter is not usable").WithReason("BAD_FILTER");
  v1::ListSubmapsRequest place;
  *place.mutable_class_ids() = filter.class_ids();
  *place.mutable_class_names() = filter.class_names();
  if (filter.has_region()) *place.mutable_region() = filter.region();
  const auto as_list = FilterFromProto(place, label_set);
  for (const FieldViolation& violation : as_list.status().violations()) {
    bad.AddViolation("filter." + violation.field, violation.description);
  }
  ChangeFilter wanted;
  if (as_list.ok()) wanted.place = *as_list;
  for (const std::int64_t id : filter.instance_ids()) {
    if (id >= 0 && id <= std::numeric_limits<std::uint32_t>::max())
      wanted.submaps.emplace(static_cast<std::uint32_t>(id));
    else bad.AddViolation("filter.instance_ids", std::to_string(id) + " is no instance id");
  }
  for (const int value : filter.kinds()) {
    const auto* kind =
        std::find_if(std::begin(kKinds), std::end(kKinds), [value](ChangeKind k) { return KindOf(k) == value; });
    if (kind != std::end(kKinds)) wanted.kinds.insert(*kind);
    else bad.AddViolation("filter.kinds", std::to_string(value) + " is not a known value");
  }
  for (const int value : filter.parts()) {
    const auto* part =
        std::find_if(std::begin(kParts), std::end(kParts), [value](const auto& p) { return p.second == value; });
    if (part != std::end(kParts)) wanted.parts.Add(part->first);
    else bad.AddViolation("filter.parts", std::to_string(value) + " is not a known value");
  }
  if (!bad.violations().empty()) return bad;
  return wanted;
}

void SetExports(const ExportNews& news, v1::WatchProgress& progress) {
  for (const ExportProgress& told : news.exports) {
    v1::ExportProgress& out = *progress.add_exports();
    out.set_id(told.id);
    out.set_kind(KindOf(told.kind));
    out.set_stage(StageOf(told.stage));
    out.set_done_bytes(told.done_bytes);
    out.set_total_bytes(told.total_bytes);
    out.set_elapsed_s(told.elapsed_s);
  }
  progress.set_num_exports(static_cast<std::int32_t>(news.num_running));
}

Result<double> ProgressSecondsFromProto(const v1::WatchMapRequest& request) {
  if (request.progress_interval_s() == 0) return kDefaultProgress_s;
  if (request.progress_interval_s() >= kLeastProgress_s && request.progress_interval_s() <= kMostProgress_s)
    return request.progress_interval_s();
  return InvalidArgument("progress_interval_s is not usable")
      .WithViolation("progress_interval_s", "must be 0.5 to 300, or 0 for 15");
}

v1::SubmapEvent ToProto(const SubmapEvent& event, const MapInfo& map) {
  v1::SubmapEvent proto;
  proto.set_kind(KindOf(event.kind));
  if (event.kind == ChangeKind::kRemoved || event.kind == ChangeKind::kMerged) {
    *proto.mutable_submap() = ToProtoOfGone(event.info, map);
    if (event.kind == ChangeKind::kMerged) proto.set_merged_into(SubmapResourceName(map.name, event.into));
    return proto;
  }
  *proto.mutable_submap() = ToProto(event.info, event.observed, event.num_blocks, map);
  for (const auto& [part, value] : kParts) {
    if (event.parts.Has(part)) proto.add_parts(value);
  }
  for (const TileBox& box : event.tiles) *proto.add_boxes() = BoxInMap(box, event.info);
  if (event.pose_boxes) {
    *proto.mutable_previous_box() = BoxToProto(event.pose_boxes->before_m);
    *proto.mutable_current_box() = BoxToProto(event.pose_boxes->after_m);
  }
  return proto;
}

v1::RegionEvent ToProto(const RegionEvent& event, const MapInfo& map) {
  v1::RegionEvent proto;
  switch (event.kind) {
    case RegionEventKind::kCleared: proto.set_kind(v1::RegionEvent::CLEARED); break;
    case RegionEventKind::kKeptClear: proto.set_kind(v1::RegionEvent::IGNORED); break;
    case RegionEventKind::kLifted: proto.set_kind(v1::RegionEvent::UNIGNORED); break;
  }
  proto.set_name(event.name);
  const v1::IgnoredRegion region = ToProto(KeptClearRegion{.name = {}, .region = event.region});
  if (region.has_box()) *proto.mutable_box() = region.box();
  else *proto.mutable_sphere() = region.sphere();
  if (event.submap != kUnknownSubmap) proto.set_submap(SubmapResourceName(map.name, event.submap));
  for (const ClassId id : event.classes) {
    if (const LabelClass* c = map.label_set->Find(id)) proto.add_class_names(c->name);
  }
  proto.set_num_voxels(event.num_voxels);
  return proto;
}

ChangeMessages::ChangeMessages(std::shared_ptr<const MapChange> change, const ChangeFilter& filter)
    : change_(std::move(change)) {
  SkipToPassing(filter);
  has_next_ = change_->display_name.has_value() || IsBeforeEnd();
}

bool ChangeMessages::IsBeforeEnd() const {
  return next_region_ < change_->regions.size() || next_ < change_->submaps.size();
}

void ChangeMessages::SkipToPassing(const ChangeFilter& filter) {
  while (next_region_ < change_->regions.size() && !filter.Passes(change_->regions[next_region_])) ++next_region_;
  while (next_ < change_->submaps.size() && !filter.Passes(change_->submaps[next_])) ++next_;
}

std::size_t ChangeMessages::AddNext(const MapInfo& map, v1::MapChange& message) {
  if (next_region_ < change_->regions.size()) {
    *message.add_regions() = ToProto(change_->regions[next_region_++], map);
    return message.regions(message.regions_size() - 1).ByteSizeLong();
  }
  *message.add_submaps() = ToProto(change_->submaps[next_++], map);
  return message.submaps(message.submaps_size() - 1).ByteSizeLong();
}

void ChangeMessages::Next(const ChangeFilter& filter, const MapInfo& map, v1::MapChange& message) {
  message.set_first_revision(change_->first_revision);
  message.set_last_revision(change_->last_revision);
  *message.mutable_commit_time() = google::protobuf::util::TimeUtil::NanosecondsToTimestamp(change_->time_ns);
  if (!has_begun_ && change_->display_name) message.set_display_name(*change_->display_name);
  for (std::size_t num_bytes = 0; IsBeforeEnd() && num_bytes < kMessage_bytes;) {
    num_bytes += AddNext(map, message);
    SkipToPassing(filter);
  }
  has_next_ = IsBeforeEnd();
  has_begun_ = true;
  message.set_last_message(!has_next_);
}

}  // namespace dhpmap
