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

/// The revision that a query waits for; 0: none.
template <typename Request>
std::int64_t MinRevision(const Request& request) {
  if constexpr (requires { request.options().min_revision(); }) return request.options().min_revision();
  else return 0;
}

/// The revision of the list's earlier page that the client has; 0: none.
template <typename Request>
std::int64_t RevisionOfPage(const Request& request) {
  if constexpr (requires { request.page_token(); }) return RevisionOfPageToken(request.page_token());
  else return 0;
}

/// INVALID_ARGUMENT, reason BAD_REVISION, if the requested state is older than the revision that the request waits for.
Status CheckReadRevision(std::int64_t read_revision, std::int64_t min_revision);

/// The state that a request asks for.
struct WantedState {
  std::int64_t read_revision = 0;
  bool is_eventual = false;   ///< any state that this process has will do,
  std::int64_t at_least = 0;  ///< but not older than a revision that the client has already seen, if possible
};

/// The state that answers a request about maps/{map}: its read_revision if it names one, see dhpmap::ViewAt; else the
/// state `pinned` by its stream; else the last published one, or with EVENTUAL that of MapRegistry::EventualViewOf.
/// Every handler that reads a map calls it.
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
