// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/label_codec.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "storage/codec/envelope.h"
#include "storage/codec/voxel_walk.h"

namespace dhpmap {
namespace {

// Payload, all in the packable part: of version 2, which a block has of which something is concluded, the mask of those
// voxels; then mask of the voxels with counts, planes of one byte a masked voxel, then, voxel by
// voxel, what the planes do not hold, as varints.
//   kForm: number of classes, plus kOtherInstances if the instances are not just "own, as often as all classes";
//          or kLong: the voxel is not in the planes.
//   kClass0/1: first class, as difference to the nearest voxel before it; kCount0/1: its count, likewise.
enum Plane { kForm, kClass0, kClass1, kCount0, kCount1, kNumPlanes };
constexpr std::uint8_t kLong = 0x7F;
constexpr std::uint8_t kOtherInstances = 0x80;
constexpr std::uint32_t kMaxInPlane = 0xFFFF;

using Planes = std::array<std::array<std::uint8_t, kBlockVoxels>, kNumPlanes>;

std::uint64_t Total(const std::vector<LabelCount>& counts) {
  std::uint64_t total = 0;
  for (const LabelCount& entry : counts) total += entry.count;
  return total;
}

bool IsOwnInstanceOnly(const LabelHistograms& voxel) {
  return voxel.instances.size() == 1 && voxel.instances[0].id == 0 && voxel.instances[0].count == Total(voxel.classes);
}

std::uint8_t FormOf(const LabelHistograms& voxel) {
  const auto& classes = voxel.classes;
  if (classes.empty() || classes.size() >= kLong || classes[0].id > kMaxInPlane || classes[0].count > kMaxInPlane) {
    return kLong;
  }
  return static_cast<std::uint8_t>(classes.size() | (IsOwnInstanceOnly(voxel) ? 0u : kOtherInstances));
}

/// Ids ascend, so each is written as what it adds to the one before.
void PutCounts(std::span<const LabelCount> counts, std::uint32_t id, ByteWriter& writer) {
  for (const LabelCount& entry : counts) {
    writer.PutVarint(entry.id - std::exchange(id, entry.id));
    writer.PutVarint(entry.count);
  }
}

/// Appends `num` entries; false if they cannot be right.
bool GetCounts(std::uint64_t num, std::uint64_t id, ByteReader& reader, std::vector<LabelCount>& counts) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
  if (num > reader.remaining()) return false;
  for (; num > 0; --num) {
    const std::uint64_t step = reader.GetVarint(), count = reader.GetVarint();
    if (!reader.ok() || step > kMax - id || count > kMax || (step == 0 && !counts.empty())) return false;
    id += step;
    counts.push_back({static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(count)});
  }
  return true;
}

void PutSized(const std::vector<LabelCount>& counts, ByteWriter& writer) {
  writer.PutVarint(counts.size());
  PutCounts(counts, 0, writer);
}

bool GetSized(ByteReader& reader, std::vector<LabelCount>& counts) {
  const std::uint64_t num = reader.GetVarint();
  return reader.ok() && GetCounts(num, 0, reader, counts);
}

std::uint16_t ZigZag16(std::int32_t value) {
  return static_cast<std::uint16_t>(ZigZag(static_cast<std::int16_t>(value)));
}

/// Reads voxels; where the whole block is inline and a voxel has one class, without building lists on the heap.
class HistogramReader {
 public:
  explicit HistogramReader(const LabelBlock& block) : block_(block), is_inline_(block.NumOverflowVoxels() == 0) {}

  const LabelHistograms& Read(int linear) {
    if (is_inline_) {
      const BestLabel best = block_.BestClass(linear);
      if (best.count == block_.NumObservations(linear)) {
        voxel_.classes.assign(1, {best.id, best.count});
        voxel_.instances.assign(1, {0, best.count});
        return voxel_;
      }
    }
    return voxel_ = block_.Get(linear);
  }

 private:
  const LabelBlock& block_;
  bool is_inline_;
  LabelHistograms voxel_;
};

/// Undoes the planes and the rest for one voxel; `voxel` is empty.
bool ReadVoxel(std::uint8_t form, LabelCount first, ByteReader& rest, LabelHistograms& voxel) {
  if (form == kLong) return GetSized(rest, voxel.classes) && GetSized(rest, voxel.instances);
  const int num_classes = form & 0x7F;
  if (num_classes == 0 || num_classes == kLong) return false;
  voxel.classes.push_back(first);
  if (!GetCounts(static_cast<std::uint64_t>(num_classes - 1), first.id, rest, voxel.classes)) return false;
  if (form & kOtherInstances) return GetSized(rest, voxel.instances);
  const std::uint64_t total = Total(voxel.classes);
  if (total > std::numeric_limits<std::uint32_t>::max()) return false;
  voxel.instances.push_back({0, static_cast<std::uint32_t>(total)});
  return true;
}

}  // namespace

