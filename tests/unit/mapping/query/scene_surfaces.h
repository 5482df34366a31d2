// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "mapping/query/body_query.h"
#include "mapping/surfaces/surface_cache.h"

namespace dhpmap::testing {

/// More bytes than the surfaces of any scene of these tests take.
inline constexpr std::size_t kPlenty = std::size_t{1} << 30;

inline constexpr BodyOptions kIgnoringUnknown{.unknown = UnknownSpace::kFree};

inline std::shared_ptr<const MapSurfaces> SurfacesOf(Map& map) {
  SurfaceCache cache(kPlenty);
  return cache.Of(map.Publish(0));
}

}  // namespace dhpmap::testing
