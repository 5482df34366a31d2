// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <string>
#include <vector>

#include "google/rpc/error_details.pb.h"
#include "tests/integration/test_server.h"
#include "tests/integration/test_store.h"
#include "tests/support/status_reason.h"

namespace dhpmap::testing {
namespace {

/// A mapped room with a copy of its ball.
class ApplyEditsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(server.Call(&MapStub::CreateMap, CreateRequest("room")));
    ASSERT_OK(Feed(server, "room", 0, 12));
    for (const v1::Submap& submap : List()) {
      if (submap.class_id() == 1) ball = submap.name();
      if (submap.class_id() == 2) box = submap.name();
      if (submap.class_id() == 3) floor = submap.name();
    }
    ASSERT_FALSE(ball.empty() || box.empty() || floor.empty());
  }

  std::vector<v1::Submap> List() {
    const auto response = server.Call(&SubmapStub::ListSubmaps, "maps/room").value();
    return {response.submaps().begin(), response.submaps().end()};
  }
  std::int64_t Revision() { return (*store->LoadMap("room"))->revision(); }

  v1::ApplyEditsResponse Apply(v1::ApplyEditsRequest request) {
    if (request.map().empty()) request.set_map("maps/room");
    return server.Call(&EditStub::ApplyEdits, request).KeepStatus(status);
  }
  static v1::Edit& Add(v1::ApplyEditsRequest& request, const std::string& submap) {
    v1::Edit& edit = *request.add_edits();
    edit.set_submap(submap);
    return edit;
  }
  /// Clones the ball, splits the clone across its middle and names the cut-off half.
  v1::ApplyEditsRequest CloneAndSplit() {
    v1::ApplyEditsRequest request;
    Add(request, ball).mutable_clone()->mutable_map_from_submap()->mutable_translation_m()->set_y(4);
    v1::Plane& plane = *Add(request, "#0").mutable_split()->mutable_plane();
    plane.mutable_normal()->set_x(1);
    Add(request, "#1").mutable_rename()->set_display_name("half");
    return request;
  }

  std::unique_ptr<MapStore> store = MakeTestStore();
  TestServer server{*store};
  grpc::Status status;
  std::string ball, box, floor;
};

TEST_F(ApplyEditsTest, AListOfEditsIsStoredAsOneRevision) {
  const std::int64_t before = Revision();
  const std::size_t num_submaps = List().size();
  const v1::ApplyEditsResponse response = Apply(CloneAndSplit());
  ASSERT_OK(status);
  EXPECT_EQ(response.revision(), before + 1);
  EXPECT_EQ(Revision(), before + 1);
  ASSERT_EQ(response.results_size(), 3);
  ASSERT_EQ(response.results(1).created_submaps_size(), 1);
  EXPECT_GT(response.results(1).num_voxels(), 10);
  EXPECT_EQ(List().size(), num_submaps + 2);
  ASSERT_OK_AND_ASSIGN(const auto half, server.Call(&SubmapStub::GetSubmap, response.results(1).created_submaps(0)));
  EXPECT_EQ(half.submap().display_name(), "half");
  EXPECT_GT(half.submap().bounding_sphere().center_m().y(), 3) << "the copy was moved before it was split";
  EXPECT_GT(half.submap().bounding_sphere().center_m().x(), 0);
}

TEST_F(ApplyEditsTest, AFailedListOfEditsChangesNothing) {
  const std::int64_t before = Revision();
  v1::ApplyEditsRequest request = CloneAndSplit();
  Add(request, "maps/room/submaps/999").mutable_delete_();
  Apply(request);
  EXPECT_EQ(status.error_code(), grpc::NOT_FOUND);
  EXPECT_TRUE(status.error_message().starts_with("edits[3]: ")) << status.error_message();
  EXPECT_EQ(Revision(), before);
  const v1::ApplyEditsResponse after = Apply(CloneAndSplit());
  EXPECT_EQ(after.revision(), before + 1);
}

