// SPDX-License-Identifier: BSD-3-Clause
#include "storage/codec/label_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>
#include <vector>

#include "storage/codec/envelope.h"
#include "storage/codec/voxel_walk.h"

namespace dhpmap {
namespace {

// Payload, all in the packable part. For a tile first its cells, and the cells of blocks with conclusions. Then, for a
// block, the mask of the voxels with counts (for a tile, those of all blocks, followed by the masks of conclusions),
// planes with one byte for each masked voxel, and for each voxel as varints what the planes cannot hold.
//   kForm: number of classes, plus kOtherInstances if the instances are not just "own, as often as all classes";
//          or kLong: the voxel is not in the planes.
//   kClass0/1: first class, as difference to the nearest voxel before it; kCount0/1: its count, likewise.
enum LabelPlane { kForm, kClass0, kClass1, kCount0, kCount1, kNumLabelPlanes };
constexpr std::uint8_t kLong = 0x7F;
constexpr std::uint8_t kOtherInstances = 0x80;
constexpr std::uint32_t kMaxInPlane = 0xFFFF;

/// Planes and varints of a block, or of the blocks of a tile one after the other, while they are built.
struct Buffer {
  std::array<Bytes, kNumLabelPlanes> planes;
  Bytes rest;

  void Clear() {
    for (Bytes& plane : planes) plane.clear();
    rest.clear();
  }
};

std::uint32_t StoredId(std::uint32_t class_id) { return class_id; }
std::uint32_t StoredId(SeenInstance instance) { return instance.code(); }
void SetStoredId(std::uint32_t code, std::uint32_t& class_id) { class_id = code; }
void SetStoredId(std::uint32_t code, SeenInstance& instance) { instance = SeenInstance::FromCode(code); }

std::uint64_t Total(const std::vector<LabelCount>& counts) {
  std::uint64_t total = 0;
  for (const LabelCount& entry : counts) total += entry.count;
  return total;
}

bool IsOwnInstanceOnly(const LabelHistograms& voxel) {
  return voxel.instances.size() == 1 && voxel.instances[0].id.IsOwn() &&
         voxel.instances[0].count == Total(voxel.classes);
}

std::uint8_t FormOf(const LabelHistograms& voxel) {
  const auto& classes = voxel.classes;
  if (classes.empty() || classes.size() >= kLong || classes[0].id > kMaxInPlane || classes[0].count > kMaxInPlane) {
    return kLong;
  }
  return static_cast<std::uint8_t>(classes.size() | (IsOwnInstanceOnly(voxel) ? 0u : kOtherInstances));
}

/// Ids ascend, so differences are written.
template <typename Id>
void PutCounts(std::span<const SeenCount<Id>> counts, std::uint32_t id, ByteWriter& writer) {
  for (const SeenCount<Id>& entry : counts) {
    writer.PutVarint(StoredId(entry.id) - std::exchange(id, StoredId(entry.id)));
    writer.PutVarint(entry.count);
  }
}

/// Appends `num` entries; false if they are invalid.
template <typename Id>
bool GetCounts(std::uint64_t num, std::uint64_t id, ByteReader& reader, std::vector<SeenCount<Id>>& counts) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint32_t>::max();
  if (num > reader.remaining()) return false;
  for (; num > 0; --num) {
    const std::uint64_t step = reader.GetVarint(), count = reader.GetVarint();
    if (!reader.ok() || step > kMax - id || count > kMax || (step == 0 && !counts.empty())) return false;
    id += step;
    SeenCount<Id>& entry = counts.emplace_back();
    SetStoredId(static_cast<std::uint32_t>(id), entry.id);
    entry.count = static_cast<std::uint32_t>(count);
  }
  return true;
}

template <typename Id>
void PutSized(const std::vector<SeenCount<Id>>& counts, ByteWriter& writer) {
  writer.PutVarint(counts.size());
  PutCounts<Id>(counts, 0, writer);
}

template <typename Id>
bool GetSized(ByteReader& reader, std::vector<SeenCount<Id>>& counts) {
  const std::uint64_t num = reader.GetVarint();
  return reader.ok() && GetCounts(num, 0, reader, counts);
}

std::uint16_t ZigZag16(std::int32_t value) {
  return static_cast<std::uint16_t>(ZigZag(static_cast<std::int16_t>(value)));
}

/// Reads voxels; without heap lists for inline blocks and voxels with one class.
class HistogramReader {
 public:
  explicit HistogramReader(const LabelBlock& block) : block_(block), is_inline_(block.NumOverflowVoxels() == 0) {}

