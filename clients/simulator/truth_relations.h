// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/simulator/scene_builder.h"

namespace dhpmap::simulator {

/// Spatial relations between instances, by the rules below.
enum class TruthRelationKind : std::uint8_t { kOn, kIn, kHangsOn, kNextTo };

struct TruthRelation {
  TruthRelationKind kind = TruthRelationKind::kOn;
  std::uint8_t subject = 0;  ///< a thing
  std::uint8_t object = 0;   ///< a thing or stuff; for kNextTo a thing with a greater id
  double support = 0;        ///< for kOn: the share of supported feet
  double gap_m = 0;          ///< for kNextTo: length of the shortest free line
  double height_share = 0;   ///< for kNextTo
};

/// ON, IN, HANGS_ON or NEXT_TO, as in files.
const char* NameOf(TruthRelationKind kind);

/// The relations of a scene, sorted by subject, object and kind, computed from the exact solids to a centimetre,
/// whether or not they were seen. Up is z. Rules:
///   - A thing's feet are the columns of 1 cm in which its underside is less than 2 cm above its lowest point. It is ON
///     an object if that is the first surface of at least 30 % of its feet, from 5 cm above them (soft objects give
///     way) to 2 cm below.
///   - A thing is IN an object that is below its centre and either above it and around it in at least half of 16
///     horizontal directions (a shelf), or around it in at least 14 of them (a crate). Of nested objects the innermost
///     counts.
///   - A thing that is ON nothing HANGS_ON the object with most of its surface within 5 cm, if there is one.
///   - Two things are NEXT_TO each other if neither is ON or IN the other, a straight line of at most 0.5 m from one to
///     the nearest point of the other meets nothing else, and their heights overlap by at least half of the lower
///     one's.
std::vector<TruthRelation> RelationsOf(std::span<const Instance> instances, std::span<const Solid> solids);

}  // namespace dhpmap::simulator
