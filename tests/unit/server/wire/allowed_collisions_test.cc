// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/allowed_collisions.h"

#include <gtest/gtest.h>

#include <functional>

#include "dhpmap/v1/collision.pb.h"
#include "server/wire/query_options.h"
#include "server/wire/trajectory_conversion.h"

namespace dhpmap {
namespace {

using Ids = std::vector<SubmapId>;

/// Map "home" with the classes chair (1), table (2) and floor (3): chairs 1 and 2, a table 3 and a floor 4.
std::shared_ptr<const MapSnapshot> HomeWithAFloor() {
  MapInfo info;
  info.name = "home";
  info.label_set = std::make_shared<const LabelSet>(*LabelSet::Create(
      {{.id = ClassId(1), .name = "chair"}, {.id = ClassId(2), .name = "table"}, {.id = ClassId(3), .name = "floor"}}));
  Map map(info);
  for (const std::uint16_t class_id : {1, 1, 2, 3}) {
    (void)map.Create({.panoptic = class_id == 3 ? Panoptic::kStuff : Panoptic::kThing,
                      .class_id = ClassId(class_id),
                      .voxel_size_m = 0.05,
                      .truncation_m = 0.1});
  }
  return map.Publish(0);
}

/// A robot of four spheres, body, wheel, wheel and one of no link, that carries chair 1.
v1::CheckTrajectoryRequest Robot() {
  v1::CheckTrajectoryRequest request;
  for (const char* link : {"body", "wheel", "wheel", ""}) {
    request.add_robot();
    request.add_sphere_links(link);
  }
  request.mutable_options()->add_attached()->set_submap("maps/home/submaps/1");
  return request;
}

v1::AllowedCollision& Allow(v1::CheckTrajectoryRequest& request, const std::string& link,
                            const std::string& class_name) {
  v1::AllowedCollision& allowed = *request.mutable_options()->add_allowed_collisions();
  allowed.set_link(link);
  allowed.set_class_name(class_name);
  return allowed;
}

Result<CheckQuestion> Question(const v1::CheckTrajectoryRequest& request) {
  return CheckOptionsFromProto(request.options(), LinksOf(request), *HomeWithAFloor(), kTrajectoryOptions);
}

TEST(AllowedCollisions, WithoutAnyAllPartsShareAnEmptyList) {
  const auto question = Question(Robot());
  ASSERT_TRUE(question.ok());
  EXPECT_EQ(question->parts.lists, std::vector<Ids>{{}});
  EXPECT_TRUE(question->parts.list_of.empty());
  EXPECT_TRUE(question->attached.at(0).may_touch.empty());
}

TEST(AllowedCollisions, ApplyToALinkAnObjectOrTheWholeRobot) {
  v1::CheckTrajectoryRequest request = Robot();
  Allow(request, "wheel", " FLOOR");  // named as classes are everywhere
  Allow(request, "", "table");
  v1::AllowedCollision& cup = Allow(request, "", "");
  cup.set_attached("maps/home/submaps/1");
  cup.set_submap("maps/home/submaps/2");
  const auto question = Question(request);
  ASSERT_TRUE(question.ok()) << question.status().ToString();
  const auto of = [&](std::size_t part) { return question->parts.lists[question->parts.ListOf(part)]; };
  EXPECT_EQ(of(0), Ids{SubmapId(3)});
  EXPECT_EQ(of(1), (Ids{SubmapId(3), SubmapId(4)}));
  EXPECT_EQ(of(2), of(1));
  EXPECT_EQ(of(3), Ids{SubmapId(3)}) << "of no link";
  EXPECT_EQ(question->parts.lists.size(), 2u) << "those that may touch the same share a list";
  EXPECT_EQ(question->attached.at(0).may_touch, (Ids{SubmapId(2), SubmapId(3)}));
}

TEST(AllowedCollisions, AClassMeansAllItsObjectsIfAny) {
  v1::CheckTrajectoryRequest request = Robot();
  Allow(request, "body", "chair");
  auto question = Question(request);
  ASSERT_TRUE(question.ok());
  EXPECT_EQ(question->parts.lists[question->parts.ListOf(0)], (Ids{SubmapId(1), SubmapId(2)}));
  EXPECT_TRUE(question->parts.lists[question->parts.ListOf(1)].empty());
}

TEST(AllowedCollisions, ErrorsNameTheFieldAndTheItem) {
  struct Case {
    std::function<void(v1::CheckTrajectoryRequest&)> spoil;
    const char* field;
    const char* what;
    Reason reason = "BAD_FILTER";
  };
  const Case cases[] = {
      {[](auto& r) { Allow(r, "whel", "floor"); }, "options.allowed_collisions[1].link", "'whel' is no link"},
      {[](auto& r) { Allow(r, "wheel", "flor"); }, "options.allowed_collisions[1].class_name",
       "there is no class 'flor'; did you mean 'floor'"},
      {[](auto& r) { Allow(r, "wheel", ""); }, "options.allowed_collisions[1]", "says neither"},
      {[](auto& r) { Allow(r, "wheel", "floor").set_submap("maps/home/submaps/4"); }, "options.allowed_collisions[1]",
       "says both a submap"},
      {[](auto& r) { Allow(r, "wheel", "floor").set_attached("maps/home/submaps/1"); }, "options.allowed_collisions[1]",
       "says both a link"},
      {[](auto& r) { Allow(r, "", "floor").set_attached("maps/home/submaps/2"); },
       "options.allowed_collisions[1].attached", "is not attached"},
      {[](auto& r) { Allow(r, "", "floor").set_attached("cup"); }, "options.allowed_collisions[1].attached", "'cup'",
       "BAD_NAME"},
      {[](auto& r) { Allow(r, "wheel", "").set_submap("maps/home/submaps/9"); }, "options.allowed_collisions[1].submap",
       "is not there", "SUBMAP_NOT_FOUND"},
      {[](auto& r) { Allow(r, "wheel", "").set_submap("maps/hall/submaps/1"); }, "options.allowed_collisions[1].submap",
       "is a submap of another map"},
      {[](auto& r) {
         for (int i = 0; i < 1000; ++i) Allow(r, "wheel", "floor");
       },
       "options.allowed_collisions", "1001 are more than 1000"},
      {[](auto& r) { r.add_sphere_links("arm"); }, "sphere_links", "has 5 names, not one for each of 4"},
      {[](auto& r) { r.mutable_sphere_links()->RemoveLast(); }, "sphere_links", "has 3 names"},
      {[](auto& r) { r.clear_sphere_links(); }, "options.allowed_collisions[0].link", "'body' is no link"},
  };
  for (const Case& c : cases) {
    v1::CheckTrajectoryRequest request = Robot();
    Allow(request, "body", "table");
    ASSERT_TRUE(Question(request).ok());
    c.spoil(request);
    const Status status = Question(request).status();
    ASSERT_EQ(status.violations().size(), 1u) << c.field;
    EXPECT_EQ(status.violations()[0].field, c.field);
    EXPECT_EQ(status.violations()[0].description.substr(0, std::string(c.what).size()), c.what)
        << status.violations()[0].description;
    EXPECT_EQ(status.reason(), c.reason) << c.field;
  }
}

TEST(AllowedCollisions, MoreThan64DifferentListsAreRefused) {
  MapInfo info;
  info.name = "home";
  Map map(info);
  v1::CheckTrajectoryRequest request;
  for (int i = 0; i < 64; ++i) {
    const SubmapId id = map.Create({.panoptic = Panoptic::kThing, .voxel_size_m = 0.05, .truncation_m = 0.1}).id();
    request.add_robot();
    request.add_sphere_links("link " + std::to_string(i));
    v1::AllowedCollision& allowed = Allow(request, request.sphere_links(i), "");
    allowed.set_submap("maps/home/submaps/" + std::to_string(id.value));
  }
  const auto state = map.Publish(0);
  const auto ask = [&] {
    return CheckOptionsFromProto(request.options(), LinksOf(request), *state, kTrajectoryOptions).status();
  };
  EXPECT_EQ(ask().violations().at(0).field, "options.allowed_collisions");
  request.mutable_options()->mutable_allowed_collisions()->RemoveLast();
  EXPECT_TRUE(ask().ok()) << "63, and that of the last";
}

TEST(AllowedCollisions, AreRefusedByQueriesWithoutChecksAndBodiesWithoutAttachments) {
  v1::QueryOptions options;
  options.add_allowed_collisions()->set_class_name("floor");
  EXPECT_EQ(QueryOptionsFromProto(options, *HomeWithAFloor(), kDistanceOptions).status().violations().at(0).field,
            "options.allowed_collisions");
  const google::protobuf::RepeatedPtrField<std::string> none;
  const RequestedLinks links{none, "body_links", 3};
  EXPECT_TRUE(CheckOptionsFromProto(options, links, *HomeWithAFloor(), kBodyOptions).ok());
  options.add_attached()->set_submap("maps/home/submaps/1");
  options.mutable_allowed_collisions(0)->set_attached("maps/home/submaps/1");
  EXPECT_EQ(CheckOptionsFromProto(options, links, *HomeWithAFloor(), kBodyOptions).status().violations().at(0).field,
            "options.allowed_collisions[0].attached");
}

}  // namespace
}  // namespace dhpmap
