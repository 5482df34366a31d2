// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/mesh_export.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "mapping/io/glb.h"
#include "mapping/io/pcd.h"
#include "mapping/io/ply.h"
#include "mapping/mesh/object_meshes.h"
#include "mapping/paging/read_tiles.h"
#include "server/app/states/etag.h"
#include "server/app/states/no_such_submap.h"
#include "server/base/fingerprint.h"

namespace dhpmap {

namespace {

std::size_t CapacityOf(const Mesh& mesh) {
  return CapacityBytes(mesh.vertices_m) + CapacityBytes(mesh.normals) + CapacityBytes(mesh.colors) +
         CapacityBytes(mesh.classes) + CapacityBytes(mesh.instances) + CapacityBytes(mesh.triangles);
}

/// Of what MeshStream goes through.
void ReadAll(const MapSnapshot& map, const Submap* only, const Spread& spread, const std::stop_token& stop) {
  std::vector<const BlockTile*> unread;
  for (const auto& submap : map.submaps()) {
    if (only != nullptr ? submap.get() == only : !submap->IsAbsent()) AddUnread(submap->blocks(), unread);
  }
  ReadTiles(unread, spread, stop);
}

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

std::string GlbOf(const MapSnapshot& map, const MeshRequest& request, const std::stop_token& stop,
                  const Spread& spread) {
  const std::vector<const Submap*> wanted = WantedOf(map, request);
  std::vector<const BlockTile*> unread;
  for (const Submap* submap : SubmapsAround(map, wanted)) AddUnread(submap->blocks(), unread);
  ReadTiles(unread, spread, stop);
  const std::vector<ObjectMesh> meshes = ExtractObjectMeshes(map, wanted, request.coloring, stop);
  std::vector<GlbObject> objects;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SubmapInfo& info = wanted[i]->info();
    const std::string id = std::to_string(info.id.value);
    objects.push_back({.name = "maps/" + map.info().name + "/submaps/" + id,
                       .extras = R"({"instance_id":)" + id + "}",
                       .T_file_object = request.submap ? Transform::Identity() : info.T_map_submap,
                       .mesh = &meshes[i].mesh});
  }
  return WriteGlb(objects);
}

}  // namespace

MeshFile::MeshFile(std::int64_t revision, MeshFormat format, MeshStream mesh, std::string head, CountedBytes reserved)
    : revision_(revision),
      format_(format),
      mesh_(std::move(mesh)),
      head_(std::move(head)),
      num_bytes_(head_.size() + (format == MeshFormat::kPcd
                                     ? PcdBodyBytes(mesh_->num_vertices())
                                     : PlyBodyBytes(mesh_->num_vertices(), mesh_->num_triangles()))),
      reserved_(std::move(reserved)) {}

MeshFile::MeshFile(std::int64_t revision, std::string glb, CountedBytes reserved)
    : revision_(revision),
      format_(MeshFormat::kGlb),
      head_(std::move(glb)),
      num_bytes_(head_.size()),
      etag_("g" + HistoryText(Fingerprint(head_))),
      reserved_(std::move(reserved)) {}

bool MeshFile::NextOfGlb(std::string& piece) {
  constexpr std::size_t kMostBytes = 200'000;
  piece.assign(head_, num_read_bytes_, kMostBytes);
  num_read_bytes_ += piece.size();
  return !piece.empty();
}

bool MeshFile::Next(std::string& piece) {
  if (format_ == MeshFormat::kGlb) return NextOfGlb(piece);
  piece = std::exchange(head_, {});
  if (!piece.empty()) return true;
  if (mesh_->NextVertices(piece_)) {
    format_ == MeshFormat::kPcd ? AppendPcdPoints(piece_, piece) : AppendPlyVertices(piece_, piece);
  } else if (format_ == MeshFormat::kPly && mesh_->NextTriangles(piece_)) {
    AppendPlyTriangles(piece_, piece);
  }
  piece_bytes_.Set(CapacityOf(piece_));
  return !piece.empty();
}

std::size_t BytesOfExport(const MapSnapshot& map, const MeshRequest& request) {
  // Masks and numbers of a block. Blocks that several submaps have are merged into a copy: at worst all, two into one.
  constexpr std::size_t kBlock = 800, kMerged = sizeof(TsdfBlock) + kBlockVoxels * sizeof(std::uint16_t);
  if (request.format == MeshFormat::kGlb) {
    // Their surface twice, in the map's and in their own numbers, and once in the file: some 30 vertices and 60
    // triangles a block. It is made of their blocks and one around them, which are thrice as many at worst.
    constexpr std::size_t kSurface = 8000;
    std::size_t num_wanted = 0, num_blocks = 0;
    for (const Submap* submap : WantedOf(map, request)) num_wanted += submap->blocks().size();
    for (const auto& submap : map.submaps()) num_blocks += submap->blocks().size();
    return std::min(3 * num_wanted, num_blocks) * (kBlock + kMerged / 2) + num_wanted * kSurface;
  }
  if (request.submap) {
    const Submap* submap = map.Find(*request.submap);
    if (submap == nullptr) return 0;
    std::size_t num_copied = 0;
    for (const TileEntry& tile : submap->blocks().tiles()) {
      num_copied += static_cast<std::size_t>(std::popcount(tile.tile->CellsWith(BlockLayer::kGone)));
    }
    return submap->blocks().size() * kBlock + num_copied * kMerged;
  }
  std::size_t num_blocks = 0;
  for (const auto& submap : map.submaps()) num_blocks += submap->blocks().size();
  return num_blocks * (kBlock + kMerged / 2);
}

Result<MeshFile> ExportMesh(std::shared_ptr<const MapSnapshot> map, const MeshRequest& request,
                            const std::stop_token& stop, const Spread& spread) {
  const Submap* submap = request.submap ? map->Find(*request.submap) : nullptr;
  if (request.submap && submap == nullptr) return NoSuchSubmap(map->info(), *request.submap);
  const std::int64_t revision = map->revision();
  CountedBytes reserved(MemoryKind::kReserved, BytesOfExport(*map, request));
  if (request.format == MeshFormat::kGlb) {
    std::string glb = GlbOf(*map, request, stop, spread);
    if (stop.stop_requested()) return Cancelled("nobody waits for the mesh any longer");
    return MeshFile(revision, std::move(glb), std::move(reserved));
  }
  ReadAll(*map, submap, spread, stop);
  MeshStream mesh(std::move(map), submap, request.coloring, stop);
  if (stop.stop_requested()) return Cancelled("nobody waits for the mesh any longer");
  std::string head;
  if (request.format == MeshFormat::kPcd) {
    DHPMAP_ASSIGN_OR_RETURN(head, PcdHead(mesh.num_vertices()));
  } else {
    head = PlyHead(mesh.num_vertices(), mesh.num_triangles());
  }
  return MeshFile(revision, request.format, std::move(mesh), std::move(head), std::move(reserved));
}

}  // namespace dhpmap