TEST_F(ApplyEditsTest, ATrialAnswersLikeTheEditAndChangesNothing) {
  const std::int64_t before = Revision();
  v1::ApplyEditsRequest request = CloneAndSplit();
  request.set_validate_only(true);
  const v1::ApplyEditsResponse tried = Apply(request);
  ASSERT_OK(status);
  EXPECT_EQ(tried.revision(), before);
  EXPECT_EQ(Revision(), before);
  request.set_validate_only(false);
  v1::ApplyEditsResponse made = Apply(request);
  EXPECT_EQ(made.revision(), before + 1);
  ASSERT_EQ(tried.results_size(), made.results_size());
  for (int i = 0; i < made.results_size(); ++i) {
    EXPECT_EQ(tried.results(i).SerializeAsString(), made.results(i).SerializeAsString());
  }
}

TEST_F(ApplyEditsTest, TheSecondOfTwoConcurrentEditsIsAborted) {
  const std::int64_t known = Revision();
  std::vector<std::future<grpc::Status>> answers;
  for (int i = 0; i < 2; ++i) {
    answers.push_back(std::async(std::launch::async, [&, i] {
      v1::ApplyEditsRequest request;
      request.set_map("maps/room");
      request.set_expected_revision(known);
      Add(request, ball).mutable_rename()->set_display_name("of " + std::to_string(i));
      return server.Call(&EditStub::ApplyEdits, request).status();
    }));
  }
  const grpc::Status first = answers[0].get(), second = answers[1].get();
  EXPECT_NE(first.ok(), second.ok());
  EXPECT_EQ(ReasonOf(first.ok() ? second : first), "EDITED_SINCE");
}

TEST_F(ApplyEditsTest, FramesDoNotCountAsEdits) {
  const std::int64_t known = Revision();
  ASSERT_OK(Feed(server, "room", 12, 24));
  v1::ApplyEditsRequest request;
  request.set_expected_revision(known);
  Add(request, ball).mutable_rename()->set_display_name("still the ball");
  Apply(request);
  EXPECT_OK(status);
}

TEST_F(ApplyEditsTest, AClearedRegionIsUnknownUntilItIsObservedAgain) {
  v1::ApplyEditsRequest request;
  v1::Edit& edit = *request.add_edits();
  edit.mutable_clear()->mutable_sphere()->set_radius_m(50);
  const v1::ApplyEditsResponse cleared = Apply(request);
  ASSERT_OK(status);
  EXPECT_GE(cleared.results(0).removed_submaps_size(), 3);
  EXPECT_EQ(List().size(), 1u) << "the unknown submap stays";
  ASSERT_OK(Feed(server, "room", 0, 24));
  EXPECT_GE(List().size(), 4u);
}

TEST_F(ApplyEditsTest, ALockedObjectChangesOnlyItsLastSeenTime) {
  v1::ApplyEditsRequest request;
  Add(request, ball).mutable_lock();
  Apply(request);
  ASSERT_OK(status);
  const auto of_ball = [this] {
    for (const v1::Submap& submap : List()) {
      if (submap.name() == ball) return submap;
    }
    return v1::Submap();
  };
  v1::Submap before = of_ball();
  EXPECT_TRUE(before.locked());
  const std::size_t num_submaps = List().size();
  ASSERT_OK(Feed(server, "room", 12, 24));
  v1::Submap after = of_ball();
  EXPECT_GT(after.last_observed_stamp_ns(), before.last_observed_stamp_ns());
  EXPECT_EQ(List().size(), num_submaps);
  for (v1::Submap* submap : {&before, &after}) {
    submap->clear_last_observed_stamp_ns();
    submap->clear_revision();
    submap->clear_etag();
  }
  EXPECT_EQ(after.SerializeAsString(), before.SerializeAsString());

  v1::ApplyEditsRequest unlock;
  Add(unlock, ball).mutable_unlock();
  Apply(unlock);
  ASSERT_OK(Feed(server, "room", 24, 30));
  EXPECT_GT(of_ball().num_frames_observed(), before.num_frames_observed());
  ASSERT_OK_AND_ASSIGN(const auto logged, server.Call(&EditStub::ListEdits, "maps/room"));
  ASSERT_EQ(logged.edits_size(), 2);
  EXPECT_EQ(logged.edits(0).steps(0).action(), v1::LoggedEdit::UNLOCK);
  EXPECT_EQ(logged.edits(1).steps(0).action(), v1::LoggedEdit::LOCK);
}

