// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/edit_codec.h"

#include "storage/codec/envelope.h"
#include "storage/codec/field_coder.h"

namespace dhpmap {
namespace {

template <typename Coder, typename List>
void DoNumbers(Coder& coder, List& list) {
  coder.DoSize(list, 1);
  for (auto& number : list) coder.Do(number);
}

template <typename Coder, typename Summary>
void DoSummary(Coder& coder, BlobKind kind, Summary& summary) {
  coder.DoSize(summary.steps, 2);
  for (auto& step : summary.steps) {
    coder.Do(step.action);
    coder.Do(step.submap);
  }
  DoNumbers(coder, summary.targets);
  DoNumbers(coder, summary.changed);
  DoNumbers(coder, summary.created);
  DoNumbers(coder, summary.removed);
  coder.Do(summary.num_voxels);
  if (kind >= BlobKind::kEditSummaryV2) coder.Do(summary.restored_revision);
}

/// The length of a name, the kind, and a sphere.
constexpr std::size_t kLeastRegion_bytes = 2 + sizeof(double) * 4;

template <typename Coder, typename Row>
void DoRow(Coder& coder, BlobKind kind, Row& row) {
  DoOptional(coder, row, [&coder, kind](auto& state) {
    DoInfo(coder, state.info);
    if (kind >= BlobKind::kEditRowsV2) DoFields(coder, 4, 4, state.info);  // sightings
    if (kind >= BlobKind::kEditRowsV3) DoFields(coder, 5, 5, state.info);  // locked or not
    DoSphere(coder, state.sphere);
  });
}

template <typename Coder, typename Delta>
void DoRows(Coder& coder, BlobKind kind, Delta& delta) {
  coder.DoSize(delta.submaps, 3);
  for (auto& submap : delta.submaps) {
    coder.Do(submap.id);
    DoRow(coder, kind, submap.before);
    DoRow(coder, kind, submap.after);
  }
  for (auto* pairs : {&delta.pairs.before, &delta.pairs.after}) {
    coder.DoSize(*pairs, 4);
    for (auto& pair : *pairs) {
      coder.Do(pair.first);
      coder.Do(pair.second);
      coder.Do(pair.verdict);
      coder.Do(pair.evidence);
    }
  }
  for (auto* list : {&delta.merged.before, &delta.merged.after}) {
    coder.DoSize(*list, 2);
    for (auto& entry : *list) {
      coder.Do(entry.merged);
      coder.Do(entry.into);
    }
  }
  DoNumbers(coder, delta.display_name.before);
  DoNumbers(coder, delta.display_name.after);
  if (kind < BlobKind::kEditRowsV3) return;
  for (auto* regions : {&delta.kept_clear.before, &delta.kept_clear.after}) {
    coder.DoSize(*regions, kLeastRegion_bytes);
    for (auto& region : *regions) {
      coder.Do(region.name);
      DoRegion(coder, region.region);
    }
  }
}

/// The kind of a blob, if it is an older one.
BlobKind KindOfRows(ByteView blob) {
  for (const BlobKind older : {BlobKind::kEditRowsV1, BlobKind::kEditRowsV2}) {
    if (KindByte(blob) == static_cast<std::uint8_t>(older)) return older;
  }
  return BlobKind::kEditRowsV3;
}

}  // namespace

Bytes EncodeEditSummary(const EditEntry& entry) {
  Payload payload;
  FieldWriter writer(payload.packable);
  const bool goes_back = entry.summary.restored_revision != 0;
  const BlobKind kind = goes_back ? BlobKind::kEditSummaryV2 : BlobKind::kEditSummaryV1;
  DoSummary(writer, kind, entry.summary);
  return Seal(kind, SealIndexOf(entry.revision), payload);
}

Status DecodeEditSummary(ByteView blob, EditEntry& entry) {
  Payload payload;
  const BlobKind kind = KindByte(blob) == static_cast<std::uint8_t>(BlobKind::kEditSummaryV1)
                            ? BlobKind::kEditSummaryV1
                            : BlobKind::kEditSummaryV2;
  DHPMAP_RETURN_IF_ERROR(Unseal(kind, SealIndexOf(entry.revision), blob, payload));
  FieldReader reader(payload.packable);
  DoSummary(reader, kind, entry.summary);
  if (!payload.plain.empty() || !reader.IsAtGoodEnd()) return DataLoss("has a wrong length");
  return Status::Ok();
}

Bytes EncodeEditRows(const StateDelta& delta, std::int64_t revision) {
  Payload payload;
  FieldWriter writer(payload.packable);
  DoRows(writer, BlobKind::kEditRowsV3, delta);
  return Seal(BlobKind::kEditRowsV3, SealIndexOf(revision), payload);
}

Status DecodeEditRows(ByteView blob, std::int64_t revision, StateDelta& delta) {
  Payload payload;
  const BlobKind kind = KindOfRows(blob);
  DHPMAP_RETURN_IF_ERROR(Unseal(kind, SealIndexOf(revision), blob, payload));
  FieldReader reader(payload.packable);
  DoRows(reader, kind, delta);
  if (!payload.plain.empty() || !reader.IsAtGoodEnd()) return DataLoss("has a wrong length");
  if (delta.display_name.before.size() != delta.display_name.after.size()) return DataLoss("names one side only");
  return Status::Ok();
}

}  // namespace dhpmap
