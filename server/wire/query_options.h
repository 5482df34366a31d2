// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dhpmap/v1/query_options.pb.h"
#include "mapping/map/map.h"
#include "server/app/queries/body_check.h"
#include "server/app/queries/distance_lookup.h"
#include "server/wire/allowed_collisions.h"

namespace dhpmap {

/// Limits: distance of query points from the origin, and the resolution of grids and slices.
inline constexpr double kReach_m = 1e6, kLeastResolution_m = 0.001, kMostResolution_m = 100;

/// Options that only some queries support; INVALID_ARGUMENT if one is set elsewhere. All queries support exclusions,
/// absent objects, classes, the frame, max_distance_m, min_revision, and unknown space as REPORT or FREE.
struct TakenOptions {
  bool padding = false;
  bool attached = false;  ///< attached objects leave the world
  bool max_age = false;
  bool vacated = false;
  bool occupied = false;   ///< unknown space may be OCCUPIED
  bool tolerance = false;  ///< of distances
  bool allowed = false;    ///< allowed collisions
  bool carries = false;    ///< the query has a robot: poses and allowed collisions of attached objects
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

/// A request's options for a state of a map. INVALID_ARGUMENT for an invalid distance, pose, name, policy or length of
/// a list, or an unsupported option; NOT_FOUND for a missing submap. Errors name the field, "options.map_from_query",
/// and the first bad item of a list.
Result<DistanceQuestion> QueryOptionsFromProto(const v1::QueryOptions& options, const MapSnapshot& map,
                                               TakenOptions taken = {});
/// For queries that support only the frame and min_revision: p_map = T_map_query * p_query.
Result<Transform> FrameOptionsFromProto(const v1::QueryOptions& options);
/// The same for checks of bodies or motions, with unknown space OCCUPIED by default. `links`: of its bodies or spheres.
Result<CheckQuestion> CheckOptionsFromProto(const v1::QueryOptions& options, const RequestedLinks& links,
                                            const MapSnapshot& map, TakenOptions taken);

}  // namespace dhpmap