v1::Vector3 MiddleOf(const v1::Submap& submap) { return submap.oriented_box().pose().translation_m(); }
double LowSideOf(const v1::Submap& submap) { return MiddleOf(submap).z() - submap.oriented_box().size_m().z() / 2; }

TEST_F(ApplyEditsTest, AnObjectIsTurnedShiftedAndPlacedAndUndoMovesItBack) {
  const auto get = [this](const std::string& name) {
    return server.Call(&SubmapStub::GetSubmap, name).value().submap();
  };
  const v1::Submap before = get(box), ball_before = get(ball);
  ASSERT_TRUE(before.has_oriented_box());
  v1::ApplyEditsRequest request;
  Add(request, box).mutable_turn()->set_angle_rad(0.5);
  Add(request, box).mutable_translate()->mutable_offset_m()->set_z(1);
  Apply(request);
  ASSERT_OK(status);
  const v1::Submap after = get(box);
  EXPECT_NEAR(MiddleOf(after).x(), MiddleOf(before).x(), 1e-6);
  EXPECT_NEAR(MiddleOf(after).y(), MiddleOf(before).y(), 1e-6);
  EXPECT_NEAR(MiddleOf(after).z(), MiddleOf(before).z() + 1, 1e-6);
  EXPECT_NEAR(after.support_height_m(), before.support_height_m() + 1, 1e-6);

  v1::ApplyEditsRequest place;
  Add(place, ball).mutable_place()->set_support(box);
  Apply(place);
  ASSERT_OK(status);
  EXPECT_NEAR(LowSideOf(get(ball)), after.support_height_m(), 1e-6);

  ASSERT_OK_AND_ASSIGN(const auto logged, server.Call(&EditStub::ListEdits, "maps/room"));
  ASSERT_EQ(logged.edits_size(), 2);
  ASSERT_EQ(logged.edits(1).steps_size(), 2);
  EXPECT_EQ(logged.edits(1).steps(1).action(), v1::LoggedEdit::MOVE);
  EXPECT_EQ(logged.edits(1).steps(1).submap(), box);
  v1::UndoEditsRequest undo;
  undo.set_map("maps/room");
  undo.set_count(2);
  ASSERT_OK(server.Call(&EditStub::UndoEdits, undo));
  EXPECT_EQ(get(box).oriented_box().SerializeAsString(), before.oriented_box().SerializeAsString());
  EXPECT_EQ(get(ball).oriented_box().SerializeAsString(), ball_before.oriented_box().SerializeAsString());
}

TEST_F(ApplyEditsTest, AMoveWithoutATargetIsRefusedWithEveryField) {
  v1::ApplyEditsRequest request;
  Add(request, box).mutable_turn()->set_angle_rad(std::nan(""));
  Add(request, box).mutable_translate();
  Add(request, box).mutable_place();
  v1::PlaceEdit& place = *Add(request, box).mutable_place();
  place.set_support("maps/other/submaps/1");
  place.mutable_point_m()->set_x(std::numeric_limits<double>::infinity());
  Apply(request);
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  for (const char* field : {"edits[0].turn.angle_rad", "edits[1].translate.offset_m", "edits[2].place.support",
                            "edits[3].place.support", "edits[3].place.point_m"}) {
    EXPECT_NE(status.error_details().find(field), std::string::npos) << field;
  }
}

TEST_F(ApplyEditsTest, ATrialOfAPlacementReturnsThePoseAndChangesNothing) {
  const std::int64_t before = Revision();
  v1::ApplyEditsRequest request;
  Add(request, ball).mutable_clone();
  Add(request, "#0").mutable_place()->set_support(box);
  request.set_validate_only(true);
  const v1::ApplyEditsResponse tried = Apply(request);
  ASSERT_OK(status);
  ASSERT_EQ(tried.results_size(), 2);
  EXPECT_EQ(tried.results(1).changed_submaps(0), tried.results(0).created_submaps(0));
  EXPECT_EQ(Revision(), before);
}

