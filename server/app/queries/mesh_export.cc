// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/queries/mesh_export.h"

#include <algorithm>
#include <bit>
#include <string_view>
#include <utility>

#include "mapping/io/pcd.h"
#include "mapping/io/ply.h"
#include "mapping/paging/read_tiles.h"
#include "server/app/queries/glb_plan.h"
#include "server/app/states/etag.h"
#include "server/app/states/no_such_submap.h"

namespace dhpmap {

namespace {

std::size_t CapacityOf(const Mesh& mesh) {
  return CapacityBytes(mesh.vertices_m) + CapacityBytes(mesh.normals) + CapacityBytes(mesh.colors) +
         CapacityBytes(mesh.classes) + CapacityBytes(mesh.instances) + CapacityBytes(mesh.triangles);
}

/// An etag is a "g", 16 digits for the bytes, and 16 for the state that they show. If either agrees, the files are
/// equal.
constexpr std::size_t kTagDigits = 16, kContentAt = 1, kStateAt = kContentAt + kTagDigits;

/// The first of the client's etags that has `digits` at this position; empty if there is none.
std::string HeldEtag(std::string_view held, std::size_t at, std::string_view digits) {
  while (!held.empty()) {
    const std::size_t end = std::min(held.find(','), held.size());
    const std::string_view etag = held.substr(0, end);
    if (etag.size() == kStateAt + kTagDigits && etag.front() == 'g' && etag.substr(at, kTagDigits) == digits) {
      return std::string(etag);
    }
    held.remove_prefix(std::min(end + 1, held.size()));
  }
  return {};
}

/// Reads the tiles that MeshStream visits.
void ReadAll(const MapSnapshot& map, const Submap* only, const Spread& spread, const std::stop_token& stop) {
  std::vector<const BlockTile*> unread;
  for (const auto& submap : map.submaps()) {
    if (only != nullptr ? submap.get() == only : !submap->IsAbsent()) AddUnread(submap->blocks(), unread);
  }
  ReadTiles(unread, spread, stop);
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

MeshFile::MeshFile(std::int64_t revision, std::string etag, std::shared_ptr<const GlbFile> glb, CountedBytes reserved)
    : revision_(revision),
      format_(MeshFormat::kGlb),
      etag_(std::move(etag)),
      glb_(std::move(glb)),
      num_bytes_(glb_ ? glb_->bytes.size() : 0),
      reserved_(std::move(reserved)) {}

bool MeshFile::NextOfGlb(std::string& piece) {
  constexpr std::size_t kMostBytes = 200'000;
  if (!glb_) return false;
  piece.assign(glb_->bytes, num_read_bytes_, kMostBytes);
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
  // Masks and numbers of a block. Blocks of several submaps are merged into a copy: in the worst case all, in pairs.
  constexpr std::size_t kBlock = 800, kMerged = sizeof(TsdfBlock) + kBlockVoxels * sizeof(std::uint16_t);
  if (request.format == MeshFormat::kGlb) return GlbPlan(map, request).num_bytes();
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

Result<MeshFile> ExportGlb(const std::shared_ptr<const MapSnapshot>& map, const MeshRequest& request, GlbCache& cache,
                           const RoomFor& room_for, const std::stop_token& stop, const Spread& spread) {
  if (request.submap && map->Find(*request.submap) == nullptr) return NoSuchSubmap(map->info(), *request.submap);
  const GlbPlan plan(*map, request);
  const std::string state = HistoryText(plan.state_name());
  const auto held = [&](std::string etag) {
    return MeshFile(map->revision(), std::move(etag), nullptr, CountedBytes(MemoryKind::kReserved));
  };
  if (plan.state_name() != 0) {
    if (std::string etag = HeldEtag(request.held_etags, kStateAt, state); !etag.empty()) return held(std::move(etag));
  }
  if (auto kept = cache.Find(plan.name())) {
    std::string etag = HeldEtag(request.held_etags, kContentAt, kept->content_tag);
    if (!etag.empty()) return held(std::move(etag));
    etag = 'g' + kept->content_tag + state;
    return MeshFile(map->revision(), std::move(etag), std::move(kept), CountedBytes(MemoryKind::kReserved));
  }
  DHPMAP_RETURN_IF_ERROR(room_for(plan.num_bytes()));
  CountedBytes reserved(MemoryKind::kReserved, plan.num_bytes());
  std::shared_ptr<const GlbFile> made = plan.Make(stop, spread);
  if (made == nullptr) return Cancelled("nobody waits for the mesh any longer");
  if (plan.name() != 0) cache.Put(plan.name(), made);
  std::string etag = HeldEtag(request.held_etags, kContentAt, made->content_tag);
  if (!etag.empty()) return held(std::move(etag));
  etag = 'g' + made->content_tag + state;
  return MeshFile(map->revision(), std::move(etag), std::move(made), std::move(reserved));
}

Result<MeshFile> ExportMesh(std::shared_ptr<const MapSnapshot> map, const MeshRequest& request,
                            const std::stop_token& stop, const Spread& spread) {
  const Submap* submap = request.submap ? map->Find(*request.submap) : nullptr;
  if (request.submap && submap == nullptr) return NoSuchSubmap(map->info(), *request.submap);
  if (request.format == MeshFormat::kGlb) {
    GlbCache none(0);
    return ExportGlb(
        map, request, none, [](std::size_t) { return Status::Ok(); }, stop, spread);
  }
  const std::int64_t revision = map->revision();
  CountedBytes reserved(MemoryKind::kReserved, BytesOfExport(*map, request));
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
