// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/impl/service_type.h>

#include <memory>

#include "server/grpc/call_runner.h"
#include "server/grpc/integrate_stream.h"
#include "server/grpc/query_stream.h"
#include "server/grpc/watch_stream.h"

namespace dhpmap {

// One .cc file per service. The context and the streams outlive the service.
std::unique_ptr<grpc::Service> MakeAuthService(const ServiceContext& context);
std::unique_ptr<grpc::Service> MakeMapService(const ServiceContext& context);
std::unique_ptr<grpc::Service> MakeMappingService(const ServiceContext& context, IntegrateStreams& streams);
std::unique_ptr<grpc::Service> MakeFleetService(const ServiceContext& context);
std::unique_ptr<grpc::Service> MakeServerService(const ServiceContext& context);
std::unique_ptr<grpc::Service> MakeSubmapService(const ServiceContext& context);
std::unique_ptr<grpc::Service> MakeEditService(const ServiceContext& context);
std::unique_ptr<grpc::Service> MakeQueryService(const ServiceContext& context, OpenStreams& streams);
std::unique_ptr<grpc::Service> MakeWatchService(const ServiceContext& context, WatchStreams& streams);

}  // namespace dhpmap
