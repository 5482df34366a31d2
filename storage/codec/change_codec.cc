// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/change_codec.h"

#include <string>
#include <utility>

#include "storage/codec/envelope.h"
#include "storage/codec/field_coder.h"

namespace dhpmap {
namespace {

/// Of the doubles of an event alone: a row's, and the sphere's.
constexpr std::size_t kLeastEvent_bytes = kLeastInfo_bytes + sizeof(double) * 4;

template <typename Coder, typename Box>
void DoBox(Coder& coder, Box& box) {
  for (auto* corner : {&box.low, &box.high}) {
    coder.Do(corner->x);
    coder.Do(corner->y);
    coder.Do(corner->z);
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
  if (kind >= BlobKind::kChangeV2) coder.Do(event.info.is_locked);
}

template <typename Coder, typename Change>
void DoChange(Coder& coder, BlobKind kind, Change& change) {
  DoOptional(coder, change.display_name, [&coder](auto& name) { coder.Do(name); });
  coder.DoSize(change.submaps, kLeastEvent_bytes);
  for (auto& event : change.submaps) DoEvent(coder, kind, event);
}

}  // namespace

Bytes EncodeChange(const MapChange& change) {
  Payload payload;
  FieldWriter writer(payload.packable);
  DoChange(writer, BlobKind::kChangeV2, change);
  return Seal(BlobKind::kChangeV2, SealIndexOf(change.last_revision), payload);
}

Status DecodeChange(ByteView blob, MapChange& change) {
  Payload payload;
  const bool is_older = KindByte(blob) == static_cast<std::uint8_t>(BlobKind::kChangeV1);
  const BlobKind kind = is_older ? BlobKind::kChangeV1 : BlobKind::kChangeV2;
  DHPMAP_RETURN_IF_ERROR(Unseal(kind, SealIndexOf(change.last_revision), blob, payload));
  change.display_name.reset();
  change.submaps.clear();
  FieldReader reader(payload.packable);
  DoChange(reader, kind, change);
  if (!payload.plain.empty() || !reader.IsAtGoodEnd()) return DataLoss("has a wrong length");
  return Status::Ok();
}

}  // namespace dhpmap
