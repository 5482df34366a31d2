// SPDX-License-Identifier: BSD-3-Clause
// What the store keeps of changes for those who watch a map. The first byte chooses whether the rest is a blob or what
// a blob packs: without that hardly any input would come as far as the decoder.
#include "storage/codec/change_codec.h"
#include "storage/codec/envelope.h"
#include "tests/fuzz/fuzz_target.h"

namespace dhpmap {
namespace {

constexpr std::int64_t kRevision = 7;
constexpr BlockIndex kKey{kRevision, 0, 0};
constexpr char kBlob = 0, kPacked = 1, kPackedWithRegions = 2;

SubmapEvent Event(ChangeKind kind) {
  SubmapEvent event;
  event.kind = kind;
  event.parts = {SubmapPart::kPose, SubmapPart::kGeometry};
  event.info.id = SubmapId(5);
  event.info.panoptic = Panoptic::kThing;
  event.info.class_id = ClassId(3);
  event.info.display_name = "a chair";
  event.info.class_counts = {{ClassId(3), 400}, {ClassId(4), 2}};
  event.observed = {.center_m = {1, 2, 3}, .radius_m = 0.5};
  event.num_blocks = 12;
  event.tiles = {{{-1, 0, 2}, {3, 4, 5}}, {{7, 7, 7}, {7, 7, 7}}};
  if (kind == ChangeKind::kMerged) event.into = SubmapId(2);
  if (kind != ChangeKind::kCreated) event.before = SubmapPlace{Panoptic::kThing, ClassId(4), event.observed};
  return event;
}

}  // namespace

std::vector<std::string> fuzz::Seeds() {
  MapChange change{.first_revision = 3, .last_revision = kRevision, .time_ns = 1'700'000'000'000'000'000};
  std::vector<std::string> seeds;
  const auto add = [&] {
    const bool has_regions = !change.regions.empty();
    const Bytes blob = EncodeChange(change);
    Payload payload;
    Require(Unseal(has_regions ? BlobKind::kChangeV3 : BlobKind::kChangeV2, kKey, blob, payload).ok());
    seeds.push_back(kBlob + std::string(blob.begin(), blob.end()));
    seeds.push_back((has_regions ? kPackedWithRegions : kPacked) +
                    std::string(payload.packable.begin(), payload.packable.end()));
  };
  add();
  change.display_name = "the house";
  for (const auto kind : {ChangeKind::kCreated, ChangeKind::kChanged, ChangeKind::kRemoved, ChangeKind::kMerged}) {
    change.submaps.push_back(Event(kind));
  }
  add();
  const Region sphere = BoundingSphere{.center_m = {1, 2, 3}, .radius_m = 0.5};
  const Region box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 2, 3));
  change.regions = {{.region = sphere, .classes = {ClassId(3), ClassId(4)}, .num_voxels = 12},
                    {.region = box, .submap = SubmapId(5)},
                    {.kind = RegionEventKind::kKeptClear, .region = box, .name = "door"},
                    {.kind = RegionEventKind::kLifted, .region = sphere, .name = "hall"}};
  add();
  change.submaps[1].pose_boxes = PoseBoxes{std::get<Eigen::AlignedBox3d>(box), std::get<Eigen::AlignedBox3d>(box)};
  const Bytes moved = EncodeChange(change);
  seeds.push_back(kBlob + std::string(moved.begin(), moved.end()));
  return seeds;
}

}  // namespace dhpmap

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dhpmap;
  if (size == 0) return 0;
  Bytes given(data + 1, data + size);
  Bytes blob;
  if (data[0] == kPacked) blob = Seal(BlobKind::kChangeV2, kKey, {.packable = std::move(given), .plain = {}});
  else if (data[0] == kPackedWithRegions)
    blob = Seal(BlobKind::kChangeV3, kKey, {.packable = std::move(given), .plain = {}});
  else blob = std::move(given);
  MapChange change{.last_revision = kRevision};
  if (!DecodeChange(blob, change).ok()) return 0;
  const Bytes encoded = EncodeChange(change);
  MapChange again{.last_revision = kRevision};
  fuzz::Require(DecodeChange(encoded, again).ok());
  fuzz::Require(EncodeChange(again) == encoded);
  return 0;
}
