// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/impl/service_type.h>

#include <memory>
#include <string>
#include <vector>

#include "server/grpc/call_runner.h"
#include "server/grpc/open_streams.h"

namespace dhpmap {

/// gRPC's server reflection, v1 and v1alpha, which tell of themselves and of `services`, by their full names. In place
/// of gRPC's own, which parses what comes, however large, and keeps it, with a thread, as long as a stream is open.
/// Context and streams outlive them.
std::vector<std::unique_ptr<grpc::Service>> MakeReflectionServices(const ServiceContext& context, OpenStreams& streams,
                                                                   std::vector<std::string> services);

}  // namespace dhpmap
