// SPDX-License-Identifier: BSD-3-Clause
// Edits between frames are recorded with them and made again in a replay.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clients/cli/replay_edits.h"
#include "clients/cli/replay_streams.h"
#include "proto/types/record_file.h"
#include "server/record/map_recorder.h"
#include "tests/integration/test_server.h"
#include "tests/support/map_equality.h"

namespace dhpmap::testing {
namespace {

class RecordedEdits : public ::testing::Test {
 protected:
  /// A server for which every frame is a revision and refinements are applied at fixed frames.
  std::unique_ptr<TestServer> MakeServer(MapStore& store, const std::string& map_id, bool records) {
    OpenMapOptions options{.mapping = {.num_threads = 1, .refinement_timing = RefinementTiming::kReproducible},
                           .publish = {.frames = 1}};
    if (records) {
      options.make_recorder = [this](const MapInfo& map) {
        return RecordMap(map, *records_, {.is_reproducible = true, .now_ns = {}, .on_stopped = {}});
      };
    }
    auto server = std::make_unique<TestServer>(store, std::move(options));
    auto request = CreateRequest(map_id);
    request.mutable_config()->mutable_refinement()->set_every_frames(5);
    EXPECT_OK(server->Call(&MapStub::CreateMap, request));
    return server;
  }
  static std::shared_ptr<const MapSnapshot> Now(TestServer& server, const std::string& map_id) {
    return (*server.registry().GetOpen(map_id))->View()->shared_snapshot();
  }
  [[nodiscard]] RecordReader Reader() const {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "records")) {
      files.push_back(entry.path());
    }
    EXPECT_EQ(files.size(), 1u);
    return std::move(RecordReader::Open(files.at(0))).value();
  }

  /// Feeds frames, with edits by every kind of request before, between and after them.
  std::shared_ptr<const MapSnapshot> MapAndEdit() {
    const auto store = MakeMemoryStore();
    const auto server = MakeServer(*store, "room", true);
    v1::ApplyEditsRequest keep;
    keep.set_map("maps/room");
    keep.add_edits()->mutable_ignore_region()->set_name("corner");
    keep.mutable_edits(0)->mutable_ignore_region()->mutable_sphere()->mutable_center_m()->set_x(1.5);
    keep.mutable_edits(0)->mutable_ignore_region()->mutable_sphere()->set_radius_m(0.5);
    Make(*server, &EditStub::ApplyEdits, keep);  // before the record begins
    EXPECT_OK(Feed(*server, "room", 0, 8));

    std::string thing;
    for (const auto& submap : Now(*server, "room")->submaps()) {
      if (submap->info().panoptic == Panoptic::kThing)
        thing = "maps/room/submaps/" + std::to_string(submap->id().value);
    }
    v1::UpdateSubmapRequest rename;
    rename.mutable_submap()->set_name(thing);
    rename.mutable_submap()->set_display_name("of anna");
    rename.mutable_update_mask()->add_paths("display_name");
    rename.set_author("anna");
    rename.set_expected_revision(Now(*server, "room")->revision());
    rename.set_request_id("00000000-0000-4000-8000-000000000001");
    const std::int64_t renamed = Make(*server, &SubmapStub::UpdateSubmap, rename);
    Make(*server, &SubmapStub::UpdateSubmap, rename);  // a retry, which is not a second edit
    rename.set_validate_only(true);
    rename.clear_expected_revision();
    Make(*server, &SubmapStub::UpdateSubmap, rename);  // nor is this one
    v1::CloneSubmapRequest clone;
    clone.set_name(thing);
    clone.mutable_map_from_submap()->mutable_translation_m()->set_z(2);
    Make(*server, &SubmapStub::CloneSubmap, clone);
    EXPECT_OK(Feed(*server, "room", 8, 12));

    v1::UndoEditsRequest undo;
    undo.set_map("maps/room");
    undo.set_edit("maps/room/edits/" + std::to_string(renamed));
    Make(*server, &EditStub::UndoEdits, undo);
    v1::RedoEditsRequest redo;
    redo.set_map("maps/room");
    redo.set_edit(undo.edit());
    Make(*server, &EditStub::RedoEdits, redo);
    v1::DeleteSubmapRequest gone;
    gone.set_name(thing);
    Make(*server, &SubmapStub::DeleteSubmap, gone);
    v1::UndeleteSubmapRequest back;
    back.set_name(thing);
    Make(*server, &SubmapStub::UndeleteSubmap, back);
    v1::ApplyEditsRequest lift;
    lift.set_map("maps/room");
    lift.add_edits()->mutable_unignore_region()->set_name("corner");
    Make(*server, &EditStub::ApplyEdits, lift);
    v1::UpdateMapRequest title;
    title.mutable_map()->set_name("maps/room");
    title.mutable_map()->set_display_name("the room");
    title.mutable_update_mask()->add_paths("display_name");
    const std::int64_t titled = Make(*server, &MapStub::UpdateMap, title);
    Make(*server, &SubmapStub::CloneSubmap, clone);
    v1::RestoreRevisionRequest restore;
    restore.set_map("maps/room");
    restore.set_revision(titled);  // a revision that an edit has made
    Make(*server, &EditStub::RestoreRevision, restore);
    restore.set_revision(renamed - 1);  // the revision that an edit was applied to
    restore.set_submap(thing);
    Make(*server, &EditStub::RestoreRevision, restore);
    EXPECT_OK(Feed(*server, "room", 12, 16));
    auto state = Now(*server, "room");
    EXPECT_OK(server->Stop());
    return state;
  }
  template <typename Stub, typename Request, typename Response>
  static std::int64_t Make(TestServer& server, Client::Unary<Stub, Request, Response> method, const Request& request) {
    return server.Call(method, request).value().revision();
  }

