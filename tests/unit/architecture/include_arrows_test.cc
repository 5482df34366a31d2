// SPDX-License-Identifier: BSD-3-Clause
// The plan of the house, kept true: which room may include which, and where third-party headers may appear.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/places.h"

namespace dhpmap {
namespace {

namespace fs = std::filesystem;

/// Rooms, and the rooms that each may include besides itself. A room is the longest of these paths that a file is
/// below.
const std::map<std::string, std::vector<std::string>>& Arrows() {
  static const std::map<std::string, std::vector<std::string>> arrows = {
      {"mapping/base", {}},
      {"mapping/images", {"mapping/base"}},
      {"mapping/loaded", {"mapping/base"}},
      {"mapping/labels", {"mapping/base"}},
      {"mapping/shape", {"mapping/base"}},
      {"mapping/voxels", {"mapping/base", "mapping/labels"}},
      {"mapping/paging", {"mapping/base", "mapping/voxels"}},
      {"mapping/submap", {"mapping/base", "mapping/labels", "mapping/shape", "mapping/voxels"}},
      {"mapping/free", {"mapping/base", "mapping/voxels"}},
      {"mapping/map",
       {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/paging", "mapping/submap", "mapping/free"}},
      {"mapping/changes", {"mapping/base", "mapping/voxels", "mapping/submap", "mapping/map"}},
      {"mapping/sensor", {"mapping/base", "mapping/images", "mapping/labels"}},
      {"mapping/fusion",
       {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/submap", "mapping/map", "mapping/sensor"}},
      {"mapping/space",
       {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/paging", "mapping/free", "mapping/map",
        "mapping/sensor"}},
      {"mapping/plausibility", {"mapping/base", "mapping/labels", "mapping/map", "mapping/sensor"}},
      {"mapping/tracking",
       {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/submap", "mapping/map", "mapping/sensor",
        "mapping/fusion"}},
      {"mapping/crf", {"mapping/base", "mapping/labels"}},
      {"mapping/evidence", {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/submap", "mapping/map"}},
      {"mapping/refinement",
       {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/map", "mapping/changes", "mapping/crf",
        "mapping/evidence"}},
      {"mapping/objects",
       {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/submap", "mapping/map", "mapping/changes",
        "mapping/fusion", "mapping/tracking", "mapping/evidence"}},
      {"mapping/geometry", {"mapping/base", "mapping/mesh"}},
      {"mapping/surfaces",
       {"mapping/base", "mapping/submap", "mapping/free", "mapping/map", "mapping/mesh", "mapping/geometry"}},
      {"mapping/query",
       {"mapping/base", "mapping/submap", "mapping/free", "mapping/map", "mapping/geometry", "mapping/surfaces"}},
      {"mapping/mesh", {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/submap", "mapping/map"}},
      {"mapping/io",
       {"mapping/base", "mapping/images", "mapping/labels", "mapping/map", "mapping/mesh", "mapping/loaded"}},
      {"mapping/pipeline",
       {"mapping/base", "mapping/labels", "mapping/paging", "mapping/submap", "mapping/map", "mapping/sensor",
        "mapping/fusion", "mapping/space", "mapping/plausibility", "mapping/tracking", "mapping/refinement",
        "mapping/objects"}},
      {"storage",
       {"mapping/base", "mapping/labels", "mapping/voxels", "mapping/paging", "mapping/submap", "mapping/free",
        "mapping/map", "mapping/changes"}},
      {"server/log", {"mapping/base"}},
      {"proto/types", {"mapping/base", "mapping/labels", "mapping/map", "proto"}},
      {"server/base", {"mapping/base"}},
      {"server/app/states", {"mapping", "server/base"}},
      {"server/app/feeds", {"mapping", "server/base"}},
      {"server/app/edits", {"mapping", "storage/store.h", "server/app/states"}},
      {"server/app/queries", {"mapping", "server/base", "server/app/states"}},
      {"server/app/watch", {"mapping", "storage/store.h", "server/app/states", "server/app/queries"}},
      {"server/app/open_map", {"mapping", "storage/store.h", "server/app/states", "server/app/feeds"}},
      {"server/app/follow", {"mapping", "storage/store.h", "server/base", "server/app/states"}},
      {"server/app/maps",
       {"mapping", "storage/store.h", "server/app/states", "server/app/feeds", "server/app/edits", "server/app/watch",
        "server/app/open_map", "server/app/follow"}},
      {"server/metrics", {"mapping/base", "server/app", "server/log"}},
      {"server/config", {"mapping/base", "mapping/labels", "mapping/map", "server/app", "server/log"}},
      {"server/wire", {"mapping", "server/app", "server/base", "proto"}},
      {"server/record", {"mapping/base", "mapping/map", "server/app", "server/wire", "proto"}},
      {"server/auth/keys", {"mapping/base", "storage/auth_tables.h"}},
      {"server/auth", {"mapping/base", "server/auth/keys", "server/base", "storage/auth_tables.h", "proto"}},
      {"server/net", {"mapping/base", "server/log"}},
      {"server/service", {"mapping/base"}},
      {"server/grpc",
       {"mapping", "server/app", "server/auth", "server/base", "server/net", "server/wire", "server/metrics",
        "server/log", "storage/fleet.h", "proto"}},
      {"server/http", {"mapping/base", "server/base", "server/net"}},
      {"server/json", {"mapping/base"}},
      {"server/web", {"mapping/base"}},
      {"server/gateway",
       {"mapping/base", "server/auth", "server/base", "server/web", "proto/types", "server/http", "server/json",
        "proto"}},
      {"server",
       {"mapping", "storage/auth_tables.h", "storage/store.h", "storage/postgres_store.h", "storage/sqlite_store.h",
        "server", "proto"}},  // main.cc: wiring
      {"clients/cpp/calls", {"mapping/base/mutex.h", "proto"}},
      {"clients/cpp", {"mapping/base/mutex.h", "proto"}},
      {"clients/cpp/ompl", {"mapping/base/mutex.h", "clients/cpp"}},
      {"clients/datasets", {"mapping"}},
      {"clients/command_line", {"mapping/base"}},
      {"clients/simulator", {"mapping", "clients/command_line"}},
      {"clients/evaluator", {"mapping", "clients/command_line", "clients/datasets"}},
      {"clients/evaluator/baselines", {"mapping", "clients/evaluator/mapping_system.h"}},
      {"clients/cli",
       {"mapping/base", "mapping/labels", "mapping/map", "mapping/sensor", "storage/auth_tables.h", "server/auth/keys",
        "proto/types", "clients/command_line", "clients/cpp/calls", "clients/datasets", "proto"}},
  };
  return arrows;
}

/// Front headers: all of a room that others may include; its other headers are inner ones and stay inside. Tests of
/// the room, benches, which measure its parts, and fuzzers, which feed them, see those too. A room that is not here
/// shows everything.
const std::map<std::string, std::vector<std::string>>& FrontHeaders() {
  static const std::map<std::string, std::vector<std::string>> front = {
      {"mapping/voxels",
       {"block_entry.h", "block_table.h", "block_tile.h", "gone_block.h", "label_block.h", "part_id.h",
        "part_identity.h", "part_names.h", "shown_mask.h", "slope.h", "table_loader.h", "tile_loader.h", "tile_marks.h",
        "tsdf_block.h", "voxel_average.h", "voxel_mask.h"}},
      {"mapping/paging",
       {"page_reader.h", "read_tiles.h", "tile_directory.h", "tile_evictor.h", "tile_page.h", "tile_spill.h"}},
      {"mapping/submap",
       {"bounding_sphere.h", "display_name.h", "kept_outline.h", "observed_sphere.h", "sightings.h", "submap.h",
        "submap_fields.h", "submap_outline.h", "submap_part.h", "upper_side.h", "voxel_answer.h"}},
      {"mapping/free", {"free_space.h", "free_tile.h"}},
      {"mapping/map",
       {"edit_entry.h", "history_id.h", "kept_clear.h", "lost_revisions.h", "map.h", "map_config.h", "map_grid.h",
        "merged_ids.h", "object_pairs.h", "region.h", "same_state.h", "session_marks.h", "vacated_space.h"}},
      {"mapping/changes", {"map_change.h", "state_delta.h", "state_marks.h"}},
      {"mapping/images", {"jpeg.h", "png.h", "tiff.h"}},
      {"mapping/loaded", {"cloud_files.h"}},
      {"mapping/sensor",
       {"frame.h", "frame_reach.h", "hidden_things.h", "image_codec.h", "image_header.h", "lidar_projection.h",
        "pinhole_camera.h"}},
      {"mapping/fusion",
       {"band_size.h", "bundler.h", "grid_ray.h", "integrator.h", "kept_clear_points.h", "kept_clear_voxels.h",
        "voxel_journal.h", "segment_bundles.h", "segment_parts.h"}},
      {"mapping/space", {"free_space_finder.h", "presence.h"}},
      {"mapping/plausibility", {"frame_check.h", "frame_judge.h"}},
      {"mapping/tracking", {"activity.h", "overlap_table.h", "tracker.h", "visibility.h"}},
      {"mapping/crf", {"dense_crf.h", "label_channels.h"}},
      {"mapping/evidence",
       {"known_instances.h", "label_management.h", "refinement_region.h", "stray_voxels.h", "submap_labels.h",
        "voxel_handover.h"}},
      {"mapping/refinement", {"adopt_refinement.h", "refine_map.h", "refinement_round.h"}},
      {"mapping/objects",
       {"apart_things.h", "apply_delta.h", "clear_region.h", "merge_submaps.h", "object_care.h", "pair_evidence.h",
        "split_submap.h"}},
      {"mapping/geometry",
       {"body.h", "body_triangle.h", "box_tree.h", "field_normals.h", "moving_sphere.h", "point_order.h",
        "surface_rim.h", "triangle_packet.h", "triangle_tree.h"}},
      {"mapping/surfaces",
       {"find_field_cell.h", "index_trail.h", "look_into_cell.h", "nearest_search.h", "object_shape.h",
        "submap_index.h", "surface_cache.h", "thing_inside.h"}},
      {"mapping/query",
       {"body_query.h", "distance_query.h", "occupancy_slice.h", "point_lookup.h", "ray_query.h", "relations.h",
        "submap_search.h", "touch_lists.h", "trajectory_query.h", "work_budget.h"}},
      {"mapping/mesh",
       {"map_mesh.h", "mesh.h", "mesh_sources.h", "mesh_stream.h", "object_meshes.h", "tile_surface.h"}},
      {"mapping/io", {"glb.h", "occupancy_image.h", "pcd.h", "ply.h"}},
      {"mapping/pipeline", {"map_builder.h", "refinement_slots.h"}},
      {"storage", {"auth_tables.h", "fleet.h", "postgres_store.h", "sqlite_store.h", "store.h"}},
      {"server/net",
       {"address.h", "door.h", "frame_reader.h", "listening.h", "peer_identity.h", "refusal.h", "reserve_descriptor.h",
        "socket_names.h", "tls_context.h", "tls_watch.h"}},
  };
  return front;
}

/// Third-party headers, and the paths below which alone they may be included.
struct Fence {
  std::string header;
  std::vector<std::string> allowed;
  bool in_headers;  ///< whether our headers there may include it too
};
const std::vector<Fence>& Fences() {
  static const std::vector<Fence> fences = {
      {"sqlite3\\.h", {"storage/sqlite"}, false},
      {"libpq-fe\\.h", {"storage/postgres"}, false},
      {"grpcpp/|grpc/|dhpmap/v1/.*grpc\\.pb\\.h",
       {"server/grpc", "server/gateway", "server/main.cc", "clients/cli", "clients/cpp/calls", "clients/cpp/src",
        "tests"},
       true},
      {"dhpmap/v1/",
       {"proto/types", "server/auth", "server/base", "server/wire", "server/grpc", "server/gateway", "server/main.cc",
        "clients/cli", "clients/cpp/calls", "clients/cpp/src", "tests"},
       true},
      {"google/",
       {"proto/types", "server/auth", "server/base", "server/wire", "server/grpc", "server/json", "server/gateway",
        "server/main.cc", "clients/cli", "clients/cpp/calls", "clients/cpp/src", "tests"},
       true},
      {"ompl/", {"clients/cpp/ompl", "clients/cpp/examples", "tests"}, true},
      {"spng\\.h|tiffio\\.h|turbojpeg\\.h", {"mapping/images", "tests"}, false},
      {"opencv2/", {"clients/simulator", "clients/evaluator", "tests"}, false},
      {"nanoflann", {"clients/evaluator"}, false},
      {"pcl/", {"mapping/loaded", "tests"}, false},
      {"boost/", {"server/http", "tests"}, false},
      {"openssl/", {"clients/cli/doctor", "server/auth/keys", "server/net", "tests"}, false},
      {"yaml-cpp/", {"server/config", "tests"}, false},
      {"spdlog/", {"server/log"}, false},
      {"prometheus/", {"server/metrics"}, false},
      // Everywhere else a mutex is that of mutex.h, which says what it guards.
      {"(mutex|shared_mutex|condition_variable)$", {"mapping/base/mutex.h", "tests"}, true},
  };
  return fences;
}

struct Include {
  std::string file;  ///< relative to the repository
  int line;
  std::string path;
};

const std::vector<Include>& AllIncludes() {
  static const std::vector<Include> includes = [] {
    std::vector<Include> found;
    const fs::path root = testing::SourceDir();
    const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
    for (const char* top : {"mapping", "storage", "proto", "server", "clients", "tests"}) {
      for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".h" && extension != ".cc") continue;
        std::ifstream in(entry.path());
        std::string text;
        for (int line = 1; std::getline(in, text); ++line) {
          std::smatch match;
          if (std::regex_search(text, match, pattern)) {
            found.push_back({fs::relative(entry.path(), root).string(), line, match[1].str()});
          }
        }
      }
    }
    return found;
  }();
  return includes;
}

bool IsBelow(const std::string& path, const std::string& room) {
  return path == room ||
         (path.size() > room.size() && path.compare(0, room.size(), room) == 0 && path[room.size()] == '/');
}

std::optional<std::string> RoomOf(const std::string& path) {
  std::optional<std::string> best;
  for (const auto& [room, allowed] : Arrows()) {
    if (IsBelow(path, room) && (!best || room.size() > best->size())) best = room;
  }
  return best;
}

TEST(Architecture, RoomsIncludeOnlyWhereTheirArrowsPoint) {
  for (const Include& include : AllIncludes()) {
    const std::optional<std::string> from = RoomOf(include.file);
    if (!from ||
        !(IsBelow(include.path, "mapping") || IsBelow(include.path, "storage") || IsBelow(include.path, "proto") ||
          IsBelow(include.path, "server") || IsBelow(include.path, "clients") || IsBelow(include.path, "tests"))) {
      continue;
    }
    const auto& allowed = Arrows().at(*from);
    const bool is_allowed = IsBelow(include.path, *from) ||
                            std::any_of(allowed.begin(), allowed.end(),
                                        [&](const std::string& room) { return IsBelow(include.path, room); });
    EXPECT_TRUE(is_allowed) << include.file << ":" << include.line << " includes " << include.path;
  }
}

bool MaySeeInside(const std::string& file, const std::string& room) {
  return IsBelow(file, room) || IsBelow(file, "tests/unit/" + room) || IsBelow(file, "tests/bench") ||
         IsBelow(file, "tests/fuzz");
}

TEST(Architecture, InnerHeadersStayInTheirRooms) {
  for (const Include& include : AllIncludes()) {
    const std::optional<std::string> room = RoomOf(include.path);
    if (!room || !FrontHeaders().contains(*room) || MaySeeInside(include.file, *room)) continue;
    const std::vector<std::string>& front = FrontHeaders().at(*room);
    const std::string header = include.path.substr(room->size() + 1);
    EXPECT_NE(std::find(front.begin(), front.end(), header), front.end())
        << include.file << ":" << include.line << " includes " << include.path << ", which is not a front header";
  }
}

TEST(Architecture, FrontHeadersAreUsedOutside) {
  for (const auto& entry : FrontHeaders()) {
    const std::string& room = entry.first;
    EXPECT_TRUE(Arrows().contains(room)) << room << " is no room";
    for (const std::string& header : entry.second) {
      const std::string path = (fs::path(room) / header).string();
      EXPECT_TRUE(std::any_of(
          AllIncludes().begin(), AllIncludes().end(),
          [&](const Include& include) { return include.path == path && !MaySeeInside(include.file, room); }))
          << path << " is used by its own room alone: an inner header";
    }
  }
}

TEST(Architecture, ThirdPartyHeadersStayInTheirRooms) {
  for (const Fence& fence : Fences()) {
    const std::regex pattern("^(" + fence.header + ")");
    for (const Include& include : AllIncludes()) {
      if (!std::regex_search(include.path, pattern)) continue;
      const bool is_inside = std::any_of(fence.allowed.begin(), fence.allowed.end(),
                                         [&](const std::string& path) { return IsBelow(include.file, path); });
      EXPECT_TRUE(is_inside) << include.file << ":" << include.line << " includes " << include.path;
      const bool is_header = include.file.size() > 2 && include.file.compare(include.file.size() - 2, 2, ".h") == 0;
      if (is_header && !IsBelow(include.file, "tests")) {
        EXPECT_TRUE(fence.in_headers) << "header " << include.file << ":" << include.line << " includes "
                                      << include.path;
      }
    }
  }
}

/// Who includes them needs neither protobuf nor gRPC, nor anything else of ours.
TEST(Architecture, HeadersOfTheCppClientIncludeTheStandardLibraryAndEachOther) {
  const std::regex standard("[a-z_]+"), own("dhpmap/[a-z_]+\\.h"), with_ompl("(dhpmap/)?ompl/.*\\.h");
  int num_looked_at = 0;
  for (const Include& include : AllIncludes()) {
    const bool is_ompl = IsBelow(include.file, "clients/cpp/ompl/include");
    if (!is_ompl && !IsBelow(include.file, "clients/cpp/include")) continue;
    ++num_looked_at;
    EXPECT_TRUE(std::regex_match(include.path, standard) || std::regex_match(include.path, own) ||
                (is_ompl && std::regex_match(include.path, with_ompl)))
        << include.file << ":" << include.line << " includes " << include.path;
  }
  EXPECT_GT(num_looked_at, 30);
}

TEST(Architecture, NoFileIsNamedForNothing) {
  const std::regex empty_name("^(utils?|common|helpers?|misc)$");
  const fs::path root = testing::SourceDir();
  for (const char* top : {"mapping", "storage", "server", "clients", "tests", "proto", "deploy"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().string().find("/node_modules/") != std::string::npos) continue;  // others' files, not committed
      EXPECT_FALSE(std::regex_match(entry.path().stem().string(), empty_name)) << entry.path();
    }
  }
}

/// What the system's clock says may change by a year at any moment: it is for stamps that people read, and for days on
/// which keys end.
TEST(Architecture, OnlyStampsAreOfTheSystemsClock) {
  const std::vector<std::string> stamps = {"server/app/open_map/open_map.cc", "server/app/maps/map_registry.cc",
                                           "server/auth/keys/utc_text.cc", "server/grpc/server_service.cc",
                                           "server/record/map_recorder.cc"};
  const fs::path root = testing::SourceDir();
  for (const char* top : {"mapping", "storage", "proto", "server"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cc") continue;
      const std::string file = fs::relative(entry.path(), root).string();
      if (std::find(stamps.begin(), stamps.end(), file) != stamps.end()) continue;
      std::ifstream in(entry.path());
      const std::string text(std::istreambuf_iterator<char>(in), {});
      EXPECT_EQ(text.find("system_clock"), std::string::npos) << file << ": what takes time is by a steady clock";
    }
  }
}

TEST(Architecture, NoSourceIsLongerThan500Lines) {
  const fs::path root = testing::SourceDir();
  for (const char* top : {"mapping", "storage", "proto", "server", "clients", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cc") continue;
      std::ifstream in(entry.path());
      EXPECT_LE(std::count(std::istreambuf_iterator<char>(in), {}, '\n'), 500) << entry.path();
    }
  }
}

}  // namespace
}  // namespace dhpmap
