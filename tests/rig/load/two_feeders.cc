// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "tests/rig/at_once.h"
#include "tests/rig/clients/frame_feed.h"
#include "tests/rig/load/surfaces.h"
#include "tests/rig/rig.h"
#include "tests/rig/server_under_test.h"

namespace dhpmap::rig {
namespace {

constexpr double kMostDifference_percent = 1;

/// The frames of each feeder, in its order.
using FeedShares = std::vector<std::vector<const v1::Frame*>>;

/// All shares at once into a new map, then FinishMapping; nothing, and said, if anything failed.
std::optional<MapSurfaces> MapShares(ServerUnderTest& server, const std::string& dataset, const std::string& map_id,
                                     const FeedShares& shares) {
  const auto channel = server.process().Connect();
  const Status created = CreateMapFor(dataset, map_id, channel);
  if (!created.ok()) return std::printf("FAILED: %s\n", created.ToString().c_str()), std::nullopt;
  std::vector<FeedOutcome> outcomes(shares.size());
  AtOnce(static_cast<int>(shares.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    const auto mapping = v1::MappingService::NewStub(server.process().Connect());
    outcomes[k] = FeedOnce(*mapping, map_id, "robot-" + std::to_string(i), shares[k]);
  });
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (outcomes[k].status.ok() && outcomes[k].num_fused == static_cast<int>(shares[k].size())) continue;
    std::printf("FAILED: %s: feeder %zu: %d of %zu frames fused: %s\n", map_id.c_str(), k, outcomes[k].num_fused,
                shares[k].size(), outcomes[k].status.error_message().c_str());
    return std::nullopt;
  }
  grpc::Status status = testing::Client(channel).Call(&testing::MappingStub::FinishMapping, "maps/" + map_id).status();
  MapSurfaces map;
  if (status.ok()) status = ReadSurfaces(channel, map_id, map);
  if (!status.ok())
    return std::printf("FAILED: %s: %s\n", map_id.c_str(), status.error_message().c_str()), std::nullopt;
  std::printf("%s: %zu things, %lld observed voxels, %lld at a surface\n", map_id.c_str(), map.things.size(),
              static_cast<long long>(map.num_observed_voxels), static_cast<long long>(map.num_surface_voxels));
  std::fflush(stdout);
  return map;
}

/// Which counterparts each thing of `of` has in `in`.
using Counterparts = std::vector<std::vector<const ThingSurface*>>;
Counterparts FindCounterparts(const MapSurfaces& of, const MapSurfaces& in) {
  Counterparts found;
  for (const ThingSurface& thing : of.things) {
    found.emplace_back();
    for (const ThingSurface& other : in.things) {
      if (AreCounterparts(thing, other)) found.back().push_back(&other);
    }
  }
  return found;
}

void TellThing(const ThingSurface& thing) {
  std::printf("%s (%zu voxels, %lld frames%s)", thing.submap.display_name().c_str(), thing.voxels.size(),
              static_cast<long long>(thing.submap.num_frames_observed()),
              thing.submap.confirmed() ? "" : ", unconfirmed");
}

/// Tells which have not exactly one; how many have none, with how many voxels, and how many several.
struct NotOnce {
  int num_missing = 0, num_doubled = 0;
  std::size_t num_voxels_missing = 0;
};
NotOnce TellNotOnce(const MapSurfaces& of, const Counterparts& counterparts, const std::string& where) {
  NotOnce found;
  std::size_t num_once = 0;
  for (std::size_t i = 0; i < counterparts.size(); ++i) {
    const ThingSurface& thing = of.things[i];
    const std::vector<const ThingSurface*>& others = counterparts[i];
    num_once += others.size() == 1;
    if (others.size() == 1) continue;
    if (others.empty()) found.num_voxels_missing += thing.voxels.size();
    ++(others.empty() ? found.num_missing : found.num_doubled);
    std::printf("        ");
    TellThing(thing);
    std::printf(": %zu counterparts %s", others.size(), where.c_str());
    for (const ThingSurface* other : others) std::printf(", "), TellThing(*other);
    std::printf("\n");
  }
  std::printf("        of %zu things %zu have exactly one counterpart %s\n", of.things.size(), num_once, where.c_str());
  return found;
}

bool ExpectAlike(const std::string& what, double one, double two) {
  if (one == 0) return Expect(what + ": with one feeder there is none", 1, 0, "");
  std::printf("        %s: %+.2f %%\n", what.c_str(), 100 * (two / one - 1));
  return Expect(what + ", difference", 100 * std::abs(two / one - 1), kMostDifference_percent, "%");
}

/// Every thing once, as with one feeder, and the points of all.
bool CompareMaps(const std::string& two_id, const MapSurfaces& one, const MapSurfaces& two) {
  const NotOnce of_one = TellNotOnce(one, FindCounterparts(one, two), "in " + two_id);
  const NotOnce of_two = TellNotOnce(two, FindCounterparts(two, one), "with one feeder");
  bool held = Expect(two_id + ": things doubled", of_one.num_doubled, 0, "");
  held &= Expect(two_id + ": things missing", of_one.num_missing, 0, "");
  held &= Expect(two_id + ": things that are several with one feeder", of_two.num_doubled, 0, "");
  held &=
      ExpectAlike(two_id + ": things", static_cast<double>(one.things.size()), static_cast<double>(two.things.size()));
  held &= Expect(two_id + ": points of things that one feeder does not have",
                 100 * static_cast<double>(of_two.num_voxels_missing) / static_cast<double>(two.num_surface_voxels),
                 kMostDifference_percent, "%");
  held &= ExpectAlike(two_id + ": observed voxels", static_cast<double>(one.num_observed_voxels),
                      static_cast<double>(two.num_observed_voxels));
  held &= ExpectAlike(two_id + ": surface voxels", static_cast<double>(one.num_surface_voxels),
                      static_cast<double>(two.num_surface_voxels));
  return held;
}

}  // namespace

bool RunTwoFeeders(const TwoFeedersOptions& options) {
  const auto frames = ReadFrames(options.dataset);
  if (!frames.ok()) return std::printf("FAILED: %s\n", frames.status().ToString().c_str()), false;
  FeedShares all(1), in_turn(2), halves(2);
  for (std::size_t i = 0; i < frames->size(); ++i) {
    const v1::Frame* frame = &(*frames)[i];
    all[0].push_back(frame);
    in_turn[i % 2].push_back(frame);
    halves[i < frames->size() / 2 ? 0 : 1].push_back(frame);
  }
  ServerUnderTest server;
  const auto one = MapShares(server, options.dataset, "one-feeder", all);
  const auto even_and_odd = MapShares(server, options.dataset, "even-and-odd", in_turn);
  const auto first_and_second = MapShares(server, options.dataset, "first-and-second-half", halves);
  if (!one || !even_and_odd || !first_and_second) return false;
  bool held = CompareMaps("even-and-odd", *one, *even_and_odd);
  held &= CompareMaps("first-and-second-half", *one, *first_and_second);
  return held;
}

}  // namespace dhpmap::rig
