// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/glb_plan.h"

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "mapping/io/glb.h"
#include "mapping/mesh/object_meshes.h"
#include "mapping/paging/read_tiles.h"
#include "server/app/states/etag.h"
#include "server/base/fingerprint.h"

namespace dhpmap {
namespace {

std::vector<const Submap*> WantedOf(const MapSnapshot& map, const MeshRequest& request) {
  std::vector<const Submap*> wanted;
  const auto add = [&](SubmapId id) {
    if (const Submap* submap = map.Find(id)) wanted.push_back(submap);
  };
  if (request.submap) {
    add(*request.submap);
  } else if (!request.only.empty()) {
    for (const SubmapId id : request.only) add(id);
  } else {
    for (const auto& submap : map.submaps()) {
      if (!submap->IsAbsent()) wanted.push_back(submap.get());
    }
  }
  return wanted;
}

template <typename Number>
void Append(Number number, std::string& text) {
  text.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

/// A JSON string; control characters become spaces.
std::string Quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + '"';
}

/// Properties of an object's node: identity and class. Rounded, so that not every frame changes the file.
std::string ExtrasOf(const SubmapInfo& info, const LabelSet& classes) {
  std::string extras = R"({"instance_id":)" + std::to_string(info.id.value);
  if (info.panoptic != Panoptic::kUnknown) {
    std::array<char, 16> share{};
    std::snprintf(share.data(), share.size(), "%.2f", static_cast<double>(info.ClassConfidence()));
    const LabelClass* its = classes.Find(info.class_id);
    extras += R"(,"class_id":)" + std::to_string(info.class_id.value) + R"(,"class_name":)" +
              Quoted(its == nullptr ? "" : its->name) + R"(,"class_confidence":)" + share.data();
  }
  return extras + "}";
}

}  // namespace

GlbPlan::GlbPlan(const MapSnapshot& map, const MeshRequest& request)
    : map_(map),
      request_(request),
      wanted_(WantedOf(map, request)),
      sources_(MeshSourcesOf(map, wanted_)),
      name_(NameOf()),
      state_name_(StateNameOf()),
      num_bytes_(BytesOf()) {}

void GlbPlan::AppendWanted(std::string& text) const {
  text += request_.submap ? "/one" : "/many";
  for (const Submap* submap : wanted_) {
    text += ExtrasOf(submap->info(), *map_.info().label_set);
    Append(IsCutFromMap(map_, *submap), text);
    if (request_.submap) continue;
    for (const double number : submap->info().T_map_submap.matrix().reshaped()) Append(number, text);
  }
}

std::uint64_t GlbPlan::NameOf() const {
  if (request_.coloring != MeshColoring::kSensor) return 0;  // it would have to include all classes and their colours
  std::string text = map_.info().name;
  AppendWanted(text);
  for (const SourceTile& source : sources_.tiles) {
    Append(source.submap->id().value, text);
    Append(source.tile->part_id(), text);
  }
  return Fingerprint(text);
}

std::uint64_t GlbPlan::StateNameOf() const {
  // Increment when the same objects give another file.
  constexpr std::uint32_t kWayOfMaking = 1;
  if (request_.coloring != MeshColoring::kSensor) return 0;
  std::string text;
  Append(kWayOfMaking, text);
  Append(map_.info().history_id, text);
  AppendWanted(text);
  for (const auto* submaps : {&wanted_, &sources_.around}) {
    for (const Submap* submap : *submaps) {
      Append(submap->id().value, text);
      Append(submap->info().revision, text);
    }
  }
  return Fingerprint(text);
}

std::size_t GlbPlan::BytesOf() const {
  // A block needs masks and numbers; a block of several submaps, a merged copy. Each requested block needs its surface
  // twice as a mesh, with the map's and its own numbers, and once in the file: about 30 vertices and 60 triangles.
  constexpr std::size_t kBlock = 800, kMerged = sizeof(TsdfBlock) + kBlockVoxels * sizeof(std::uint16_t);
  constexpr std::size_t kSurface = 8000;
  std::size_t num_wanted = 0, num_sources = 0;
  for (const Submap* submap : wanted_) num_wanted += submap->blocks().size();
  for (const SourceTile& source : sources_.tiles) num_sources += source.num_blocks;
  return num_sources * (kBlock + kMerged / 2) + num_wanted * kSurface;
}

std::shared_ptr<const GlbFile> GlbPlan::Make(const std::stop_token& stop, const Spread& spread) const {
  std::vector<const BlockTile*> unread;
  for (const SourceTile& source : sources_.tiles) {
    if (!source.tile->IsRead()) unread.push_back(source.tile);
  }
  ReadTiles(unread, spread, stop);
  const std::vector<ObjectMesh> meshes = ExtractObjectMeshes(map_, wanted_, sources_, request_.coloring, stop);
  std::vector<GlbObject> objects;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SubmapInfo& info = wanted_[i]->info();
    const std::string id = std::to_string(info.id.value);
    objects.push_back({.name = "maps/" + map_.info().name + "/submaps/" + id,
                       .extras = ExtrasOf(info, *map_.info().label_set),
                       .T_file_object = request_.submap ? Transform::Identity() : info.T_map_submap,
                       .mesh = &meshes[i].mesh});
  }
  std::string bytes = WriteGlb(objects);
  if (stop.stop_requested()) return nullptr;
  std::string content_tag = HistoryText(Fingerprint(bytes));
  return std::make_shared<const GlbFile>(GlbFile{std::move(bytes), std::move(content_tag)});
}

}  // namespace dhpmap
