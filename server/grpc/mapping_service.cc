// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "dhpmap/v1/mapping_service.grpc.pb.h"
#include "server/grpc/resource_names.h"
#include "server/grpc/services.h"

namespace dhpmap {
namespace {

v1::Refinement ToProto(const RefinementReport& report) {
  v1::Refinement proto;
  proto.set_num_shared_voxels(report.management.num_shared_voxels);
  proto.set_num_moved_voxels(report.management.num_moved_voxels);
  proto.set_num_removed_submaps(report.management.num_removed_submaps);
  proto.set_num_skipped_submaps(report.management.num_skipped_submaps);
  proto.set_num_crf_voxels(report.crf.num_voxels);
  proto.set_num_changed_classes(report.crf.num_changed_classes);
  proto.set_num_changed_instances(report.crf.num_changed_instances);
  proto.set_num_dropped_bytes(report.num_bytes_dropped);
  proto.set_management_s(report.management_s);
  proto.set_crf_s(report.crf_s);
  return proto;
}

class MappingService final : public v1::MappingService::CallbackService {
 public:
  MappingService(const ServiceContext& context, IntegrateStreams& streams) : context_(context), streams_(streams) {}

  grpc::ServerBidiReactor<v1::IntegrateFramesRequest, v1::IntegrateFramesResponse>* IntegrateFrames(
      grpc::CallbackServerContext*) override {
    return IntegrateStream::Start(context_, streams_);
  }

  grpc::ServerUnaryReactor* FinishMapping(grpc::CallbackServerContext* call, const v1::FinishMappingRequest* request,
                                          v1::FinishMappingResponse* response) override {
    return RunAsync(context_, call, "MappingService/FinishMapping", [=, this](const Respond& respond) {
      const auto name = ParseMapName(request->map(), "map");
      if (!name.ok()) return respond(name.status());
      const auto session = context_.registry.OpenSession(*name);
      if (!session.ok()) return respond(session.status());
      (*session)->Finish([respond, response](const Result<FinishOutcome>& outcome) {
        if (!outcome.ok()) return respond(outcome.status());
        const MapSnapshot& snapshot = outcome->view->snapshot();
        response->set_revision(snapshot.revision());
        response->set_num_frames(snapshot.info().num_frames);
        response->set_num_submaps(static_cast<std::int64_t>(snapshot.submaps().size()));
        *response->mutable_refinement() = ToProto(outcome->refinement);
        respond(Status::Ok());
      });
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
