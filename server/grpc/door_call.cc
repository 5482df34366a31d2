// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/door_call.h"

#include <grpc/grpc.h>

#include <utility>
#include <vector>

#include "server/auth/fleet_key.h"
#include "server/auth/rights.h"

namespace dhpmap {
namespace {

class DoorCall final : public grpc::CallbackServerContext {
 public:
  Caller caller;
  std::unique_ptr<auth::LiveStreams::Place> place;
};

/// Keeps the caller in the call's context. gRPC's AuthContext (1.51) belongs to a connection, and calls with different
/// keys share connections.
class CallAllocator final : public grpc::ContextAllocator {
 public:
  using grpc::ContextAllocator::Release;
  grpc::CallbackServerContext* NewCallbackServerContext() override { return new DoorCall; }
  /// Contexts of calls of unknown methods also come here. They are gRPC's own, and gRPC frees them.
  void Release(grpc::CallbackServerContext* call) override { delete dynamic_cast<DoorCall*>(call); }
};

std::string_view ViewOf(grpc::string_ref text) { return {text.data(), text.size()}; }

/// Callable from any thread, even if the call has just ended: gRPC keeps it while we hold a reference.
auth::LiveStreams::End EndOf(grpc_call* call) {
  grpc_call_ref(call);
  const std::shared_ptr<grpc_call> kept(call, [](grpc_call* held) { grpc_call_unref(held); });
  return [kept](const Status& why) {
    grpc_call_cancel_with_status(kept.get(), static_cast<grpc_status_code>(why.code()), why.message().c_str(), nullptr);
  };
}

}  // namespace

Status Caller::Check(google::protobuf::Message& request) const {
  return principal_ != nullptr ? auth::CheckRequest(*principal_, *needs_, request) : Status::Ok();
}

Status Caller::CheckMap(std::string_view map_id) const {
  return principal_ != nullptr ? auth::CheckMap(*principal_, map_id) : Status::Ok();
}

bool Caller::Owns(std::string_view author) const { return OwnsAll() || auth::IsOwnName(principal_->name, author); }

std::unique_ptr<grpc::ContextAllocator> MakeCallAllocator() { return std::make_unique<CallAllocator>(); }

Result<auth::PrincipalPtr> WhoCalls(auth::Gate& gate, const grpc::CallbackServerContext& call) {
  const auto& metadata = call.client_metadata();
  if (const auto ticket = metadata.find(auth::kTicketKey); ticket != metadata.end()) {
    auto principal = gate.tickets().Take(ViewOf(ticket->second));
    if (principal != nullptr) return principal;
    return Status(StatusCode::kUnauthenticated, "the ticket is none of this server's").WithReason("BAD_CREDENTIAL");
  }
  if (const auto key = metadata.find(auth::kFleetKeyKey); key != metadata.end()) {
    const auto principal = metadata.find(auth::kPrincipalKey);
    return gate.AuthenticateFleet({}, ViewOf(key->second),
                                  principal != metadata.end() ? ViewOf(principal->second) : std::string_view());
  }
  std::vector<std::string_view> keys;
  const auto [begin, end] = metadata.equal_range("authorization");
  for (auto value = begin; value != end; ++value) keys.push_back(ViewOf(value->second));
  return gate.Authenticate(keys);
}

Status Enter(auth::Gate& gate, const auth::CallNeeds* needs, const std::shared_ptr<ByteBudget>& inflight,
             grpc::CallbackServerContext& call) {
  if (!gate.has_keys()) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(auth::PrincipalPtr principal, WhoCalls(gate, call));
  return EnterAs(gate, std::move(principal), needs, inflight, call);
}

Status EnterAs(auth::Gate& gate, auth::PrincipalPtr principal, const auth::CallNeeds* needs,
               const std::shared_ptr<ByteBudget>& inflight, grpc::CallbackServerContext& call) {
  if (!gate.has_keys()) return Status::Ok();
  auto* door = dynamic_cast<DoorCall*>(&call);
  if (door == nullptr || needs == nullptr) return Internal("a call came in by no door");
  DHPMAP_RETURN_IF_ERROR(auth::CheckRole(*principal, *needs));
  DHPMAP_RETURN_IF_ERROR(gate.Count(*principal));
  if (needs->is_stream) {
    const bool is_feed = needs->need == v1::Access::FEED;
    DHPMAP_ASSIGN_OR_RETURN(door->place, gate.streams().Add(principal, is_feed, EndOf(call.c_call())));
  }
  std::shared_ptr<ByteBudget> budget = gate.BudgetOf(*principal, inflight);
  door->caller = Caller(std::move(principal), needs, std::move(budget));
  return Status::Ok();
}

const Caller& CallerOf(const grpc::CallbackServerContext& call) {
  static const Caller nobody;
  const auto* door = dynamic_cast<const DoorCall*>(&call);
  return door != nullptr ? door->caller : nobody;
}

}  // namespace dhpmap
