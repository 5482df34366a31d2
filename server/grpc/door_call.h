// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/server_context.h>

#include <memory>
#include <string>
#include <string_view>

#include "mapping/base/status.h"
#include "server/auth/gate.h"

namespace dhpmap {

/// What is asked of the messages of one call, by whom it is made; of no key, nothing. Outlives the call's context, as a
/// stream may. Value type.
class Caller {
 public:
  Caller() = default;
  Caller(auth::PrincipalPtr principal, const auth::CallNeeds* needs, std::shared_ptr<ByteBudget> budget)
      : principal_(std::move(principal)), needs_(needs), budget_(std::move(budget)) {}

  /// Null: keys are off.
  [[nodiscard]] const auth::Principal* principal() const { return principal_.get(); }

  /// What its calls may have in flight; null: as all together.
  [[nodiscard]] const std::shared_ptr<ByteBudget>& budget() const { return budget_; }

  /// PERMISSION_DENIED as of auth::CheckRequest; an author that is left empty is filled in.
  Status Check(google::protobuf::Message& request) const;
  /// Of a map that is named elsewhere than in a request.
  [[nodiscard]] Status CheckMap(std::string_view map_id) const;
  /// Whether lists show a map.
  [[nodiscard]] bool MaySee(std::string_view map_id) const { return CheckMap(map_id).ok(); }
  /// Whether it may undo edits of that author by name.
  [[nodiscard]] bool Owns(std::string_view author) const;
  [[nodiscard]] bool OwnsAll() const { return principal_ == nullptr || principal_->role == auth::Role::kAdmin; }

 private:
  auth::PrincipalPtr principal_;
  const auth::CallNeeds* needs_ = nullptr;
  std::shared_ptr<ByteBudget> budget_;
};

/// Makes gRPC's contexts of calls, with room for the caller.
std::unique_ptr<grpc::ContextAllocator> MakeCallAllocator();

/// Before a message of it is read: who makes the call, by its ticket or key; whether the role has what it needs, and
/// whether it comes within the caller's limits. A stream ends when the caller's key does. Once a call. `needs` is null
/// for a call that nothing is known of, which is refused. Without keys all is let in. Of `inflight` the caller gets a
/// part.
Status Enter(auth::Gate& gate, const auth::CallNeeds* needs, const std::shared_ptr<ByteBudget>& inflight,
             grpc::CallbackServerContext& call);

/// Who makes a call: by its ticket, which is good once, by what another server of the fleet says, or by its key. Errors
/// as of Gate::Authenticate and AuthenticateFleet.
Result<auth::PrincipalPtr> WhoCalls(auth::Gate& gate, const grpc::CallbackServerContext& call);
/// Enter of a call whose caller is known.
Status EnterAs(auth::Gate& gate, auth::PrincipalPtr principal, const auth::CallNeeds* needs,
               const std::shared_ptr<ByteBudget>& inflight, grpc::CallbackServerContext& call);

/// Of a call that has entered.
const Caller& CallerOf(const grpc::CallbackServerContext& call);

}  // namespace dhpmap