TEST_F(ApplyEditsTest, AClearedIgnoredRegionStaysEmptyUntilItIsRemoved) {
  v1::ApplyEditsRequest request;
  v1::ClearEdit& clear = *request.add_edits()->mutable_clear();
  clear.mutable_sphere()->set_radius_m(50);
  clear.set_ignored_region_name("hall");
  Apply(request);
  ASSERT_OK(status);
  ASSERT_OK(Feed(server, "room", 12, 24));
  EXPECT_EQ(List().size(), 1u) << "the unknown submap";
  const auto kept = [this] { return server.Call(&EditStub::ListIgnoredRegions, "maps/room").value(); };
  ASSERT_EQ(kept().ignored_regions_size(), 1);
  EXPECT_EQ(kept().ignored_regions(0).name(), "hall");
  EXPECT_EQ(kept().ignored_regions(0).sphere().radius_m(), 50);
  EXPECT_EQ((*store->LoadMap("room"))->info().kept_clear.list().size(), 1u);
  EXPECT_EQ(kept().revision(), Revision());

  v1::ApplyEditsRequest again;
  again.add_edits()->mutable_ignore_region()->set_name("hall");
  again.mutable_edits(0)->mutable_ignore_region()->mutable_box()->mutable_max_m()->set_x(1);
  Apply(again);
  EXPECT_EQ(status.error_code(), grpc::ALREADY_EXISTS);
  EXPECT_EQ(ReasonOf(status), "IGNORED_REGION_EXISTS");
  v1::ApplyEditsRequest lift;
  lift.add_edits()->mutable_unignore_region()->set_name("hall");
  Apply(lift);
  ASSERT_OK(status);
  Apply(lift);
  EXPECT_EQ(ReasonOf(status), "IGNORED_REGION_NOT_FOUND");
  EXPECT_EQ(kept().ignored_regions_size(), 0);
  ASSERT_OK(Feed(server, "room", 24, 40));
  EXPECT_GE(List().size(), 4u);
}

TEST_F(ApplyEditsTest, AllInvalidFieldsAreNamedTogether) {
  v1::ApplyEditsRequest request;
  Add(request, ball);
  Add(request, "#x").mutable_delete_();
  Add(request, "maps/other/submaps/1").mutable_delete_();
  Add(request, ball).mutable_split()->mutable_plane();
  Add(request, ball).mutable_merge();
  Add(request, ball).mutable_relabel();
  request.add_edits()->mutable_clear()->add_class_names("unicorn");
  request.add_edits()->mutable_delete_();
  Add(request, ball).mutable_move()->mutable_map_from_submap()->mutable_translation_m()->set_x(std::nan(""));
  Apply(request);
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);
  EXPECT_EQ(ReasonOf(status), "BAD_EDIT");
  const auto bad = DetailOf<google::rpc::BadRequest>(status);
  std::string fields;
  for (const auto& violation : bad.field_violations()) fields += violation.field() + " ";
  for (const char* field : {"edits[0].edit ", "edits[1].submap ", "edits[2].submap ", "edits[3].split.plane.normal ",
                            "edits[4].merge.merged_submaps ", "edits[5].relabel ", "edits[6].clear ",
                            "edits[6].clear.class_names ", "edits[7].submap ", "edits[8].move.map_from_submap"}) {
    EXPECT_NE(fields.find(field), std::string::npos) << field << " is not in " << fields;
  }
}

