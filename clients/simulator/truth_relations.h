// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "clients/simulator/scene_builder.h"

namespace dhpmap::simulator {

/// How one instance lies to another, by the rules below.
enum class TruthRelationKind : std::uint8_t { kOn, kIn, kHangsOn, kNextTo };

struct TruthRelation {
  TruthRelationKind kind = TruthRelationKind::kOn;
  std::uint8_t subject = 0;  ///< a thing
  std::uint8_t object = 0;   ///< a thing or stuff; of kNextTo a thing of greater id
  double support = 0;        ///< of kOn: the share of feet
  double gap_m = 0;          ///< of kNextTo: the shortest such line
  double height_share = 0;   ///< of kNextTo
};

/// ON, IN, HANGS_ON or NEXT_TO, as in files.
const char* NameOf(TruthRelationKind kind);

/// What of a scene is on, in or next to what, by ascending subject, object and kind: of the exact solids, to a
/// centimetre, however little of them was seen. Up is z. The rules:
///   - A thing's feet are the columns of 1 cm in which its underside is less than 2 cm above its lowest point. It is ON
///     what at least 30 % of its feet have as the first surface from 5 cm above them (what is soft gives way) to 2 cm
///     below.
///   - A thing is IN what lies below its middle and either above it and around it in at least half of 16 horizontal
///     directions (a shelf), or around it in at least 14 of them (a crate); of things in each other the innermost.
///   - What is ON nothing HANGS_ON what has most of its surface within 5 cm, if anything has.
///   - Two things are NEXT_TO each other if neither is ON or IN the other, a straight line of at most 0.5 m from one to
///     what of the other is nearest there meets nothing else, and their heights share at least half of the lower one's.
std::vector<TruthRelation> RelationsOf(std::span<const Instance> instances, std::span<const Solid> solids);

}  // namespace dhpmap::simulator
