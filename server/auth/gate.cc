// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/gate.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dhpmap::auth {
namespace {

Status NoCredential() {
  return Status(StatusCode::kUnauthenticated, "this server wants a key: send 'authorization: Bearer dhp_...'")
      .WithReason("NO_CREDENTIAL");
}

/// The key in "Bearer dhp_...", the scheme in any case; empty for another scheme.
std::string_view KeyIn(std::string_view authorization) {
  constexpr std::string_view kScheme = "bearer ";
  if (authorization.size() < kScheme.size()) return {};
  const bool is_bearer = std::equal(kScheme.begin(), kScheme.end(), authorization.begin(),
                                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b); });
  return is_bearer ? authorization.substr(kScheme.size()) : std::string_view();
}

PrincipalPtr Local() {
  return std::make_shared<const Principal>(
      Principal{.name = "local", .role = Role::kAdmin, .maps = NamePatterns::All(), .sessions = NamePatterns::All()});
}

}  // namespace

Gate::Gate(GateOptions options, bool has_keys)
    : options_(std::move(options)),
      has_keys_(has_keys),
      calls_(CallTable::OfLinkedServices()),
      local_(Local()),
      rates_(options_.limits, options_.passing_s),
      failed_logins_(options_.passing_s),
      tickets_(options_.randomness),
      logins_(options_.randomness),
      budgets_(options_.limits.inflight_fraction),
      streams_(options_.limits) {}

std::shared_ptr<Gate> Gate::Open() { return std::shared_ptr<Gate>(new Gate(GateOptions{}, false)); }

Result<std::shared_ptr<Gate>> Gate::WithKeys(GateOptions options) {
  std::shared_ptr<Gate> gate(new Gate(std::move(options), true));
  DHPMAP_RETURN_IF_ERROR(gate->Load());
  if (!gate->options_.audit_file.empty()) {
    DHPMAP_ASSIGN_OR_RETURN(gate->audit_, AuditLog::Open(gate->options_.audit_file, gate->options_.now_s));
  }
  DHPMAP_ASSIGN_OR_RETURN(gate->owners_, MapOwners::Open(gate->options_.owners_file));
  if (gate->options_.look_s > 0) gate->looker_ = std::thread([&gate = *gate] { gate.LookAgainAndAgain(); });
  return gate;
}

Gate::~Gate() {
  {
    const MutexLock lock(mutex_);
    is_ending_ = true;
  }
  changed_.NotifyAll();
  if (looker_.joinable()) looker_.join();
}

Result<PrincipalPtr> Gate::Authenticate(const std::vector<std::string_view>& authorizations) const {
  if (!has_keys_) return local_;
  if (authorizations.size() > 1) {
    return InvalidArgument("the call shows more than one key").WithReason("AMBIGUOUS_CREDENTIAL");
  }
  if (authorizations.empty()) return NoCredential();
  return AuthenticateKey(KeyIn(authorizations.front()));
}

Result<PrincipalPtr> Gate::AuthenticateFrom(std::string_view address,
                                            const std::vector<std::string_view>& authorizations) {
  auto principal = Authenticate(authorizations);
  // Only a wrong key is a guess: a call without a key guesses nothing, and a revoked or expired key was right once.
  if (!address.empty() && principal.status().reason() == Reason("BAD_CREDENTIAL")) {
    DHPMAP_RETURN_IF_ERROR(failed_logins_.Count(address));
  }
  return principal;
}

Result<PrincipalPtr> Gate::AuthenticateFleet(std::string_view address, std::string_view fleet_key,
                                             std::string_view principal) {
  if (fleet_key_ == nullptr || !fleet_key_->Is(fleet_key)) {
    if (!address.empty()) DHPMAP_RETURN_IF_ERROR(failed_logins_.Count(address));
    return Status(StatusCode::kUnauthenticated, "the fleet key is not that of this server")
        .WithReason("BAD_CREDENTIAL");
  }
  return has_keys_ ? PrincipalFromText(principal) : Result<PrincipalPtr>(local_);
}

Result<PrincipalPtr> Gate::AuthenticateKey(std::string_view key_text) const {
  if (!has_keys_) return local_;
  return Ring()->Find(key_text, options_.now_s());
}

Status Gate::CheckStill(const Principal& principal) const {
  return has_keys_ ? Ring()->Check(principal, options_.now_s()) : Status::Ok();
}

Result<PrincipalPtr> Gate::AuthenticateLogin(std::string_view word) {
  PrincipalPtr principal = logins_.Find(word, options_.now_s());
  if (principal == nullptr) {
    return Status(StatusCode::kUnauthenticated, "nobody is logged in by this cookie, or no longer")
        .WithReason("BAD_CREDENTIAL");
  }
  DHPMAP_RETURN_IF_ERROR(CheckStill(*principal));
  return principal;
}

Status Gate::Audit(const AuditEntry& entry) {
  if (audit_ == nullptr) return Status::Ok();
  Status written = audit_->Write(entry);
  Tell(written);
  return options_.is_audit_required && entry.decision.ok() ? written : Status::Ok();
}

void Gate::Look() {
  if (!has_keys_) return;
  const auto state = StateOfKeyFile(options_.key_file);
  const bool is_changed = [&] {
    const MutexLock lock(mutex_);
    return !state.ok() || *state != state_;
  }();
  Tell(!state.ok() ? state.status() : is_changed ? Load() : Status::Ok());
  const auto ring = Ring();
  const std::int64_t now_s = options_.now_s();
  streams_.EndUnless([&](const Principal& principal) { return ring->Check(principal, now_s); });
}

Status Gate::Load() {
  auto content = ReadKeyFile(options_.key_file);
  const MutexLock lock(mutex_);
  state_ = content.ok() ? content->state : FileState{};  // a file that cannot be read is tried again at the next look
  if (!content.ok()) return content.status();
  ring_ = std::make_shared<const KeyRing>(content->records);
  fault_.clear();
  return Status::Ok();
}

void Gate::Tell(const Status& fault) {
  {
    const MutexLock lock(mutex_);
    if (fault.ok() || fault.message() == fault_) return;
    fault_ = fault.message();
  }
  if (options_.on_fault) options_.on_fault(fault);
}

void Gate::LookAgainAndAgain() {
  const auto pause =
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(options_.look_s));
  for (;;) {
    {
      const MutexLock lock(mutex_);
      if (changed_.WaitFor(mutex_, pause, [this]() DHPMAP_REQUIRES(mutex_) { return is_ending_; })) return;
    }
    Look();
  }
}

std::shared_ptr<const KeyRing> Gate::Ring() const {
  const MutexLock lock(mutex_);
  return ring_;
}

}  // namespace dhpmap::auth
