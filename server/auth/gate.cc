// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/gate.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "server/auth/map_owners_file.h"

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

std::shared_ptr<KeySource> SourceOf(const GateOptions& options) {
  return options.keys != nullptr ? options.keys : std::make_shared<KeyFileSource>(options.key_file);
}

Status KeysAreTooOld() {
  return Unavailable("the keys could not be read for too long: whether yours is still good is not known")
      .WithReason("DATABASE_UNREACHABLE");
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
      streams_(options_.limits),
      source_(SourceOf(options_)),
      longest_outage_s_(source_->longest_outage_s()) {}

std::shared_ptr<Gate> Gate::Open() { return std::shared_ptr<Gate>(new Gate(GateOptions{}, false)); }

Result<std::shared_ptr<Gate>> Gate::WithKeys(GateOptions options) {
  std::shared_ptr<Gate> gate(new Gate(std::move(options), true));
  DHPMAP_RETURN_IF_ERROR(gate->ReadKeys());
  if (!gate->options_.audit_file.empty()) {
    DHPMAP_ASSIGN_OR_RETURN(gate->audit_, AuditLog::Open(gate->options_.audit_file, gate->options_.now_s));
  }
  if (gate->options_.owners == nullptr) {
    DHPMAP_ASSIGN_OR_RETURN(gate->owners_, MapOwnersFile::Open(gate->options_.owners_file));
  }
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
  DHPMAP_ASSIGN_OR_RETURN(const auto ring, Ring());
  return ring->Find(key_text, options_.now_s());
}

Status Gate::CheckStill(const Principal& principal) const {
  if (!has_keys_) return Status::Ok();
  DHPMAP_ASSIGN_OR_RETURN(const auto ring, Ring());
  return ring->Check(principal, options_.now_s());
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
  if (options_.audit_table != nullptr) options_.audit_table->Write(entry);
  if (audit_ == nullptr) return Status::Ok();
  Status written = audit_->Write(entry);
  Tell(written, kAuditFault);
  return options_.is_audit_required && entry.decision.ok() ? written : Status::Ok();
}

void Gate::Look() {
  if (!has_keys_) return;
  Tell(ReadKeys(), kKeyFault);
  const auto ring = Ring();
  const std::int64_t now_s = options_.now_s();
  streams_.EndUnless(
      [&](const Principal& principal) { return ring.ok() ? (*ring)->Check(principal, now_s) : ring.status(); });
}

Status Gate::ReadKeys() {
  const MutexLock reading(source_mutex_);
  const double begin_s = options_.passing_s();
  DHPMAP_ASSIGN_OR_RETURN(const auto changed, source_->ReadIfChanged());
  const MutexLock lock(mutex_);
  read_at_s_ = begin_s;
  if (!changed) return Status::Ok();
  ring_ = std::make_shared<const KeyRing>(*changed);
  return Status::Ok();
}

void Gate::Tell(const Status& outcome, FaultKind kind) {
  {
    const MutexLock lock(mutex_);
    std::string& last = faults_[kind];
    if (outcome.ok()) last.clear();
    if (outcome.ok() || outcome.message() == last) return;
    last = outcome.message();
  }
  if (options_.on_fault) options_.on_fault(outcome);
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

Result<std::shared_ptr<const KeyRing>> Gate::Ring() const {
  const double now_s = options_.passing_s();
  const MutexLock lock(mutex_);
  if (now_s - read_at_s_ > longest_outage_s_) return KeysAreTooOld();
  return ring_;
}

}  // namespace dhpmap::auth
