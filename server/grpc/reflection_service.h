// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/impl/service_type.h>

#include <memory>
#include <string>
#include <vector>

#include "server/grpc/call_runner.h"
#include "server/grpc/open_streams.h"

namespace dhpmap {

/// gRPC's server reflection, v1 and v1alpha. They list themselves and `services`, by full names. gRPC's own service
/// parses requests of any size and holds a thread for as long as a stream is open; these do not. Context and streams
/// outlive them.
std::vector<std::unique_ptr<grpc::Service>> MakeReflectionServices(const ServiceContext& context, OpenStreams& streams,
                                                                   std::vector<std::string> services);

}  // namespace dhpmap
