// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/change_codec.h"

#include <string>
#include <utility>

#include "storage/codec/envelope.h"
#include "storage/codec/field_coder.h"

namespace dhpmap {
namespace {

/// Minimum size of an event: the doubles of its row and sphere.
constexpr std::size_t kLeastEvent_bytes = kLeastInfo_bytes + sizeof(double) * 4;
/// Minimum size: the doubles of a sphere.
constexpr std::size_t kLeastRegionEvent_bytes = sizeof(double) * 4;

template <typename Coder, typename Box>
void DoBox(Coder& coder, Box& box) {
  for (auto* corner : {&box.low, &box.high}) {
    coder.Do(corner->x);
    coder.Do(corner->y);
    coder.Do(corner->z);
  }
}

/// Codes a box in metres.
template <typename Coder, typename Box>
void DoExtents(Coder& coder, Box& box) {
  for (auto* corner : {&box.min(), &box.max()}) {
    for (int axis = 0; axis < 3; ++axis) coder.Do((*corner)[axis]);
  }
}

template <typename Coder, typename Event>
void DoEvent(Coder& coder, BlobKind kind, Event& event) {
  coder.Do(event.kind);
  std::uint32_t bits = event.parts.bits();
  coder.Do(bits);
  if constexpr (!std::is_const_v<Event>) event.parts = SubmapParts::FromBits(bits);
  DoInfo(coder, event.info);
  DoSphere(coder, event.observed);
  coder.Do(event.num_blocks);
  coder.DoSize(event.tiles, 6);
  for (auto& box : event.tiles) DoBox(coder, box);
  coder.Do(event.into);
  DoOptional(coder, event.before, [&coder](auto& before) {
    coder.Do(before.panoptic);
    coder.Do(before.class_id);
    DoSphere(coder, before.sphere);
  });
  if (kind >= BlobKind::kChangeV2) DoFields(coder, 5, 5, event.info);  // locked or not
  if (kind >= BlobKind::kChangeV4) {
    DoOptional(coder, event.pose_boxes, [&coder](auto& boxes) {
      DoExtents(coder, boxes.before_m);
      DoExtents(coder, boxes.after_m);
    });
  }
}

template <typename Coder, typename Event>
void DoRegionEvent(Coder& coder, Event& event) {
  coder.Do(event.kind);
  DoRegion(coder, event.region);
  coder.Do(event.name);
  coder.Do(event.submap);
  coder.DoSize(event.classes, 1);
  for (auto& class_id : event.classes) coder.Do(class_id);
  coder.Do(event.num_voxels);
}

template <typename Coder, typename Change>
void DoChange(Coder& coder, BlobKind kind, Change& change) {
  DoOptional(coder, change.display_name, [&coder](auto& name) { coder.Do(name); });
  coder.DoSize(change.submaps, kLeastEvent_bytes);
  for (auto& event : change.submaps) DoEvent(coder, kind, event);
  if (kind < BlobKind::kChangeV3) return;
  coder.DoSize(change.regions, kLeastRegionEvent_bytes);
  for (auto& event : change.regions) DoRegionEvent(coder, event);
}

/// The kind of a blob; unknown kinds are treated as the newest, which refuses them.
BlobKind KindOfChange(ByteView blob) {
  for (const BlobKind older : {BlobKind::kChangeV1, BlobKind::kChangeV2, BlobKind::kChangeV3}) {
    if (KindByte(blob) == static_cast<std::uint8_t>(older)) return older;
  }
  return BlobKind::kChangeV4;
}

/// The oldest possible kind for a change, so that older versions can read it.
BlobKind KindFor(const MapChange& change) {
  for (const SubmapEvent& event : change.submaps) {
    if (event.pose_boxes) return BlobKind::kChangeV4;
  }
  return change.regions.empty() ? BlobKind::kChangeV2 : BlobKind::kChangeV3;
}

}  // namespace

Bytes EncodeChange(const MapChange& change) {
  Payload payload;
  FieldWriter writer(payload.packable);
  const BlobKind kind = KindFor(change);
  DoChange(writer, kind, change);
  return Seal(kind, SealIndexOf(change.last_revision), payload);
}

Status DecodeChange(ByteView blob, MapChange& change) {
  Payload payload;
  const BlobKind kind = KindOfChange(blob);
  DHPMAP_RETURN_IF_ERROR(Unseal(kind, SealIndexOf(change.last_revision), blob, payload));
  change.display_name.reset();
  change.submaps.clear();
  change.regions.clear();
  FieldReader reader(payload.packable);
  DoChange(reader, kind, change);
  if (!payload.plain.empty() || !reader.IsAtGoodEnd()) return DataLoss("has a wrong length");
  return Status::Ok();
}

}  // namespace dhpmap