  const LabelHistograms& Read(int linear) {
    if (is_inline_) {
      const BestLabel best = block_.BestClass(linear);
      if (best.count == block_.NumObservations(linear)) {
        voxel_.classes.assign(1, {best.id, best.count});
        voxel_.instances.assign(1, {kOwnInstance, best.count});
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

/// Decodes one voxel from the planes and the rest; `voxel` must be empty.
bool ReadVoxel(std::uint8_t form, LabelCount first, ByteReader& rest, LabelHistograms& voxel) {
  if (form == kLong) return GetSized(rest, voxel.classes) && GetSized(rest, voxel.instances);
  const int num_classes = form & 0x7F;
  if (num_classes == 0 || num_classes == kLong) return false;
  voxel.classes.push_back(first);
  if (!GetCounts(static_cast<std::uint64_t>(num_classes - 1), first.id, rest, voxel.classes)) return false;
  if (form & kOtherInstances) return GetSized(rest, voxel.instances);
  const std::uint64_t total = Total(voxel.classes);
  if (total > std::numeric_limits<std::uint32_t>::max()) return false;
  voxel.instances.push_back({kOwnInstance, static_cast<std::uint32_t>(total)});
  return true;
}

VoxelBits LabelledVoxels(const LabelBlock& block) {
  VoxelBits mask{};
  for (int i = 0; i < kBlockVoxels; ++i) {
    if (!block.IsEmpty(i)) MaskVoxel(mask, i);
  }
  return mask;
}

void WriteBlock(const LabelBlock& block, const VoxelWalk& walk, Buffer& buffer) {
  VoxelWalk::Grid& class_grid = VoxelWalk::GridOfThread();
  VoxelWalk::Grid& count_grid = VoxelWalk::GridOfThread(VoxelWalk::Scratch::kSecond);
  ByteWriter rest(buffer.rest);
  HistogramReader reader(block);
  std::size_t n = buffer.planes[kForm].size();
  for (Bytes& plane : buffer.planes) plane.resize(n + walk.sites().size());
  for (const auto& site : walk.sites()) {
    const LabelHistograms& voxel = reader.Read(site.linear);
    const std::uint8_t form = FormOf(voxel);
    const LabelCount first = form == kLong ? LabelCount{} : voxel.classes[0];
    class_grid[site.cell] = static_cast<std::int32_t>(first.id);
    count_grid[site.cell] = static_cast<std::int32_t>(first.count);
    const std::uint16_t class_code = ZigZag16(class_grid[site.cell] - VoxelWalk::PredictNear(class_grid, site));
    const std::uint16_t count_code = ZigZag16(count_grid[site.cell] - VoxelWalk::PredictNear(count_grid, site));
    buffer.planes[kForm][n] = form;
    buffer.planes[kClass0][n] = static_cast<std::uint8_t>(class_code);
    buffer.planes[kClass1][n] = static_cast<std::uint8_t>(class_code >> 8);
    buffer.planes[kCount0][n] = static_cast<std::uint8_t>(count_code);
    buffer.planes[kCount1][n] = static_cast<std::uint8_t>(count_code >> 8);
    ++n;
    if (form == kLong) {
      PutSized(voxel.classes, rest);
    } else {
      PutCounts<std::uint32_t>(std::span(voxel.classes).subspan(1), first.id, rest);
    }
    if (form & kOtherInstances || form == kLong) PutSized(voxel.instances, rest);
  }
}

void Append(const Buffer& buffer, ByteWriter& writer) {
  for (const Bytes& plane : buffer.planes) writer.PutBytes(plane);
  writer.PutBytes(buffer.rest);
}

/// Number of voxels whose form does not fit, or may not fit, into a cell of a LabelBlock.
std::size_t NumNotInline(ByteView forms) {
  constexpr std::uint8_t kMostInline = 2;  // classes, with the own instance only
  return static_cast<std::size_t>(
      std::count_if(forms.begin(), forms.end(), [](std::uint8_t form) { return form > kMostInline; }));
}

/// Decodes an empty block from its part of the planes and its varints in `rest`.
Status ReadBlock(const VoxelWalk& walk, const std::array<ByteView, kNumLabelPlanes>& planes, ByteReader& rest,
                 LabelBlock& block) {
  VoxelWalk::Grid& class_grid = VoxelWalk::GridOfThread();
  VoxelWalk::Grid& count_grid = VoxelWalk::GridOfThread(VoxelWalk::Scratch::kSecond);
  block.ReserveOverflow(NumNotInline(planes[kForm].first(walk.sites().size())));
  LabelHistograms voxel;
  std::size_t n = 0;
  for (const auto& site : walk.sites()) {
    const auto read = [&](VoxelWalk::Grid& grid, LabelPlane low) {
      const std::int32_t difference = UnZigZag(planes[low][n] | (planes[low + 1][n] << 8));
      grid[site.cell] = static_cast<std::uint16_t>(grid[site.near] + difference);
      return static_cast<std::uint32_t>(grid[site.cell]);
    };
    const LabelCount first{.id = read(class_grid, kClass0), .count = read(count_grid, kCount0)};
    constexpr std::uint8_t kOneClass = 1;
    if (planes[kForm][n] == kOneClass && first.id < kMaxInPlane && first.count > 0) {  // almost all voxels
      block.SetFirst(site.linear, first);
      ++n;
      continue;
    }
    voxel.classes.clear();
    voxel.instances.clear();
    if (!ReadVoxel(planes[kForm][n++], first, rest, voxel)) return DataLoss("holds a malformed voxel");
    if (!voxel.classes.empty() && voxel.classes.back().id >= kMaxInPlane) return DataLoss("holds a class that none is");
    block.Set(site.linear, voxel);
  }
  block.ShrinkOverflow();  // large counts of one class fit into a cell
  return Status::Ok();
}

}  // namespace

Bytes EncodeLabelBlock(const LabelBlock& block, BlockIndex index) {
  const VoxelBits mask = LabelledVoxels(block);
  Buffer buffer;
  WriteBlock(block, VoxelWalk(mask), buffer);
  Payload payload;
  ByteWriter writer(payload.packable);
  writer.PutBytes(mask);
  Append(buffer, writer);
  return Seal(BlobKind::kLabelsV1, index, payload);
}

Status DecodeLabelBlock(ByteView blob, BlockIndex index, LabelBlock& block) {
  thread_local Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(BlobKind::kLabelsV1, index, blob, payload));
  ByteReader reader(payload.packable);
  VoxelBits mask{};
  reader.GetInto(mask);
  if (!reader.ok() || !payload.plain.empty()) return DataLoss("has a malformed header");
  const VoxelWalk walk(mask);
  std::array<ByteView, kNumLabelPlanes> planes;
  for (ByteView& plane : planes) plane = reader.GetBytes(walk.sites().size());
  if (!reader.ok()) return DataLoss("is not as long as its voxels need");
  block = LabelBlock{};
  DHPMAP_RETURN_IF_ERROR(ReadBlock(walk, planes, reader, block));
  if (reader.remaining() != 0) return DataLoss("is longer than its voxels need");
  return Status::Ok();
}

namespace {

/// The cells of blocks with conclusions.
std::uint64_t ConcludedCells(const LayerBlocks<LabelBlock>& blocks) {
  std::uint64_t cells = 0;
  for (const auto& [cell, block] : blocks) {
    if (!HasNone(block->concluded())) cells |= std::uint64_t{1} << cell;
  }
  return cells;
}

/// False if there are no conclusions.
bool ReadConcluded(ByteReader& reader, VoxelMask& concluded) {
  for (std::uint64_t& word : concluded) word = reader.GetU64();
  return !HasNone(concluded);
}

}  // namespace

Bytes EncodeLabelTile(const LayerBlocks<LabelBlock>& blocks, TileIndex index) {
  thread_local Buffer buffer;
  buffer.Clear();
  Payload payload;
  ByteWriter writer(payload.packable);
  writer.PutU64(CellsOf(blocks));
  writer.PutU64(ConcludedCells(blocks));
  for (const auto& [cell, block] : blocks) {
    const VoxelBits mask = LabelledVoxels(*block);
    writer.PutBytes(mask);
    WriteBlock(*block, VoxelWalk(mask), buffer);
  }
  for (const auto& [cell, block] : blocks) {
    if (HasNone(block->concluded())) continue;
    for (const std::uint64_t word : block->concluded()) writer.PutU64(word);
  }
  Append(buffer, writer);
  return Seal(BlobKind::kLabelsTile, SealIndexOf(index), payload);
}

Status DecodeLabelTile(ByteView blob, TileIndex index, LayerBlocks<LabelBlock>& blocks) {
  blocks.clear();
  thread_local Payload payload;
  DHPMAP_RETURN_IF_ERROR(Unseal(BlobKind::kLabelsTile, SealIndexOf(index), blob, payload));
  ByteReader reader(payload.packable);
  const std::uint64_t cells = reader.GetU64(), concluded_cells = reader.GetU64();
  const ByteView masks = reader.GetBytes(sizeof(VoxelBits) * static_cast<std::size_t>(std::popcount(cells)));
  std::vector<VoxelMask> concluded(static_cast<std::size_t>(std::popcount(concluded_cells)));
  for (VoxelMask& mask : concluded) {
    if (!ReadConcluded(reader, mask)) return DataLoss("says that nothing is concluded");
  }
  const bool is_well_formed = reader.ok() && cells != 0 && (concluded_cells & ~cells) == 0 && payload.plain.empty();
  if (!is_well_formed) return DataLoss("has a malformed header");
  const std::size_t num_voxels = NumMasked(masks);
  std::array<ByteView, kNumLabelPlanes> planes;
  for (ByteView& plane : planes) plane = reader.GetBytes(num_voxels);
  if (!reader.ok()) return DataLoss("is not as long as its voxels need");
  auto next_concluded = concluded.begin();
  for (std::size_t n = 0; const int cell : CellsIn(cells)) {
    VoxelBits mask{};
    ByteReader(masks.subspan(sizeof(VoxelBits) * n++, sizeof(VoxelBits))).GetInto(mask);
    const VoxelWalk walk(mask);
    auto block = std::shared_ptr<LabelBlock>(new LabelBlock());  // not make_shared: StateMarks would keep its memory
    DHPMAP_RETURN_IF_ERROR(ReadBlock(walk, planes, reader, *block));
    if ((concluded_cells >> cell & 1u) != 0) block->set_concluded(*next_concluded++);
    blocks.push_back({cell, std::move(block)});
    for (ByteView& plane : planes) plane = plane.subspan(walk.sites().size());
  }
  if (reader.remaining() != 0) return DataLoss("is longer than its voxels need");
  return Status::Ok();
}

}  // namespace dhpmap
