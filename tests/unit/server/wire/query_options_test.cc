// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/query_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace dhpmap {
namespace {

/// Map "home" with the classes chair (1) and table (2) and a submap 1.
std::shared_ptr<const MapSnapshot> Home() {
  MapInfo info;
  info.name = "home";
  info.label_set = std::make_shared<const LabelSet>(
      *LabelSet::Create({{.id = ClassId(1), .name = "chair"}, {.id = ClassId(2), .name = "table"}}));
  Map map(info);
  (void)map.Create({.panoptic = Panoptic::kThing, .class_id = ClassId(1), .voxel_size_m = 0.05, .truncation_m = 0.1});
  return map.Publish(0);
}

TEST(QueryOptionsFromProto, SuggestsASimilarClass) {
  v1::QueryOptions options;
  options.add_excluded_class_names("tabel");
  const Status status = QueryOptionsFromProto(options, *Home()).status();
  ASSERT_EQ(status.violations().size(), 1u);
  EXPECT_EQ(status.violations()[0].description, "there is no class 'tabel'; did you mean 'table'?");
}

TEST(QueryOptionsFromProto, HasDefaults) {
  const auto question = QueryOptionsFromProto({}, *Home());
  ASSERT_TRUE(question.ok());
  EXPECT_EQ(question->options.max_distance_m, 3);
  EXPECT_FALSE(question->options.unknown_is_free);
  EXPECT_TRUE(question->options.scope.IsAll());
  EXPECT_TRUE(IsIdentity(question->T_map_query));
}

TEST(QueryOptionsFromProto, ReadsEveryField) {
  v1::QueryOptions options;
  options.set_unknown_policy(v1::QueryOptions::FREE);
  options.set_max_distance_m(7);
  options.add_excluded_submaps("maps/home/submaps/1");
  options.add_excluded_submaps("maps/home/submaps/0");
  options.add_excluded_class_names(" Table");
  options.add_class_names("CHAIR");
  options.mutable_map_from_query()->mutable_translation_m()->set_z(4);
  options.mutable_padding()->set_default_padding_m(0.5);
  options.mutable_padding()->add_classes()->set_class_name("Chair");
  options.mutable_padding()->mutable_classes(0)->set_padding_m(0.25);
  options.mutable_padding()->add_submaps()->set_submap("maps/home/submaps/0");
  options.add_attached()->set_submap("maps/home/submaps/1");
  options.set_max_free_age_s(60);
  options.set_min_revision(3);
  options.set_tolerance_vox(0.6);
  options.set_vacated_policy(v1::Vacated::FREE);
  options.set_include_absent(true);
  const auto question = QueryOptionsFromProto(options, *Home(), kDistanceOptions);
  ASSERT_TRUE(question.ok());
  EXPECT_TRUE(question->options.unknown_is_free);
  EXPECT_EQ(question->options.max_distance_m, 7);
  EXPECT_EQ(question->options.scope.excluded_submaps, (std::vector<SubmapId>{SubmapId(1), SubmapId(0)}));
  EXPECT_EQ(question->options.scope.excluded_classes, std::vector<ClassId>{ClassId(2)});
  EXPECT_EQ(question->options.scope.classes, std::vector<ClassId>{ClassId(1)});
  EXPECT_EQ(question->T_map_query.translation().z(), 4);
  const SurfacePadding& padding = question->options.scope.padding;
  EXPECT_EQ(padding.default_m, 0.5);
  EXPECT_EQ(padding.classes, (std::vector<std::pair<ClassId, double>>{{ClassId(1), 0.25}}));
  EXPECT_EQ(padding.submaps, (std::vector<std::pair<SubmapId, double>>{{SubmapId(0), 0}}));
  EXPECT_EQ(question->options.scope.attached, std::vector<SubmapId>{SubmapId(1)});
  EXPECT_EQ(question->options.scope.max_free_age_s, 60);
  EXPECT_EQ(question->options.tolerance_vox, 0.6);
  EXPECT_TRUE(question->options.scope.vacated_is_free);
  EXPECT_TRUE(question->options.scope.with_absent);
}

TEST(QueryOptionsFromProto, AnAttachedObjectLeavesFreeSpaceUnlessSetUnknown) {
  v1::QueryOptions options;
  const auto keeps_unknown = [&] {
    return QueryOptionsFromProto(options, *Home(), kDistanceOptions)->options.scope.keeps_attached_unknown;
  };
  EXPECT_FALSE(keeps_unknown());
  options.set_vacated_policy(v1::Vacated::FREE);
  EXPECT_FALSE(keeps_unknown());
  options.set_vacated_policy(v1::Vacated::UNKNOWN);
  EXPECT_TRUE(keeps_unknown());
}

TEST(QueryOptionsFromProto, ErrorsNameTheInvalidFieldAndItem) {
  struct Case {
    std::function<void(v1::QueryOptions&)> spoil;
    const char* field;
    Reason reason;
  };
  const Case cases[] = {
      {[](auto& o) { o.set_max_distance_m(0); }, "options.max_distance_m", "BAD_DISTANCE"},
      {[](auto& o) { o.set_max_distance_m(-1); }, "options.max_distance_m", "BAD_DISTANCE"},
      {[](auto& o) { o.set_max_distance_m(NAN); }, "options.max_distance_m", "BAD_DISTANCE"},
      {[](auto& o) { o.set_max_distance_m(INFINITY); }, "options.max_distance_m", "BAD_DISTANCE"},
      {[](auto& o) { o.set_unknown_policy(static_cast<v1::QueryOptions::UnknownPolicy>(77)); },
       "options.unknown_policy", "BAD_FILTER"},
      {[](auto& o) { o.mutable_map_from_query()->mutable_rotation(); }, "options.map_from_query", "BAD_TRANSFORM"},
      {[](auto& o) { o.mutable_map_from_query()->mutable_translation_m()->set_x(NAN); }, "options.map_from_query",
       "BAD_TRANSFORM"},
      {[](auto& o) { o.add_excluded_submaps("maps/home/submaps/1"), o.add_excluded_submaps("7"); },
       "options.excluded_submaps[1]", "BAD_NAME"},
      {[](auto& o) { o.add_excluded_submaps("maps/other/submaps/1"); }, "options.excluded_submaps[0]", "BAD_FILTER"},
      {[](auto& o) { o.add_excluded_submaps("maps/home/submaps/9"); }, "options.excluded_submaps[0]",
       "SUBMAP_NOT_FOUND"},
      {[](auto& o) { o.add_excluded_class_names("spoon"); }, "options.excluded_class_names[0]", "BAD_FILTER"},
      {[](auto& o) { o.add_class_names("chair"), o.add_class_names(""); }, "options.class_names[1]", "BAD_FILTER"},
      {[](auto& o) {
         for (int i = 0; i < 1001; ++i) o.add_class_names("chair");
       },
       "options.class_names", "BAD_FILTER"},
      {[](auto& o) {
         for (int i = 0; i < 1001; ++i) o.add_excluded_submaps("maps/home/submaps/1");
       },
       "options.excluded_submaps", "BAD_FILTER"},
      {[](auto& o) { o.mutable_padding()->set_default_padding_m(-0.1); }, "options.padding.default_padding_m",
       "BAD_DISTANCE"},
      {[](auto& o) { o.mutable_padding()->set_default_padding_m(NAN); }, "options.padding.default_padding_m",
       "BAD_DISTANCE"},
      {[](auto& o) { o.mutable_padding()->add_classes()->set_class_name("spoon"); },
       "options.padding.classes[0].class_name", "BAD_FILTER"},
      {[](auto& o) {
         o.mutable_padding()->add_classes()->set_class_name("chair");
         o.mutable_padding()->mutable_classes(0)->set_padding_m(11);
       },
       "options.padding.classes[0].padding_m", "BAD_DISTANCE"},
      {[](auto& o) { o.mutable_padding()->add_submaps()->set_submap("maps/home/submaps/9"); },
       "options.padding.submaps[0].submap", "SUBMAP_NOT_FOUND"},
      {[](auto& o) {
         for (int i = 0; i < 16; ++i) {
           auto& padding = *o.mutable_padding()->add_submaps();
           padding.set_submap("maps/home/submaps/1");
           padding.set_padding_m(0.1 * (i + 1));
         }
       },
       "options.padding", "BAD_FILTER"},
      {[](auto& o) { o.add_attached()->set_submap("maps/home/submaps/0"); }, "options.attached[0].submap",
       "BAD_FILTER"},
      {[](auto& o) {
         for (int i = 0; i < 2; ++i) o.add_attached()->set_submap("maps/home/submaps/1");
       },
       "options.attached[1].submap", "BAD_FILTER"},
      {[](auto& o) { o.set_max_free_age_s(-1); }, "options.max_free_age_s", "BAD_FILTER"},
      {[](auto& o) { o.set_max_free_age_s(NAN); }, "options.max_free_age_s", "BAD_FILTER"},
      {[](auto& o) { o.set_vacated_policy(static_cast<v1::Vacated::Policy>(7)); }, "options.vacated_policy",
       "BAD_FILTER"},
      {[](auto& o) { o.set_tolerance_vox(-0.1); }, "options.tolerance_vox", "BAD_FILTER"},
      {[](auto& o) { o.set_tolerance_vox(NAN); }, "options.tolerance_vox", "BAD_FILTER"},
      {[](auto& o) { o.set_min_revision(-1); }, "options.min_revision", "BAD_FILTER"},
      {[](auto& o) { o.set_unknown_policy(v1::QueryOptions::OCCUPIED); }, "options.unknown_policy", "BAD_FILTER"},
      {[](auto& o) { o.add_allowed_collisions(); }, "options.allowed_collisions", "BAD_FILTER"},
      {[](auto& o) {
         o.add_attached()->set_submap("maps/home/submaps/1");
         o.mutable_attached(0)->mutable_robot_from_submap();
       },
       "options.attached[0].robot_from_submap", "BAD_FILTER"},
  };
  const auto home = Home();
  for (const Case& c : cases) {
    v1::QueryOptions options;
    c.spoil(options);
    const Status status = QueryOptionsFromProto(options, *home, kDistanceOptions).status();
    EXPECT_EQ(status.reason(), c.reason) << c.field << ": " << status.ToString();
    ASSERT_EQ(status.violations().size(), 1u) << c.field;
    EXPECT_EQ(status.violations()[0].field, c.field);
  }
}

TEST(QueryOptionsFromProto, RefusesUnsupportedOptions) {
  struct Case {
    std::function<void(v1::QueryOptions&)> set;
    const char* field;
    bool is_for_rays;
  };
  const Case cases[] = {
      {[](auto& o) { o.mutable_padding(); }, "options.padding", false},
      {[](auto& o) { o.add_attached()->set_submap("maps/home/submaps/1"); }, "options.attached", true},
      {[](auto& o) { o.set_max_free_age_s(1); }, "options.max_free_age_s", true},
      {[](auto& o) { o.set_vacated_policy(v1::Vacated::UNKNOWN); }, "options.vacated_policy", true},
      {[](auto& o) { o.set_tolerance_vox(0); }, "options.tolerance_vox", false},
  };
  for (const Case& c : cases) {
    v1::QueryOptions options;
    c.set(options);
    EXPECT_TRUE(QueryOptionsFromProto(options, *Home(), kDistanceOptions).ok()) << c.field;
    EXPECT_EQ(QueryOptionsFromProto(options, *Home(), kRayOptions).ok(), c.is_for_rays) << c.field;
    const Status refused = QueryOptionsFromProto(options, *Home()).status();
    ASSERT_EQ(refused.violations().size(), 1u) << c.field;
    EXPECT_EQ(refused.violations()[0].field, c.field);
  }
}

}  // namespace
}  // namespace dhpmap
