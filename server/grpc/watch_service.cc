// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "dhpmap/v1/watch_service.grpc.pb.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/services.h"
#include "server/grpc/watch_stream.h"

namespace dhpmap {
namespace {

class WatchService final : public CountedService<v1::WatchService> {
 public:
  WatchService(const ServiceContext& context, WatchStreams& streams)
      : CountedService(context), context_(context), streams_(streams) {
    Take(&WatchService::WatchMap);
  }

  grpc::ServerWriteReactor<v1::WatchMapResponse>* WatchMap(grpc::CallbackServerContext*,
                                                           const v1::WatchMapRequest* request) override {
    return WatchStream::Start(context_, streams_, *request);
  }

 private:
  const ServiceContext& context_;
  WatchStreams& streams_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeWatchService(const ServiceContext& context, WatchStreams& streams) {
  return std::make_unique<WatchService>(context, streams);
}

}  // namespace dhpmap
