// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "mapping/base/result.h"
#include "server/app/states/map_view.h"
#include "server/grpc/call_runner.h"

namespace dhpmap {

/// The revision that a query is to wait for; 0: none.
template <typename Request>
std::int64_t MinRevision(const Request& request) {
  if constexpr (requires { request.options().min_revision(); }) return request.options().min_revision();
  else return 0;
}

/// INVALID_ARGUMENT, reason BAD_REVISION, for a request that is to be answered from a state of before the revision that
/// it waits for.
Status CheckReadRevision(std::int64_t read_revision, std::int64_t min_revision);

/// The state that a request about maps/{map} is answered from: that of its read_revision, see dhpmap::ViewAt; else what
/// its stream has `pinned`, if anything; else the last published one. Every handler that reads a map comes by here.
Result<std::shared_ptr<const MapView>> ViewFor(const ServiceContext& context, const std::string& map,
                                               std::int64_t read_revision,
                                               std::shared_ptr<const MapView> pinned = nullptr);
template <typename Request>
Result<std::shared_ptr<const MapView>> ViewFor(const ServiceContext& context, const std::string& map,
                                               const Request& request,
                                               std::shared_ptr<const MapView> pinned = nullptr) {
  DHPMAP_RETURN_IF_ERROR(CheckReadRevision(request.read_revision(), MinRevision(request)));
  return ViewFor(context, map, request.read_revision(), std::move(pinned));
}

}  // namespace dhpmap
