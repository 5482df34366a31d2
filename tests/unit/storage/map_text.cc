// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/storage/map_text.h"

#include <algorithm>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <vector>

#include "mapping/submap/submap_fields.h"
#include "storage/codec/bytes.h"
#include "storage/codec/crc32c.h"
#include "storage/rows/value.h"

namespace dhpmap::testing {
namespace {

/// Blocks of a submap, and voxels of each, that are written out in full.
constexpr int kBlocksInFull = 1;
constexpr int kVoxelsInFull = 3;

[[gnu::format(printf, 1, 2)]] std::string Line(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return std::string(text) + "\n";
}

void Append(std::string& text, std::uint32_t id, std::uint64_t count) {
  text.append(" ").append(std::to_string(id)).append(":").append(std::to_string(count));
}

std::uint32_t NumberOf(std::uint32_t class_id) { return class_id; }
std::uint32_t NumberOf(SeenInstance instance) { return instance.code(); }

template <typename Id>
std::string TextOf(std::vector<SeenCount<Id>> counts) {
  std::sort(counts.begin(), counts.end(), [](SeenCount<Id> a, SeenCount<Id> b) { return a.id < b.id; });
  std::string text;
  for (const SeenCount<Id>& entry : counts) Append(text, NumberOf(entry.id), entry.count);
  return text;
}

std::string TextOf(const TsdfBlock& block, int num_in_full) {
  Bytes bytes;
  ByteWriter writer(bytes);
  std::string voxels;
  for (int v = 0; v < kBlockVoxels; ++v) {
    if (!block.IsObserved(v)) continue;
    const auto i = static_cast<std::size_t>(v);
    const Color c = block.color[i];
    writer.PutU32(static_cast<std::uint32_t>(v));
    writer.PutF32(block.distance_m[i]);
    writer.PutF32(block.weight[i]);
    for (const std::uint8_t value : {c.r, c.g, c.b}) writer.PutU8(value);
    if (num_in_full-- > 0) {
      voxels += Line("      voxel %d distance_m %.9g weight %.9g color %d %d %d", v,
                     static_cast<double>(block.distance_m[i]), static_cast<double>(block.weight[i]), c.r, c.g, c.b);
    }
  }
  return Line("    tsdf %d voxels %08x", block.NumObservedVoxels(), Crc32c(bytes)) + voxels;
}

std::string TextOf(const LabelBlock& block, int num_in_full) {
  Bytes bytes;
  ByteWriter writer(bytes);
  std::string voxels;
  int num_labelled = 0;
  for (int v = 0; v < kBlockVoxels; ++v) {
    if (block.IsEmpty(v)) continue;
    ++num_labelled;
    const LabelHistograms labels = block.Get(v);
    const std::string text = "classes" + TextOf(labels.classes) + " instances" + TextOf(labels.instances);
    writer.PutU32(static_cast<std::uint32_t>(v));
    writer.PutText(text);
    if (num_in_full-- > 0) voxels += Line("      voxel %d %s", v, text.c_str());
  }
  return Line("    labels %d voxels %08x", num_labelled, Crc32c(bytes)) + voxels;
}

std::string TextOf(const GoneBlock& block) {
  Bytes bytes;
  ByteWriter writer(bytes);
  int num_contradicted = 0;
  for (int v = 0; v < kBlockVoxels; ++v) {
    writer.PutU8(static_cast<std::uint8_t>(block.Count(v)));
    num_contradicted += block.IsContradicted(v);
  }
  const Viewpoint& last = block.last();
  return Line("    gone %d voxels %08x from %.17g %.17g %.17g at %" PRId64, num_contradicted, Crc32c(bytes),
              last.position_m.x(), last.position_m.y(), last.position_m.z(), last.stamp_ns);
}

std::string RowText(const Submap& submap) {
  const SubmapInfo& info = submap.info();
  std::string text = Line("submap %u '%s' panoptic %d class %d%s", info.id.value, info.display_name.c_str(),
                          static_cast<int>(info.panoptic), info.class_id.value, info.class_is_fixed ? " fixed" : "");
  for (int row = 0; row < 3; ++row) {
    const auto T = info.T_map_submap.matrix();
    text += Line("  pose %.17g %.17g %.17g %.17g", T(row, 0), T(row, 1), T(row, 2), T(row, 3));
  }
  const BoundingSphere& sphere = submap.bounding_sphere();
  text += Line("  sphere %.17g %.17g %.17g radius_m %.17g", sphere.center_m.x(), sphere.center_m.y(),
               sphere.center_m.z(), sphere.radius_m);
  text += Line("  voxel_size_m %.17g truncation_m %.17g instance_confidence %.9g", info.voxel_size_m, info.truncation_m,
               static_cast<double>(info.instance_confidence));
  text += Line("  activity %d confirmed %d frames %" PRId64 " missed %d overlooked %d track %u revision %" PRId64,
               static_cast<int>(info.activity), info.is_confirmed, info.num_frames_observed, info.num_frames_missed,
               info.num_frames_overlooked, info.track_id, info.revision);
  text += Line("  observed_ns %" PRId64 " %" PRId64, info.first_observed_ns, info.last_observed_ns);
  if (info.presence != Presence::kPresent || info.last_contradicted_ns != 0 || info.is_placed) {  // from schema 5 on
    text += Line("  presence %d contradicted_ns %" PRId64 "%s", static_cast<int>(info.presence),
                 info.last_contradicted_ns, info.is_placed ? " placed" : "");
  }
  if (info.is_locked) text += Line("  locked");            // from schema 10 on
  for (const Sighting& sighting : info.sightings.all()) {  // from schema 9 on
    text += Line("  session '%s' track %u%s missed %d last frame %" PRId64, sighting.session.c_str(), sighting.track_id,
                 sighting.has_in_sight ? " in sight" : "", sighting.num_frames_missed, sighting.last_frame);
  }
  VisitSubmapFields([&](const auto& field) {  // from later schemas on
    constexpr int kAllAbove = 5;
    static const SubmapInfo kDefaults;
    if (field.since <= kAllAbove || IsSameValue(field.Of(info), field.Of(kDefaults))) return;
    Bytes bytes;
    ByteWriter writer(bytes);
    ColumnValue<std::remove_cvref_t<decltype(field.Of(info))>>::Cover(field.Of(info), writer);
    text += Line("  %s %08x", field.name, Crc32c(bytes));
  });
  text += "  class_counts";
  for (const ClassTotal& entry : info.class_counts) {
    Append(text, entry.id.value, entry.count);
  }
  return text + "\n";
}

/// Corners of a box, or centre and radius of a sphere.
std::vector<double> NumbersOf(const Region& region) {
  if (const auto* box = std::get_if<Eigen::AlignedBox3d>(&region)) {
    const Eigen::Vector3d low = box->min(), high = box->max();
    return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
  }
  const auto& sphere = std::get<BoundingSphere>(region);
  return {sphere.center_m.x(), sphere.center_m.y(), sphere.center_m.z(), sphere.radius_m};
}

/// Its tiles by their first block, whatever order they were loaded in.
std::vector<const BlockTile*> SortedTiles(const Submap& submap) {
  const auto first_block = [](const BlockTile& tile) {
    BlockIndex first = tile.entries().front().index;
    for (const BlockEntry& entry : tile.entries()) first = std::min(first, entry.index);
    return first;
  };
  std::vector<const BlockTile*> tiles;
  for (const TileEntry& entry : submap.blocks().tiles()) tiles.push_back(entry.tile.get());
  std::sort(tiles.begin(), tiles.end(),
            [&](const BlockTile* a, const BlockTile* b) { return first_block(*a) < first_block(*b); });
  return tiles;
}

std::string BlocksText(const Submap& submap) {
  std::string text;
  int num_in_full = kBlocksInFull;
  for (const BlockTile* tile : SortedTiles(submap)) {
    for (const BlockEntry& entry : tile->entries()) {
      const int num_voxels = num_in_full-- > 0 ? kVoxelsInFull : 0;
      text += Line("  block %d %d %d", entry.index.x, entry.index.y, entry.index.z);
      if (entry.tsdf) text += TextOf(*entry.tsdf, num_voxels);
      if (entry.labels) text += TextOf(*entry.labels, num_voxels);
      if (entry.gone) text += TextOf(*entry.gone);
    }
  }
  return text;
}

}  // namespace

std::string TextOf(const MapSnapshot& map) {
  const MapInfo& info = map.info();
  std::string text = Line("map '%s' '%s' revision %" PRId64 " frames %" PRId64 " next_submap_id %u", info.name.c_str(),
                          info.display_name.c_str(), info.revision, info.num_frames, info.next_submap_id.value);
  text += Line("create_time_ns %" PRId64 " update_time_ns %" PRId64, info.create_time_ns, info.update_time_ns);
  for (const LabelClass& c : info.label_set->classes()) {
    text += Line("class %d '%s' panoptic %d size %d color %d %d %d", c.id.value, c.name.c_str(),
                 static_cast<int>(c.panoptic), static_cast<int>(c.size), c.color.r, c.color.g, c.color.b);
  }
  for (const MergedId& entry : info.merged.list()) {
    text += Line("merged %u into %u", entry.merged.value, entry.into.value);
  }
  for (const ObjectPair& pair : info.pairs.pairs()) {
    text += Line("pair %u %u verdict %d evidence %d", pair.first.value, pair.second.value,
                 static_cast<int>(pair.verdict), pair.evidence);
  }
  for (const KeptClearRegion& region : info.kept_clear.list()) {  // from schema 10 on
    text += Line("kept clear '%s'", region.name.c_str());
    for (const double number : NumbersOf(region.region)) text += Line("  %.17g", number);
  }
  for (const auto& submap : map.submaps()) text += RowText(*submap) + BlocksText(*submap);
  return text;
}

std::string TextOf(const std::vector<ConfigRow>& config) {
  std::string text;
  for (const ConfigRow& row : config) text += "config " + row.key + " = " + row.value + "\n";
  return text;
}

}  // namespace dhpmap::testing
