// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/v1/query_options.pb.h"
#include "mapping/map/map.h"
#include "server/app/queries/body_check.h"
#include "server/app/queries/distance_lookup.h"
#include "server/wire/allowed_collisions.h"

namespace dhpmap {

/// Queried points lie within kReach_m of the origin. Grids and slices have a resolution between the other two.
inline constexpr double kReach_m = 1e6, kLeastResolution_m = 0.001, kMostResolution_m = 100;

/// Options that have no meaning for some queries. One that is set and not taken is INVALID_ARGUMENT. All queries take
/// what is excluded or absent, classes, the frame, max_distance_m, min_revision, and unknown space as REPORT or FREE.
struct TakenOptions {
  bool padding = false;
  bool attached = false;  ///< leaves the world
  bool max_age = false;
  bool vacated = false;
  bool occupied = false;   ///< unknown space may be
  bool tolerance = false;  ///< of distances
  bool allowed = false;    ///< collisions may be
  bool carries = false;    ///< there is a robot: poses of what is attached, and what that may touch
};
inline constexpr TakenOptions kDistanceOptions{
    .padding = true, .attached = true, .max_age = true, .vacated = true, .tolerance = true};
inline constexpr TakenOptions kRayOptions{.attached = true, .max_age = true, .vacated = true};
inline constexpr TakenOptions kBodyOptions{
    .padding = true, .attached = true, .max_age = true, .vacated = true, .occupied = true, .allowed = true};
inline constexpr TakenOptions kTrajectoryOptions{.padding = true,
                                                 .attached = true,
                                                 .max_age = true,
                                                 .vacated = true,
                                                 .occupied = true,
                                                 .allowed = true,
                                                 .carries = true};

/// What a request's options mean for a state of a map. INVALID_ARGUMENT for a distance, pose, name, policy or length of
/// a list that is not usable, or an option that is not taken; NOT_FOUND for a submap that is not there; each names the
/// field, "options.map_from_query", and of a list the first item that is wrong.
Result<DistanceQuestion> QueryOptionsFromProto(const v1::QueryOptions& options, const MapSnapshot& map,
                                               TakenOptions taken = {});
/// Of queries that take the frame and min_revision alone: p_map = T_map_query * p_query.
Result<Transform> FrameOptionsFromProto(const v1::QueryOptions& options);
/// The same for checks of bodies or motions, for which unknown space is occupied unless they say otherwise.
/// `links`: which its bodies or spheres belong to.
Result<CheckQuestion> CheckOptionsFromProto(const v1::QueryOptions& options, const RequestedLinks& links,
                                            const MapSnapshot& map, TakenOptions taken);

}  // namespace dhpmap
