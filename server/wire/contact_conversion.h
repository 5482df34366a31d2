// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "dhpmap/v1/collision.pb.h"
#include "mapping/map/map.h"
#include "mapping/query/body_query.h"

namespace dhpmap {

// What answers about bodies and motions have in common.

inline constexpr int kDefaultContacts = 100, kMostContacts = 1000;
inline constexpr double kMostBody_m = 10, kMostReach_m = 1e6;

/// Whether a sphere of a request is of use: finite, no negative radius, nothing beyond bounds.
bool IsUsableSphere(const Eigen::Vector3d& center_m, double radius_m);

/// How many contacts are wanted of each item. INVALID_ARGUMENT for a number out of range, or more than a packed answer
/// has room for.
Result<std::size_t> MaxContactsFromProto(bool all_contacts, int max_contacts, bool packed);

v1::Contact ToProto(const BodyContact& contact, const MapInfo& map);

/// Whose it is, for arrays.
std::int64_t InstanceOf(const BodyContact& contact);
std::int32_t ClassOf(const BodyContact& contact);

}  // namespace dhpmap
