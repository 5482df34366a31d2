// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mapping/paging/tile_spill.h"
#include "server/app/edits/edit_list.h"
#include "server/app/edits/edit_summary.h"
#include "server/app/maps/map_registry.h"
#include "storage/sqlite_store.h"
#include "tests/support/eventually.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/app/open_map_fixture.h"

// A small room, mapped, refined and edited through an open map, on a store that outlives it.

namespace dhpmap::testing {

/// The variable parts of a frame of the room.
struct RoomView {
  int place = 0;                 ///< of kNumPlaces on an arc around the room
  bool has_crate = true;         ///< one of the things; it is sometimes carried away
  bool has_other_class = false;  ///< the network takes the ball for a crate
  auto operator<=>(const RoomView&) const = default;
};
inline constexpr int kNumPlaces = 24;

// Segments; classes 1 to 3 are things, 4 and 5 backgrounds.
inline constexpr std::uint32_t kBall = 1, kCrate = 2, kCrateBeside = 3, kPosts = 4, kGround = 5, kBackWall = 6;

/// A ball, two crates side by side, two posts that are one segment, a floor and a wall.
inline Scene CrowdedRoom(bool has_crate) {
  using Shape = Solid::Shape;
  Scene room{{{Shape::kHalfSpace, {0, 0, 0}, {0, 0, 1}, kGround, {90, 80, 60}},
              {Shape::kHalfSpace, {1.2, 0, 0}, {-1, 0, 0}, kBackWall, {200, 200, 190}},
              {Shape::kSphere, {0.2, -0.7, 0.3}, {0.3, 0, 0}, kBall, {220, 30, 30}},
              {Shape::kBox, {0.1, 0.55, 0.25}, {0.2, 0.15, 0.25}, kCrateBeside, {30, 90, 210}},
              {Shape::kBox, {-0.5, -0.35, 0.3}, {0.1, 0.1, 0.3}, kPosts, {40, 160, 40}},
              {Shape::kBox, {-0.5, 0.75, 0.3}, {0.1, 0.1, 0.3}, kPosts, {40, 160, 40}}}};
  if (has_crate) room.solids.push_back({Shape::kBox, {0.1, 0.25, 0.25}, {0.2, 0.15, 0.25}, kCrate, {30, 60, 210}});
  return room;
}

/// Frames of the room; each is rendered once.
class RoomFrames {
 public:
  PanopticFrame Take(const RoomView& view, bool has_persistent_ids, std::int64_t stamp_ns) {
    auto found = rendered_.find(view);
    if (found == rendered_.end()) found = rendered_.emplace(view, RenderView(view)).first;
    PanopticFrame frame = found->second;
    frame.has_persistent_ids = has_persistent_ids;
    frame.stamp_ns = stamp_ns;
    return frame;
  }

 private:
  static PanopticFrame RenderView(const RoomView& view) {
    const double angle = -1.2 + 2.4 * view.place / kNumPlaces;
    const Eigen::Vector3d eye_m(-2.0 * std::cos(angle), 2.0 * std::sin(angle), 1.3);
    const PinholeCamera camera{.width_px = 80, .height_px = 60, .fx_px = 45, .fy_px = 45, .cx_px = 40, .cy_px = 30};
    PanopticFrame frame = Render(CrowdedRoom(view.has_crate), camera, LookAt(eye_m, {0, 0, 0.2}));
    const std::uint16_t classes[] = {0, 1, 2, 2, 3, 4, 5};
    for (std::uint32_t id = kBall; id <= kBackWall; ++id) {
      const bool is_mistaken = id == kBall && view.has_other_class;
      frame.segments.push_back({.id = SegmentId(id), .class_id = ClassId(is_mistaken ? classes[kCrate] : classes[id])});
    }
    return frame;
  }

  std::map<RoomView, PanopticFrame> rendered_;
};

inline MapInfo EditedRoomInfo() {
  MapInfo info;
  info.name = "room";
  info.label_set = MakeLabelSet(3, 2);
  MapConfig& config = info.config;
  config.voxel_size_m = 0.05;
  config.truncation_m = 0.1;
  config.integration.max_range_m = 4;
  config.tracking.min_points_small = config.tracking.min_points_medium = config.tracking.min_points_large = 20;
  config.tracking.min_points_stuff = 100;
  config.tracking.split_gap_vox = 0;   // so that the posts are one thing
  config.refinement.every_frames = 8;  // a round on the side, step by step
  return info;
}

/// The result of an edit that was made.
struct MadeInRoom {
  std::int64_t revision = 0;
  std::vector<EditResult> results;
};

/// The room in a session whose every frame is seen and whose refinements are taken over at their turn, so that the same
/// calls make the same map. Thread-compatible.
class EditedRoom {
 public:
  enum class Store { kMemory, kSqlite, kPaged };  ///< kPaged: SQLite with as little as possible in memory

  explicit EditedRoom(Store kind) : kind_(kind) {
    if (kind_ == Store::kMemory) store_ = MakeMemoryStore();
    Open();
    if (session_ == nullptr && registry_ != nullptr) {
      EXPECT_TRUE(registry_->Create(EditedRoomInfo()).ok());
      session_ = *registry_->GetOpen("room");
    }
  }