TEST_F(ApplyEditsTest, AListRestoresADeletedObjectAndEditsIt) {
  v1::ApplyEditsRequest gone;
  Add(gone, ball).mutable_delete_();
  Apply(gone);
  ASSERT_OK(status);
  v1::ApplyEditsRequest back;
  Add(back, ball).mutable_undelete();
  Add(back, ball).mutable_rename()->set_display_name("the ball again");
  back.set_validate_only(true);
  Apply(back);
  EXPECT_OK(status);
  back.set_validate_only(false);
  const std::int64_t before = Revision();
  const v1::ApplyEditsResponse response = Apply(back);
  ASSERT_OK(status);
  EXPECT_EQ(response.revision(), before + 1);
  ASSERT_EQ(response.results(0).created_submaps_size(), 1);
  EXPECT_EQ(response.results(0).created_submaps(0), ball);
  const auto list = List();
  EXPECT_TRUE(std::any_of(list.begin(), list.end(), [this](const v1::Submap& submap) {
    return submap.name() == ball && submap.display_name() == "the ball again";
  }));
  Apply(back);
  EXPECT_EQ(ReasonOf(status), "NOTHING_TO_UNDO") << "it is there";
  EXPECT_TRUE(status.error_message().starts_with("edits[0]: ")) << status.error_message();
  v1::ApplyEditsRequest at_once;
  Add(at_once, ball).mutable_delete_();
  Add(at_once, ball).mutable_undelete();
  Apply(at_once);
  EXPECT_EQ(ReasonOf(status), "SUBMAP_NOT_FOUND") << "not as it was when it was deleted before";
  ASSERT_OK_AND_ASSIGN(const auto undone, server.Call(&EditStub::UndoEdits, "maps/room"));
  ASSERT_EQ(undone.removed_submaps_size(), 1);
  EXPECT_EQ(undone.removed_submaps(0), ball);
}

TEST_F(ApplyEditsTest, TooManyEditsAreRefused) {
  v1::ApplyEditsRequest request;
  Apply(request);
  EXPECT_EQ(ReasonOf(status), "BAD_EDIT");
  for (int i = 0; i < 1001; ++i) Add(request, ball).mutable_rename()->set_display_name("n");
  Apply(request);
  EXPECT_EQ(ReasonOf(status), "BAD_EDIT");
  request.mutable_edits()->RemoveLast();
  Apply(request);
  EXPECT_OK(status);
}

TEST_F(ApplyEditsTest, ABackgroundIsSplitIntoThingsAndUndoRestoresIt) {
  v1::ApplyEditsRequest request;
  v1::SplitEdit& split = *Add(request, floor).mutable_split();
  split.mutable_plane()->mutable_normal()->set_x(1);
  Apply(request);
  EXPECT_EQ(status.error_code(), grpc::FAILED_PRECONDITION);
  EXPECT_EQ(ReasonOf(status), "NOT_A_THING");
  ASSERT_OK_AND_ASSIGN(const auto background, server.Call(&SubmapStub::GetSubmap, floor));
  split.set_class_name(background.submap().class_name());
  Apply(request);
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT) << "a class of stuff";
  split.set_class_name("no such class");
  Apply(request);
  EXPECT_EQ(status.error_code(), grpc::INVALID_ARGUMENT);

  ASSERT_OK_AND_ASSIGN(const auto of_ball, server.Call(&SubmapStub::GetSubmap, ball));
  const std::size_t num_submaps = List().size();
  split.set_class_name(of_ball.submap().class_name());
  const v1::ApplyEditsResponse response = Apply(request);
  ASSERT_OK(status);
  ASSERT_EQ(response.results(0).created_submaps_size(), 1);
  ASSERT_OK_AND_ASSIGN(const auto part, server.Call(&SubmapStub::GetSubmap, response.results(0).created_submaps(0)));
  EXPECT_EQ(part.submap().kind(), v1::LabelClass::THING);
  EXPECT_EQ(part.submap().class_name(), of_ball.submap().class_name());
  EXPECT_EQ(List().size(), num_submaps + 1);

  ASSERT_OK(server.Call(&EditStub::UndoEdits, "maps/room").status());
  EXPECT_EQ(List().size(), num_submaps);
  ASSERT_OK_AND_ASSIGN(const auto again, server.Call(&SubmapStub::GetSubmap, floor));
  EXPECT_EQ(again.submap().num_blocks(), background.submap().num_blocks());
}

}  // namespace
}  // namespace dhpmap::testing
