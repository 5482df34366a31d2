// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "dhpmap/v1/query_options.pb.h"
#include "mapping/base/result.h"
#include "server/app/states/map_view.h"
#include "server/grpc/call_runner.h"
#include "server/wire/paging.h"

namespace dhpmap {

/// The revision that a query is to wait for; 0: none.
template <typename Request>
std::int64_t MinRevision(const Request& request) {
  if constexpr (requires { request.options().min_revision(); }) return request.options().min_revision();
  else return 0;
}

/// The revision that the client has seen a page of a list of; 0: none.
template <typename Request>
std::int64_t RevisionOfPage(const Request& request) {
  if constexpr (requires { request.page_token(); }) return RevisionOfPageToken(request.page_token());
  else return 0;
}

/// INVALID_ARGUMENT, reason BAD_REVISION, for a request that is to be answered from a state of before the revision that
/// it waits for.
Status CheckReadRevision(std::int64_t read_revision, std::int64_t min_revision);

/// What a request says of the state that it wants.
struct WantedState {
  std::int64_t read_revision = 0;
  bool is_eventual = false;   ///< any state that this process has will do,
  std::int64_t at_least = 0;  ///< but one that was told to the client before rather than an older one
};

/// The state that a request about maps/{map} is answered from: that of its read_revision, see dhpmap::ViewAt; else what
/// its stream has `pinned`, if anything; else the last published one, or with EVENTUAL that of
/// MapRegistry::EventualViewOf. Every handler that reads a map comes by here.
Result<std::shared_ptr<const MapView>> ViewFor(const ServiceContext& context, const std::string& map,
                                               const WantedState& wanted,
                                               std::shared_ptr<const MapView> pinned = nullptr);
template <typename Request>
Result<std::shared_ptr<const MapView>> ViewFor(const ServiceContext& context, const std::string& map,
                                               const Request& request,
                                               std::shared_ptr<const MapView> pinned = nullptr) {
  DHPMAP_RETURN_IF_ERROR(CheckReadRevision(request.read_revision(), MinRevision(request)));
  const bool is_eventual = request.consistency() == v1::Consistency::EVENTUAL;
  const WantedState wanted{request.read_revision(), is_eventual, RevisionOfPage(request)};
  return ViewFor(context, map, wanted, std::move(pinned));
}

}  // namespace dhpmap
