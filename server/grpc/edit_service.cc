// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>
#include <vector>

#include "dhpmap/v1/edit_service.grpc.pb.h"
#include "server/app/edit_list.h"
#include "server/grpc/services.h"
#include "server/wire/edit_conversion.h"
#include "server/wire/types/resource_names.h"

namespace dhpmap {
namespace {

class EditService final : public v1::EditService::CallbackService {
 public:
  explicit EditService(const ServiceContext& context) : context_(context) {}

  grpc::ServerUnaryReactor* ApplyEdits(grpc::CallbackServerContext*, const v1::ApplyEditsRequest* request,
                                       v1::ApplyEditsResponse* response) override {
    return RunAsync(context_, {"EditService/ApplyEdits", request},
                    [=, this](const Respond& respond, const std::stop_token&) {
                      const Status begun = Begin(*request, *response, respond);
                      if (!begun.ok()) respond(begun);
                    });
  }

 private:
  /// What the writer's thread makes, and the answer tells.
  using Results = std::vector<EditResult>;

  Status Begin(const v1::ApplyEditsRequest& request, v1::ApplyEditsResponse& response, const Respond& respond) {
    DHPMAP_ASSIGN_OR_RETURN(const std::string map, ParseMapName(request.map(), "map"));
    DHPMAP_ASSIGN_OR_RETURN(const auto view, context_.registry.ViewOf(map));
    DHPMAP_ASSIGN_OR_RETURN(EditList list, EditListFromProto(request, map, *view->snapshot().info().label_set));
    DHPMAP_ASSIGN_OR_RETURN(const auto session, context_.registry.OpenSession(map));
    const auto results = std::make_shared<Results>();
    const auto change = [results,
                         list = std::make_shared<const EditList>(std::move(list))](Map& edited) -> Result<SubmapId> {
      DHPMAP_ASSIGN_OR_RETURN(*results, dhpmap::ApplyEdits(*list, edited));
      return SubmapId();  // the answer names all of them
    };
    const auto answer = [respond, results, map, &response](const Result<EditOutcome>& outcome) {
      respond(RunGuarded([&]() -> Status {
        if (!outcome.ok()) return outcome.status();
        response.set_revision(outcome->view->snapshot().revision());
        for (const EditResult& result : *results) *response.add_results() = ToProto(result, map);
        return Status::Ok();
      }));
    };
    session->Edit(change, answer, request.validate_only() ? EditMode::kTryOnly : EditMode::kMake);
    return Status::Ok();
  }

  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeEditService(const ServiceContext& context) {
  return std::make_unique<EditService>(context);
}

}  // namespace dhpmap
