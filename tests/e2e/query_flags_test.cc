// SPDX-License-Identifier: BSD-3-Clause
// Flags of `dhpmap query ...` that say in which frame is asked, of which revision and with what padding: they do what
// the fields of the API do.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <regex>
#include <string>
#include <vector>

#include "dhpmap/v1/query_service.grpc.pb.h"
#include "tests/e2e/mapped_room.h"
#include "tests/e2e/server_process.h"
#include "tests/support/scenes.h"

namespace dhpmap::testing {
namespace {

class QueryFlags : public MappedRoom {
 protected:
  using Arguments = std::vector<std::string>;
  /// `dhpmap query ARGUMENTS MORE`.
  static Outcome Query(Arguments arguments, const Arguments& more = {}) {
    arguments.insert(arguments.begin(), "query");
    arguments.insert(arguments.end(), more.begin(), more.end());
    return server_->Dhpmap(std::move(arguments));
  }
  /// The first number of that name in an answer as JSON; NaN if there is none.
  static double NumberOf(const std::string& field, const Outcome& outcome) {
    std::smatch found;
    const std::regex number("\"" + field + "\": \"?(-?[0-9.]+(e[-+]?[0-9]+)?)");
    const bool is_there = std::regex_search(outcome.out, found, number);
    EXPECT_TRUE(is_there) << field << " in: " << outcome.out << outcome.err;
    return is_there ? std::stod(found[1].str()) : std::numeric_limits<double>::quiet_NaN();
  }
  static bool Says(const Outcome& outcome, const std::string& text) {
    return outcome.exit_code == 0 && outcome.out.find(text) != std::string::npos;
  }
  /// What the API answers for the point at which the tests ask, before the ball, with these options.
  static v1::DistanceResult FromTheApi(const v1::QueryOptions& options) {
    v1::QueryDistancesRequest request;
    request.set_map("maps/room");
    for (const float value : {1.f, -0.5f, 0.5f}) request.add_packed_points_m(value);
    *request.mutable_options() = options;
    v1::QueryDistancesResponse response;
    grpc::ClientContext context;
    const grpc::Status status =
        v1::QueryService::NewStub(server_->Connect())->QueryDistances(&context, request, &response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return response.results_size() == 1 ? response.results(0) : v1::DistanceResult();
  }
  static std::string Text(double value) { return std::to_string(value); }

  // The same point in the map's frame and in one that stands at (1, -1, 0.25) and is turned by 90 degrees.
  inline static const Arguments kInMap = {"1", "-.5", ".5"}, kInFrame = {".5", "0", ".25"},
                                kFrame = {"--map-from-query", "1", "-1", ".25", "90"};
  static Arguments With(Arguments front, const Arguments& middle, const Arguments& back) {
    front.insert(front.end(), middle.begin(), middle.end());
    front.insert(front.end(), back.begin(), back.end());
    return front;
  }
};

TEST_F(QueryFlags, PaddingOfChecksGrowsWhatIsInTheWay) {
  const double gap_m = FromTheApi({}).distance_m();
  ASSERT_GT(gap_m, 0.1);
  const std::string radius = Text(gap_m - 0.05);
  const Arguments sphere = With({"collisions", "room"}, kInMap, {radius, "--unknown", "free", "--json"});
  EXPECT_TRUE(Says(Query(sphere), "\"colliding\": false"));
  EXPECT_TRUE(Says(Query(sphere, {"--padding", "0.02"}), "\"colliding\": false"));
  const Outcome grown = Query(sphere, {"--padding", "0.08"});
  EXPECT_TRUE(Says(grown, "\"colliding\": true")) << grown.out << grown.err;
  EXPECT_NEAR(NumberOf("depth_m", grown), 0.03, 1e-4);
  const Arguments stand =
      With({"trajectory", "room"}, kInMap, {"0", "--robot", "0", "0", "0", radius, "--unknown", "free", "--json"});
  EXPECT_TRUE(Says(Query(stand, {"--padding", "0.02"}), "\"valid\": true"));
  EXPECT_TRUE(Says(Query(stand, {"--padding", "0.08"}), "\"valid\": false"));
  EXPECT_EQ(Query(sphere, {"--padding", "-1"}).exit_code, 2) << "refused by the server";
}

TEST_F(QueryFlags, WhatMayBeTouchedIsNotInTheWayOfTheLinkThatMayTouchIt) {
  const v1::DistanceResult nearest = FromTheApi({});
  const std::string radius = Text(nearest.distance_m() + 0.05), id = std::to_string(nearest.instance_id());
  const Arguments sphere = With({"collisions", "room"}, kInMap, {radius, "--unknown", "free", "--json"});
  const Arguments stand =
      With({"trajectory", "room"}, kInMap, {"0", "--robot", "0", "0", "0", radius, "--unknown", "free", "--json"});
  ASSERT_FALSE(nearest.class_name().empty());
  for (const std::string& what : {nearest.class_name(), id}) {
    EXPECT_TRUE(Says(Query(sphere, {"--allow-collision", what}), "\"colliding\": false")) << what;
    EXPECT_TRUE(Says(Query(sphere, {"--links", "arm", "--allow-collision", "arm:" + what}), "\"colliding\": false"));
    EXPECT_TRUE(Says(Query(stand, {"--links", "arm", "--allow-collision", "arm:" + what}), "\"valid\": true"));
    EXPECT_TRUE(Says(Query(stand, {"--allow-collision", ":" + what}), "\"valid\": true")) << "all of the robot";
  }
  const Outcome refused = Query(stand, {"--links", "arm", "--allow-collision", "leg:" + id});
  EXPECT_EQ(refused.exit_code, 2) << "by the server";
  EXPECT_NE(refused.err.find("options.allowed_collisions[0].link: 'leg' is no link"), std::string::npos) << refused.err;
  EXPECT_EQ(Query(stand, {"--allow-collision", "leg:"}).exit_code, 1);
}

TEST_F(QueryFlags, ClearanceTellsHowNearATrajectoryComes) {
  const double gap_m = FromTheApi({}).distance_m();
  const Arguments stand = With({"trajectory", "room"}, kInMap,
                               {"0", "--robot", "0", "0", "0", Text(gap_m - 0.05), "--unknown", "free", "--clearance"});
  EXPECT_NEAR(NumberOf("distance_m", Query(stand, {"--json"})), 0.05, 1e-3);
  EXPECT_NEAR(NumberOf("distance_m", Query(stand, {"--json", "--padding", "0.02"})), 0.03, 1e-3);
  EXPECT_TRUE(Says(Query(stand), "CLEARANCE_M")) << Query(stand).out;
}

TEST_F(QueryFlags, PaddingOfDistancesIsTakenOffThem) {
  v1::QueryOptions options;
  options.mutable_padding()->set_default_padding_m(0.0625);
  const double expected_m = FromTheApi(options).distance_m();
  EXPECT_NEAR(expected_m, FromTheApi({}).distance_m() - 0.0625, 1e-5);
  const Arguments query = With({"distances", "room"}, kInMap, {"--json"});
  EXPECT_NEAR(NumberOf("distance_m", Query(query, {"--padding", "0.0625"})), expected_m, 1e-5);
  EXPECT_EQ(Query(query, {"--padding", "-1"}).exit_code, 2);
}

TEST_F(QueryFlags, AFrameOfTheCallersIsThatOfQuestionsAndAnswers) {
  const v1::DistanceResult in_map = FromTheApi({});
  const Outcome distance = Query(With({"distances", "room"}, kInFrame, {"--json"}), kFrame);
  EXPECT_NEAR(NumberOf("distance_m", distance), in_map.distance_m(), 1e-5);
  // The gradient comes first: map y is x of the frame.
  EXPECT_NEAR(NumberOf("x", distance), in_map.gradient().y(), 1e-4);
  EXPECT_NEAR(NumberOf("y", distance), -in_map.gradient().x(), 1e-4);

  const std::string radius = Text(in_map.distance_m() + 0.02);
  const Outcome collision =
      Query(With({"collisions", "room"}, kInFrame, {radius, "--unknown", "free", "--json"}), kFrame);
  EXPECT_NEAR(NumberOf("depth_m", collision), 0.02, 1e-4);
  const Outcome motion = Query(
      With({"trajectory", "room"}, kInFrame, {"0", "--robot", "0", "0", "0", radius, "--unknown", "free", "--json"}),
      kFrame);
  EXPECT_NEAR(NumberOf("depth_m", motion), 0.02, 1e-4);
  const Arguments down = {"0", "0", "-1", "--max-distance", "5", "--json"};
  const Outcome ray = Query(With({"rays", "room"}, kInFrame, down), kFrame);
  EXPECT_NEAR(NumberOf("distance_m", ray), NumberOf("distance_m", Query(With({"rays", "room"}, kInMap, down))), 1e-4);
  const Outcome nearest = Query(With({"search", "room", "--near"}, kInFrame, {"--limit", "1", "--json"}), kFrame);
  EXPECT_NEAR(NumberOf("distance_m", nearest), in_map.distance_m(), 1e-4);
  const v1::Vector3& p = in_map.nearest_point_m();
  const Arguments surface = {"point", "room", Text(p.y() + 1), Text(1 - p.x()), Text(p.z() - .25), "--json"};
  EXPECT_EQ(NumberOf("instance_id", Query(surface, kFrame)), static_cast<double>(in_map.instance_id()));
  EXPECT_TRUE(Says(Query(surface), "\"near_surface\": false")) << "the same numbers, in the map";
  EXPECT_EQ(Query({"relations", "room"}, kFrame).exit_code, 0);
  const std::string picture = (temp_->path() / "framed.pgm").string(), array = (temp_->path() / "framed.npy").string();
  EXPECT_EQ(Query({"slice", "room", "--out", picture}, kFrame).exit_code, 0);
  EXPECT_EQ(Query({"grid", "room", "--box", "0", "0", "0", ".2", ".2", ".2", "--out", array}, kFrame).exit_code, 0);
}

TEST_F(QueryFlags, ARevisionToWaitForReachesTheServer) {
  const Arguments point = With({"distances", "room"}, kInMap, {"--json"});
  const double revision = NumberOf("revision", Query(point));
  ASSERT_GE(revision, 1);
  const std::string now = std::to_string(static_cast<long>(revision));
  const std::string picture = (temp_->path() / "revision.pgm").string();
  const Arguments queries[] = {
      point,
      With({"point", "room"}, kInMap, {}),
      With({"rays", "room"}, kInMap, {"0", "0", "-1"}),
      With({"collisions", "room"}, kInMap, {".1"}),
      With({"trajectory", "room"}, kInMap, {"0", "--robot", "0", "0", "0", ".1"}),
      {"slice", "room", "--out", picture},
      {"search", "room"},
      {"relations", "room"},
  };
  for (const Arguments& query : queries) {
    EXPECT_EQ(Query(query, {"--min-revision", now}).exit_code, 0) << query[0];
    EXPECT_EQ(Query(query, {"--min-revision", "-1"}).exit_code, 2) << query[0] << ": refused by the server";
  }
}

TEST_F(QueryFlags, ARevisionOfThePastReachesTheServer) {
  const Arguments point = With({"point", "room"}, kInMap, {"--json"});
  const double revision = NumberOf("revision", Query(point));
  ASSERT_GE(revision, 1);
  const std::string past = std::to_string(static_cast<long>(revision));
  ASSERT_EQ(server_->Dhpmap({"edit", "rename", "room", "1", "later"}).exit_code, 0);
  const std::string picture = (temp_->path() / "past.pgm").string(), array = (temp_->path() / "past.npy").string();
  const Arguments queries[] = {
      point,
      With({"distances", "room"}, kInMap, {"--json"}),
      With({"rays", "room"}, kInMap, {"0", "0", "-1", "--json"}),
      With({"collisions", "room"}, kInMap, {".1", "--json"}),
      With({"trajectory", "room"}, kInMap, {"0", "--robot", "0", "0", "0", ".1", "--json"}),
      {"slice", "room", "--out", picture, "--json"},
      {"search", "room", "--json"},
      {"relations", "room", "--json"},
  };
  for (const Arguments& query : queries) {
    EXPECT_EQ(NumberOf("revision", Query(query)), revision + 1) << query[0];
    EXPECT_EQ(NumberOf("revision", Query(query, {"--read-revision", past})), revision) << query[0];
    EXPECT_EQ(Query(query, {"--read-revision", "-1"}).exit_code, 2) << query[0] << ": refused by the server";
  }
  const Arguments grid = {"grid", "room", "--box", "0", "0", "0", ".2", ".2", ".2", "--out", array};
  EXPECT_TRUE(Says(Query(grid, {"--read-revision", past}), "of revision " + past));
}

}  // namespace
}  // namespace dhpmap::testing
