// SPDX-License-Identifier: BSD-3-Clause
#include "dhpmap/v1/auth_service.grpc.pb.h"
#include "server/grpc/counted_service.h"
#include "server/grpc/services.h"

namespace dhpmap {
namespace {

void Tell(const auth::Principal& principal, v1::WhoAmIResponse& response) {
  response.set_principal(principal.name);
  response.set_key_id(principal.key_id);
  response.set_role(std::string(auth::NameOf(principal.role)));
  for (const std::string& pattern : principal.maps.texts()) response.add_map_patterns(pattern);
  for (const std::string& pattern : principal.sessions.texts()) response.add_session_patterns(pattern);
  if (principal.expires_s != auth::kNever_s) response.mutable_expire_time()->set_seconds(principal.expires_s);
}

class AuthService final : public CountedService<v1::AuthService> {
 public:
  explicit AuthService(const ServiceContext& context) : CountedService(context), context_(context) {
    Take(&AuthService::WhoAmI);
  }

  grpc::ServerUnaryReactor* WhoAmI(grpc::CallbackServerContext* call, const v1::WhoAmIRequest* request,
                                   v1::WhoAmIResponse* response) override {
    return Run(context_, {"AuthService/WhoAmI", request, response}, [=, this, caller = CallerOf(*call)]() -> Status {
      if (caller.principal() != nullptr) {
        Tell(*caller.principal(), *response);
        return Status::Ok();
      }
      DHPMAP_ASSIGN_OR_RETURN(const auth::PrincipalPtr local, context_.options.gate->Authenticate({}));
      Tell(*local, *response);
      return Status::Ok();
    });
  }

 private:
  const ServiceContext& context_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeAuthService(const ServiceContext& context) {
  return std::make_unique<AuthService>(context);
}

}  // namespace dhpmap