Bytes EncodeLabelBlock(const LabelBlock& block, BlockIndex index) {
  VoxelBits mask{};
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (!block.IsEmpty(i)) MaskVoxel(mask, i);
  }
  const VoxelWalk walk(mask);
  const std::size_t count = walk.sites().size();

  Planes planes;
  VoxelWalk::Grid class_grid{}, count_grid{};
  Bytes rest;
  ByteWriter rest_writer(rest);
  HistogramReader reader(block);
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    const LabelHistograms& voxel = reader.Read(site.linear);
    const std::uint8_t form = FormOf(voxel);
    const LabelCount first = form == kLong ? LabelCount{} : voxel.classes[0];
    class_grid[site.cell] = static_cast<std::int32_t>(first.id);
    count_grid[site.cell] = static_cast<std::int32_t>(first.count);
    const std::uint16_t class_code = ZigZag16(class_grid[site.cell] - VoxelWalk::PredictNear(class_grid, site));
    const std::uint16_t count_code = ZigZag16(count_grid[site.cell] - VoxelWalk::PredictNear(count_grid, site));
    planes[kForm][n] = form;
    planes[kClass0][n] = static_cast<std::uint8_t>(class_code);
    planes[kClass1][n] = static_cast<std::uint8_t>(class_code >> 8);
    planes[kCount0][n] = static_cast<std::uint8_t>(count_code);
    planes[kCount1][n] = static_cast<std::uint8_t>(count_code >> 8);
    ++n;
    if (form == kLong) {
      PutSized(voxel.classes, rest_writer);
    } else {
      PutCounts(std::span(voxel.classes).subspan(1), first.id, rest_writer);
    }
    if (form & kOtherInstances || form == kLong) PutSized(voxel.instances, rest_writer);
  }

  const bool has_conclusions = !HasNone(block.concluded());
  Payload payload;
  payload.packable.reserve(2 * mask.size() + kNumPlanes * count + rest.size());
  ByteWriter writer(payload.packable);
  for (const std::uint64_t word : block.concluded()) {
    if (has_conclusions) writer.PutU64(word);
  }
  writer.PutBytes(mask);
  for (const auto& plane : planes) writer.PutBytes({plane.data(), count});
  writer.PutBytes(rest);
  return Seal(has_conclusions ? BlobKind::kLabelsV2 : BlobKind::kLabelsV1, index, payload);
}

Status DecodeLabelBlock(ByteView blob, BlockIndex index, LabelBlock& block) {
  thread_local Payload payload;
  const bool has_conclusions = !blob.empty() && blob[0] == static_cast<std::uint8_t>(BlobKind::kLabelsV2);
  DHPMAP_RETURN_IF_ERROR(Unseal(has_conclusions ? BlobKind::kLabelsV2 : BlobKind::kLabelsV1, index, blob, payload));
  ByteReader reader(payload.packable);
  VoxelMask concluded{};
  for (std::uint64_t& word : concluded) {
    if (has_conclusions) word = reader.GetU64();
  }
  VoxelBits mask{};
  reader.GetInto(mask);
  if (!reader.ok() || !payload.plain.empty()) return DataLoss("has a malformed header");
  const VoxelWalk walk(mask);
  std::array<ByteView, kNumPlanes> planes;
  for (ByteView& plane : planes) plane = reader.GetBytes(walk.sites().size());
  if (!reader.ok()) return DataLoss("is not as long as its voxels need");

  block = LabelBlock{};
  VoxelWalk::Grid class_grid{}, count_grid{};
  LabelHistograms voxel;
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    const auto read = [&](VoxelWalk::Grid& grid, Plane low) {
      const std::int32_t difference = UnZigZag(planes[low][n] | (planes[low + 1][n] << 8));
      grid[site.cell] = static_cast<std::uint16_t>(grid[site.near] + difference);
      return static_cast<std::uint32_t>(grid[site.cell]);
    };
    const LabelCount first{.id = read(class_grid, kClass0), .count = read(count_grid, kCount0)};
    voxel.classes.clear();
    voxel.instances.clear();
    if (!ReadVoxel(planes[kForm][n++], first, reader, voxel)) return DataLoss("holds a malformed voxel");
    if (!voxel.classes.empty() && voxel.classes.back().id >= kMaxInPlane) return DataLoss("holds a class that none is");
    block.Set(site.linear, voxel);
  }
  if (reader.remaining() != 0) return DataLoss("is longer than its voxels need");
  if (has_conclusions && HasNone(concluded)) return DataLoss("says that nothing is concluded");
  block.set_concluded(concluded);
  return Status::Ok();
}

}  // namespace dhpmap
