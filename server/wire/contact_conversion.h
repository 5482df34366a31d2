// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "dhpmap/v1/collision.pb.h"
#include "mapping/map/map.h"
#include "mapping/query/body_query.h"

namespace dhpmap {

// Common parts of answers about bodies and motions.

inline constexpr int kDefaultContacts = 100, kMostContacts = 1000;
inline constexpr double kMostBody_m = 10, kMostReach_m = 1e6;

/// Whether a sphere of a request is valid: finite, no negative radius, within bounds.
bool IsUsableSphere(const Eigen::Vector3d& center_m, double radius_m);

/// Requested contacts of each item. INVALID_ARGUMENT for a number out of range, or more than a packed answer can hold.
Result<std::size_t> MaxContactsFromProto(bool all_contacts, int max_contacts, bool packed);

v1::Contact ToProto(const BodyContact& contact, const MapInfo& map);

/// Instance id of a contact, for columns.
std::int64_t InstanceOf(const BodyContact& contact);
std::int32_t ClassOf(const BodyContact& contact);

}  // namespace dhpmap
