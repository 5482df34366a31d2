// SPDX-License-Identifier: BSD-3-Clause
#include "server/wire/watch_conversion.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tests/support/scenes.h"

namespace dhpmap {
namespace {

MapInfo RoomWithClasses() {
  MapInfo map;
  map.name = "room";
  map.history_id = 0xab;
  map.label_set = testing::MakeLabelSet(1, 1);
  return map;
}

SubmapEvent Event(std::uint32_t id, std::uint16_t class_id, double x_m) {
  SubmapEvent event{.observed = {{x_m, 0, 0}, 1}, .num_blocks = 3};
  event.info.id = SubmapId(id);
  event.info.panoptic = Panoptic::kThing;
  event.info.class_id = ClassId(class_id);
  event.info.voxel_size_m = 0.1;
  event.before = SubmapPlace{Panoptic::kThing, ClassId(class_id), {{x_m, 0, 0}, 1}};
  return event;
}

ChangeFilter FilterOf(const v1::WatchFilter& filter) {
  const auto made = ChangeFilterFromProto(filter, *RoomWithClasses().label_set);
  EXPECT_TRUE(made.ok()) << made.status().ToString();
  return made.ok() ? *made : ChangeFilter();
}

v1::WatchFilter FilterByRegion(double low_m, double high_m) {
  v1::WatchFilter filter;
  v1::AxisAlignedBox& box = *filter.mutable_region();
  box.mutable_min_m()->set_x(low_m);
  box.mutable_max_m()->set_x(high_m);
  return filter;
}

TEST(WatchConversion, AFilterSelectsObjectsThatMeetAllConditionsBeforeOrAfter) {
  EXPECT_TRUE(FilterOf({}).Passes(Event(7, 1, 0)));
  v1::WatchFilter filter;
  filter.add_instance_ids(7);
  filter.add_instance_ids(8);
  EXPECT_TRUE(FilterOf(filter).Passes(Event(8, 1, 0)));
  EXPECT_FALSE(FilterOf(filter).Passes(Event(9, 1, 0)));
  filter.add_class_ids(1);
  EXPECT_FALSE(FilterOf(filter).Passes(Event(8, 2, 0)));
  SubmapEvent event = Event(8, 2, 0);
  event.before->class_id = ClassId(1);
  EXPECT_TRUE(FilterOf(filter).Passes(event)) << "it leaves the class";

  EXPECT_TRUE(FilterOf(FilterByRegion(4, 6)).Passes(Event(1, 1, 5)));
  EXPECT_FALSE(FilterOf(FilterByRegion(4, 6)).Passes(Event(1, 1, 8)));
  event = Event(1, 1, 8);
  event.before->sphere.center_m.x() = 5;
  EXPECT_TRUE(FilterOf(FilterByRegion(4, 6)).Passes(event)) << "it leaves the region";
  event = Event(1, 1, 5);
  event.kind = ChangeKind::kRemoved;
  event.before->sphere.center_m.x() = 8;
  EXPECT_FALSE(FilterOf(FilterByRegion(4, 6)).Passes(event)) << "it was elsewhere, and is nowhere";
  event.before.reset();
  EXPECT_TRUE(FilterOf(FilterByRegion(4, 6)).Passes(event)) << "it may have been there between the two states";
  EXPECT_FALSE(FilterOf(filter).Passes(event)) << "another was asked for";
}

TEST(WatchConversion, AFilterOfPartsAppliesToChangesOnly) {
  v1::WatchFilter filter;
  filter.add_parts(v1::SubmapEvent::POSE);
  SubmapEvent event = Event(1, 1, 0);
  event.parts = {SubmapPart::kGeometry};
  EXPECT_FALSE(FilterOf(filter).Passes(event));
  event.parts.Add(SubmapPart::kPose);
  EXPECT_TRUE(FilterOf(filter).Passes(event));
  event.kind = ChangeKind::kMerged;
  event.parts = {};
  EXPECT_TRUE(FilterOf(filter).Passes(event));
  filter.add_kinds(v1::SubmapEvent::CREATED);
  EXPECT_FALSE(FilterOf(filter).Passes(event));
}

TEST(WatchConversion, EveryBadFieldOfAFilterIsNamed) {
  v1::WatchFilter filter = FilterByRegion(3, 1);
  filter.add_instance_ids(-1);
  filter.add_class_names("unicorn");
  filter.add_kinds(static_cast<v1::SubmapEvent::Kind>(99));
  filter.add_parts(v1::SubmapEvent::PART_UNSPECIFIED);
  const auto made = ChangeFilterFromProto(filter, *RoomWithClasses().label_set);
  EXPECT_EQ(made.status().reason(), Reason("BAD_FILTER"));
  std::set<std::string> fields;
  for (const FieldViolation& violation : made.status().violations()) fields.insert(violation.field);
  EXPECT_EQ(fields, (std::set<std::string>{"filter.region", "filter.instance_ids", "filter.class_names", "filter.kinds",
                                           "filter.parts"}));
}

TEST(WatchConversion, BoxesEncloseTheirTilesAtTheSubmapsPose) {
  SubmapEvent event = Event(1, 1, 0);
  event.tiles = {{{0, 0, 0}, {1, 0, 0}}};
  const double side_m = 0.1 * 32;
  v1::AxisAlignedBox box = ToProto(event, RoomWithClasses()).boxes(0);
  EXPECT_NEAR(box.min_m().x(), 0, 1e-12);
  EXPECT_NEAR(box.max_m().x(), 2 * side_m, 1e-12);
  EXPECT_NEAR(box.max_m().z(), side_m, 1e-12);
  event.info.T_map_submap.translate(Eigen::Vector3d(10, 0, 0));
  event.info.T_map_submap.rotate(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ()));
  box = ToProto(event, RoomWithClasses()).boxes(0);
  EXPECT_NEAR(box.min_m().x(), 10 - side_m, 1e-12);
  EXPECT_NEAR(box.max_m().x(), 10, 1e-12);
  EXPECT_NEAR(box.max_m().y(), 2 * side_m, 1e-12);
}

TEST(WatchConversion, MessagesOfAChangeContainEachSelectedSubmapOnceAndMarkTheLast) {
  const MapInfo map = RoomWithClasses();
  auto change = std::make_shared<MapChange>();
  change->first_revision = 4;
  change->last_revision = 6;
  change->display_name = "a new name";
  for (std::uint32_t id = 0; id < 2000; ++id) {
    change->submaps.push_back(Event(id, id % 3 == 0 ? 1 : 2, 0));
    change->submaps.back().info.display_name = std::string(100, 'x');
  }
  v1::WatchFilter one_class;
  one_class.add_class_ids(1);
  for (const v1::WatchFilter& proto : {v1::WatchFilter(), one_class}) {
    const ChangeFilter filter = FilterOf(proto);
    ChangeMessages messages(change, filter);
    std::vector<std::int64_t> told, expected;
    int num_names = 0, num_messages = 0;
    bool was_last = false;
    while (messages.has_next()) {
      EXPECT_FALSE(was_last);
      v1::MapChange message;
      messages.Next(filter, map, message);
      EXPECT_LT(message.ByteSizeLong(), 66u << 10);
      EXPECT_EQ(message.first_revision(), 4);
      EXPECT_EQ(message.last_revision(), 6);
      num_names += message.has_display_name();
      was_last = message.last_message();
      ++num_messages;
      for (const v1::SubmapEvent& event : message.submaps()) told.push_back(event.submap().instance_id());
    }
    for (const SubmapEvent& event : change->submaps) {
      if (filter.Passes(event)) expected.push_back(event.info.id.value);
    }
    EXPECT_TRUE(was_last);
    EXPECT_EQ(told, expected);
    EXPECT_EQ(num_names, 1);
    EXPECT_GT(num_messages, 2);
  }
  change->display_name.reset();
  v1::WatchFilter nothing;
  nothing.add_instance_ids(12345);
  EXPECT_FALSE(ChangeMessages(change, FilterOf(nothing)).has_next());
}

TEST(WatchConversion, RegionsPrecedeSubmapsInMessagesOfBoundedSize) {
  const MapInfo map = RoomWithClasses();
  auto change = std::make_shared<MapChange>();
  for (int n = 0; n < 2000; ++n) {
    change->regions.push_back({.kind = RegionEventKind::kKeptClear,
                               .region = BoundingSphere{{0.1 * n, 0, 0}, 1},
                               .name = std::string(60, 'x')});
  }
  change->submaps.push_back(Event(1, 1, 0));
  ChangeMessages messages(change, {});
  int num_regions = 0, num_messages = 0;
  while (messages.has_next()) {
    v1::MapChange message;
    messages.Next({}, map, message);
    EXPECT_LT(message.ByteSizeLong(), 66u << 10);
    num_regions += message.regions_size();
    ++num_messages;
    EXPECT_EQ(message.last_message(), !messages.has_next());
    if (message.submaps_size() > 0) {
      EXPECT_EQ(num_regions, 2000);
    }
  }
  EXPECT_EQ(num_regions, 2000);
  EXPECT_GT(num_messages, 1);
  change->submaps.clear();
  EXPECT_TRUE(ChangeMessages(change, {}).has_next()) << "regions alone are told, too";
}

TEST(WatchConversion, RemovedObjectsKeepNameAndClass) {
  SubmapEvent event = Event(7, 1, 0);
  event.kind = ChangeKind::kMerged;
  event.into = SubmapId(3);
  const v1::SubmapEvent proto = ToProto(event, RoomWithClasses());
  EXPECT_EQ(proto.kind(), v1::SubmapEvent::MERGED);
  EXPECT_EQ(proto.merged_into(), "maps/room/submaps/3");
  EXPECT_EQ(proto.submap().name(), "maps/room/submaps/7");
  EXPECT_EQ(proto.submap().class_name(), "thing1");
  EXPECT_FALSE(proto.submap().has_bounding_sphere());
}

}  // namespace
}  // namespace dhpmap