  [[nodiscard]] std::shared_ptr<const MapSnapshot> Now() const { return session_->View()->shared_snapshot(); }
  [[nodiscard]] std::shared_ptr<const MapView> View() const { return session_->View(); }
  /// The server's cache for all states until it restarts.
  [[nodiscard]] SurfaceCache& surfaces() { return registry_->surfaces(); }
  [[nodiscard]] MapStore& store() { return *store_; }

  /// Returns once the frame is visible; with surfaces in use that may be after the answer.
  Status Integrate(const RoomView& view, bool has_persistent_ids) {
    constexpr std::int64_t kFramePeriod_ns = 200'000'000;
    const auto before = Now();
    PanopticFrame frame = frames_.Take(view, has_persistent_ids, ++num_frames_ * kFramePeriod_ns);
    const auto outcome =
        Wait<FrameOutcome>([&](auto done) { session_->Integrate(Result<PanopticFrame>(std::move(frame)), done); });
    if (!outcome.report.ok()) return outcome.report.status();
    const std::int64_t num_frames = before->info().num_frames + 1;
    if (!Eventually([&] { return Now()->info().num_frames >= num_frames; })) return Internal("nobody sees the frame");
    return Status::Ok();
  }
  Status Finish() {
    return Wait<Result<FinishOutcome>>([&](auto done) { session_->Finish(done); }).status();
  }
  Status Flush() {
    return Wait<Status>([&](auto done) { session_->Flush(done); });
  }

  /// The list as one edit of an author.
  Result<MadeInRoom> Make(const EditList& list, const std::string& author) {
    MadeInRoom made;
    const auto change = [&](Map& map) -> Result<EditMade> {
      DHPMAP_ASSIGN_OR_RETURN(made.results, ApplyEdits(list, map));
      return EditMade{.submap = SubmapId(), .summary = SummaryOfList(list, made.results)};
    };
    DHPMAP_ASSIGN_OR_RETURN(made.revision, Edit(change, author));
    return made;
  }
  /// Undoes or redoes; returns the new revision.
  Result<std::int64_t> Undo(UndoRequest request) {
    const std::string author = request.author;
    return Edit(registry_->UndoOf(std::move(request)), author);
  }
  Result<std::int64_t> Undelete(SubmapId id, const std::string& author) {
    return Edit(registry_->UndeletionOf(id), author);
  }

  /// Restores the room to a revision; returns the new revision.
  Result<std::int64_t> Restore(const RestoreRequest& request, const std::string& author) {
    DHPMAP_ASSIGN_OR_RETURN(auto change, registry_->RestorationOf("room", request));
    return Edit(std::move(change), author);
  }

  /// Restarts the server on the same database.
  void Restart() {
    session_ = nullptr;
    EXPECT_TRUE(registry_->Shutdown().ok());
    registry_ = nullptr;
    Open();
  }

 private:
  Result<std::int64_t> Edit(std::function<Result<EditMade>(Map&)> change, const std::string& author) {
    EditRequest request{.change = std::move(change), .source = {.author = author}};
    const auto outcome = Wait<Result<EditOutcome>>([&](auto done) { session_->Edit(std::move(request), done); });
    if (!outcome.ok()) return outcome.status();
    return outcome->view->snapshot().revision();
  }

  void Open() {
    if (kind_ != Store::kMemory) {
      store_ = nullptr;
      auto opened = OpenSqliteStore((folder_.path() / "maps.db").string(), {.pages_tiles = kind_ == Store::kPaged});
      ASSERT_TRUE(opened.ok()) << opened.status().ToString();
      store_ = std::move(opened).value();
    }
    constexpr int kNever = 1'000'000'000;
    OpenMapOptions options;
    options.mapping.num_threads = 1;
    options.publish.frames = 1;
    options.publish.delay_s = 0.01;  // so long a frame may wait for surfaces
    options.commit.delay_s = options.commit.max_behind_s = kNever;
    options.pages.budget_bytes = kind_ == Store::kPaged ? 1 : 0;
    if (kind_ == Store::kPaged) options.pages.spill = OpenTileSpill(folder_.path().string()).value();
    options.mapping.refinement_timing = RefinementTiming::kReproducible;
    options.now_ns = [this] { return ++now_ns_; };
    auto registry = MapRegistry::Open(*store_, std::move(options), {.idle_close_s = 0});
    ASSERT_TRUE(registry.ok()) << registry.status().ToString();
    registry_ = std::move(registry).value();
    if (!store_->GetMap("room").ok()) return;
    auto session = registry_->GetOpen("room");
    ASSERT_TRUE(session.ok()) << session.status().ToString();
    session_ = *session;
  }

  const Store kind_;
  TempDir folder_;
  RoomFrames frames_;
  std::int64_t num_frames_ = 0;
  std::atomic<std::int64_t> now_ns_ = 0;  // outlives the sessions, which ask for it
  std::unique_ptr<MapStore> store_;
  std::unique_ptr<MapRegistry> registry_;
  std::shared_ptr<OpenMap> session_;
};

}  // namespace dhpmap::testing