  /// Feeds the record into an existing map and makes its edits.
  void ReplayInto(TestServer& server, const std::string& map_id) {
    RecordReader reader = Reader();
    ReplayStreams streams(client::Caller::Over(server.channel()), "maps/" + map_id,
                          [](const v1::IntegrateFramesResponse& answer) {
                            EXPECT_EQ(answer.outcome(), v1::IntegrateFramesResponse::FUSED) << answer.error().message();
                          });
    ReplayEdits edits(client::Caller::Over(server.channel()), reader.start().map().name(), "maps/" + map_id);
    EXPECT_OK(edits.KeepClear(reader.start()));
    for (auto record = reader.Next().value(); record; record = reader.Next().value()) {
      if (record->has_frame()) {
        v1::IntegrateFramesRequest frame;
        ASSERT_TRUE(frame.ParseFromString(record->frame().request()));
        ASSERT_OK(streams.Send(record->frame().session(), record->frame().sequence(), frame));
      } else if (record->has_edited()) {
        ASSERT_TRUE(ReplayEdits::Knows(record->edited())) << record->edited().method();
        ASSERT_OK(streams.Drain());
        const client::Status made = edits.Make(record->edited());
        ASSERT_OK(made) << record->edited().method();
        ++num_edits_;
      }
    }
    EXPECT_OK(streams.Close());
  }

  static constexpr int kNumEdits = 11;
  TempDir folder_;
  std::unique_ptr<RecordDir> records_ = RecordDir::Open((folder_.path() / "records").string(), 1 << 30).value();
  int num_edits_ = 0;
};

TEST_F(RecordedEdits, ReplayingARecordMakesTheSameMapWithItsEdits) {
  const auto original = MapAndEdit();
  const auto store = MakeMemoryStore();
  const auto server = MakeServer(*store, "again", false);
  ReplayInto(*server, "again");
  EXPECT_EQ(num_edits_, kNumEdits);
  const auto again = Now(*server, "again");
  EXPECT_TRUE(MapsAreEqual(*original, *again, 0, 0));
  EXPECT_EQ(again->info().display_name, "the room");
  EXPECT_TRUE(again->info().kept_clear == original->info().kept_clear);
  EXPECT_TRUE(again->info().pairs == original->info().pairs);
}

TEST_F(RecordedEdits, AReferencedEditMeansTheOneMadeInTheReplay) {
  const auto original = MapAndEdit();
  const auto store = MakeMemoryStore();
  const auto server = MakeServer(*store, "again", false);
  for (const char* title : {"one", "two", "three"}) {  // so that revisions differ from the recorded ones
    v1::UpdateMapRequest request;
    request.mutable_map()->set_name("maps/again");
    request.mutable_map()->set_display_name(title);
    request.mutable_update_mask()->add_paths("display_name");
    Make(*server, &MapStub::UpdateMap, request);
  }
  ReplayInto(*server, "again");
  EXPECT_EQ(num_edits_, kNumEdits);
  const auto again = Now(*server, "again");
  ASSERT_EQ(again->submaps().size(), original->submaps().size());
  for (std::size_t i = 0; i < original->submaps().size(); ++i) {
    EXPECT_EQ(again->submaps()[i]->info().display_name, original->submaps()[i]->info().display_name);
  }
  EXPECT_EQ(again->revision(), original->revision() + 3);
}

TEST_F(RecordedEdits, AReferenceToAStateOfNoEditIsUnknownInTheReplay) {
  const auto store = MakeMemoryStore();
  const auto server = MakeServer(*store, "again", false);
  v1::RestoreRevisionRequest restore;
  restore.set_map("maps/room");
  restore.set_revision(1);
  v1::RecordedEdit edit;
  edit.set_revision(7);
  edit.set_method("EditService/RestoreRevision");
  edit.set_request(restore.SerializeAsString());
  ASSERT_TRUE(ReplayEdits::Knows(edit));
  ReplayEdits edits(client::Caller::Over(server->channel()), "maps/room", "maps/again");
  EXPECT_EQ(edits.Make(edit).code, client::StatusCode::kFailedPrecondition);
}

TEST_F(RecordedEdits, RecordsOfOlderVersionsAndUnknownRequestsAreNotReplayed) {
  v1::RecordedEdit edit;
  edit.set_revision(7);
  EXPECT_FALSE(ReplayEdits::Knows(edit));
  edit.set_method("EditService/MakeCoffee");
  EXPECT_FALSE(ReplayEdits::Knows(edit));
  edit.set_method("EditService/ApplyEdits");
  EXPECT_TRUE(ReplayEdits::Knows(edit));
}

}  // namespace
}  // namespace dhpmap::testing
