// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <utility>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "proto/types/metadata_keys.h"
#include "proto/types/resource_names.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/services.h"
#include "server/wire/mapping_conversion.h"
#include "server/wire/paging.h"

namespace dhpmap {
namespace {

constexpr char kSessionKey[] = "s";

class MappingService final : public CountedService<v1::MappingService> {
 public:
  MappingService(const ServiceContext& context, IntegrateStreams& streams)
      : CountedService(context), context_(context), streams_(streams) {
    Take(&MappingService::ListSessions, &MappingService::EndSession, &MappingService::FinishMapping);
    TakeStream<v1::IntegrateFramesRequest>(&MappingService::BeginFrames);
  }

  grpc::ServerBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer>* BeginFrames(grpc::CallbackServerContext* call) {
    const bool is_one = call->client_metadata().contains(kOneMessageKey);
    return IntegrateStream::Start(context_, CallerOf(*call), streams_,
                                  is_one ? IntegrateStream::Messages::kOne : IntegrateStream::Messages::kAny);
  }

  grpc::ServerUnaryReactor* ListSessions(grpc::CallbackServerContext*, const v1::ListSessionsRequest* request,
                                         v1::ListSessionsResponse* response) override {
    return Run(context_, {"MappingService/ListSessions", request, response, request->parent()}, [=, this]() -> Status {
      DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->parent(), "parent"));
      DHPMAP_ASSIGN_OR_RETURN(const auto open_map, context_.registry.GetOpen(name));
      const auto view = open_map->View();
      const PageMark now{.history_id = view->snapshot().info().history_id, .revision = view->snapshot().revision()};
      DHPMAP_ASSIGN_OR_RETURN(Pager pager, Pager::Begin(*request, now, *context_.registry.LostRevisionsOf(name)));
      response->set_revision(view->snapshot().revision());
      for (const SessionStatus& status : open_map->Sessions()) {
        const std::string key = kSessionKey + status.session;  // not empty, unlike the key of unnamed streams
        if (key <= pager.after()) continue;
        v1::FeedSession proto = ToProto(status, name);
        if (!pager.Takes(proto, key)) break;
        *response->add_sessions() = std::move(proto);
      }
      response->set_next_page_token(pager.NextToken());
      return Status::Ok();
    });
  }

  grpc::ServerUnaryReactor* EndSession(grpc::CallbackServerContext*, const v1::EndSessionRequest* request,
                                       v1::EndSessionResponse* response) override {
    return Run(context_, {.method = "MappingService/EndSession", .request = request, .opens = request->map()},
               [=, this]() -> Status {
                 DHPMAP_ASSIGN_OR_RETURN(const std::string name, ParseMapName(request->map(), "map"));
                 DHPMAP_ASSIGN_OR_RETURN(const auto open_map, context_.registry.GetOpen(name));
                 DHPMAP_RETURN_IF_ERROR(open_map->EndSession(request->session()));
                 response->set_revision(open_map->View()->snapshot().revision());
                 return Status::Ok();
               });
  }

  grpc::ServerUnaryReactor* FinishMapping(grpc::CallbackServerContext*, const v1::FinishMappingRequest* request,
                                          v1::FinishMappingResponse* response) override {
    return RunAsync(context_, {.method = "MappingService/FinishMapping", .request = request, .opens = request->map()},
                    [=, this](const Respond& respond, const std::stop_token& stop) {
                      const auto name = ParseMapName(request->map(), "map");
                      if (!name.ok()) return respond(name.status());
                      const auto open_map = context_.registry.GetOpen(*name);
                      if (!open_map.ok()) return respond(open_map.status());
                      (*open_map)->Finish(
                          [respond, response](const Result<FinishOutcome>& outcome) {
                            respond(RunGuarded([&]() -> Status {
                              if (!outcome.ok()) return outcome.status();
                              *response = ToProto(*outcome);
                              return Status::Ok();
                            }));
                          },
                          stop);
                    });
  }

 private:
  const ServiceContext& context_;
  IntegrateStreams& streams_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeMappingService(const ServiceContext& context, IntegrateStreams& streams) {
  return std::make_unique<MappingService>(context, streams);
}

}  // namespace dhpmap
