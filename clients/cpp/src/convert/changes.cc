// SPDX-License-Identifier: BSD-3-Clause
#include "clients/cpp/src/convert/changes.h"

#include <optional>

#include "clients/cpp/src/convert/geometry.h"
#include "clients/cpp/src/convert/objects.h"

namespace dhpmap::client {
namespace {

Change::Kind KindOf(v1::SubmapEvent::Kind kind) {
  switch (kind) {
    case v1::SubmapEvent::CREATED: return Change::Kind::kCreated;
    case v1::SubmapEvent::REMOVED: return Change::Kind::kRemoved;
    case v1::SubmapEvent::MERGED: return Change::Kind::kMerged;
    default: return Change::Kind::kChanged;
  }
}

/// Empty for a part that only newer servers know.
std::optional<Change::Part> PartOf(int part) {
  switch (part) {
    case v1::SubmapEvent::POSE: return Change::Part::kPose;
    case v1::SubmapEvent::LABELS: return Change::Part::kLabels;
    case v1::SubmapEvent::NAME: return Change::Part::kName;
    case v1::SubmapEvent::ACTIVITY: return Change::Part::kActivity;
    case v1::SubmapEvent::GEOMETRY: return Change::Part::kGeometry;
    case v1::SubmapEvent::VOXEL_LABELS: return Change::Part::kVoxelLabels;
    case v1::SubmapEvent::OBSERVATION: return Change::Part::kObservation;
    case v1::SubmapEvent::LOCK: return Change::Part::kLock;
    default: return std::nullopt;
  }
}

}  // namespace

Change ChangeOf(const v1::SubmapEvent& event, std::int64_t revision) {
  Change change;
  change.kind = KindOf(event.kind());
  for (const int its : event.parts()) {
    if (const auto part = PartOf(its)) change.parts.push_back(*part);
  }
  change.object = FromProto(event.submap());
  change.revision = revision;
  if (!event.merged_into().empty()) change.merged_into = IdOfName(event.merged_into());
  for (const v1::AxisAlignedBox& box : event.boxes()) change.boxes.push_back(FromProto(box));
  return change;
}

}  // namespace dhpmap::client
