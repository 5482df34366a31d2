// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "server/auth/audit_log.h"
#include "server/auth/audit_table.h"
#include "server/auth/call_limits.h"
#include "server/auth/call_needs.h"
#include "server/auth/caller_budgets.h"
#include "server/auth/failed_logins.h"
#include "server/auth/fleet_key.h"
#include "server/auth/keys/key_ring.h"
#include "server/auth/keys/key_source.h"
#include "server/auth/keys/utc_text.h"
#include "server/auth/live_streams.h"
#include "server/auth/login_sessions.h"
#include "server/auth/map_owners.h"
#include "server/auth/tickets.h"

namespace dhpmap::auth {

struct GateOptions {
  std::string key_file;
  std::string audit_file;          ///< empty: no such file
  bool is_audit_required = false;  ///< a change that cannot be recorded in the file is refused
  std::string owners_file;         ///< see MapOwnersFile; empty: not stored
  // Of servers that share a database: in place of key_file and owners_file, and beside audit_file.
  std::shared_ptr<KeySource> keys = {};
  std::shared_ptr<MapOwners> owners = {};
  std::shared_ptr<AuditTable> audit_table = {};
  CallLimits limits;
  /// Period in s of looking for changed and expired keys; 0: only when Look is called.
  double look_s = 0.25;
  WallClock now_s = SystemWallClock();
  PassingTime passing_s = SystemPassingTime();
  Randomness randomness = SystemRandomness();
  /// Called with the reason when keys or a file cannot be used; the last good content stays in force. For the log.
  std::function<void(const Status&)> on_fault;
};

/// Authenticates and authorizes the calls of both doors. Thread-safe; outlives the doors.
class Gate {
 public:
  /// Without keys: every caller is the principal "local", an admin, and nothing is checked.
  static std::shared_ptr<Gate> Open();
  /// Errors as of KeySource. A source without keys is valid: then nobody is admitted.
  static Result<std::shared_ptr<Gate>> WithKeys(GateOptions options);
  ~Gate();
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  [[nodiscard]] bool has_keys() const { return has_keys_; }
  /// Not OK: an rpc does not declare who may call it, and the server must not serve.
  [[nodiscard]] Status CheckCalls() const { return calls_.ok() ? Status::Ok() : calls_.status(); }
  /// Requires CheckCalls to be OK. Null for an unknown rpc.
  [[nodiscard]] const CallNeeds* NeedsOf(std::string_view path) const { return calls_->Find(path); }

  /// The principal of a key: "Bearer dhp_...", as in the header or metadata `authorization`. `authorizations` are all
  /// values of it. UNAUTHENTICATED, reason NO_CREDENTIAL, without a key, or as in KeyRing::Find; INVALID_ARGUMENT,
  /// reason AMBIGUOUS_CREDENTIAL, for several. Without keys every caller is "local".
  [[nodiscard]] Result<PrincipalPtr> Authenticate(const std::vector<std::string_view>& authorizations) const;
  /// The same for a caller at `address` (net::PeerKey; empty: unknown). An address with too many wrong keys gets the
  /// error of FailedLogins::Count in place of BAD_CREDENTIAL; a valid key is admitted all the same.
  [[nodiscard]] Result<PrincipalPtr> AuthenticateFrom(std::string_view address,
                                                      const std::vector<std::string_view>& authorizations);
  /// UNAVAILABLE, reason DATABASE_UNREACHABLE, once the keys have not been read for longer than KeySource allows.
  [[nodiscard]] Result<PrincipalPtr> AuthenticateKey(std::string_view key_text) const;
  /// Who asks through another server of the fleet, which shows `fleet_key` and names `principal`. UNAUTHENTICATED,
  /// reason BAD_CREDENTIAL, counted by address as a wrong key is, unless the key is that of TakeFleetKey.
  [[nodiscard]] Result<PrincipalPtr> AuthenticateFleet(std::string_view address, std::string_view fleet_key,
                                                       std::string_view principal);
  /// By which servers of the fleet know each other. To be called before a door opens; null: none are known.
  void TakeFleetKey(std::shared_ptr<const FleetKey> key) { fleet_key_ = std::move(key); }
  [[nodiscard]] const FleetKey* fleet_key() const { return fleet_key_.get(); }
  /// Whether who was let in before is still.
  [[nodiscard]] Status CheckStill(const Principal& principal) const;

  /// Begins a browser's login session and returns its token. The session ends with the key.
  std::string LogIn(PrincipalPtr principal) { return logins_.Begin(std::move(principal), options_.now_s()); }
  /// The principal of a login session. UNAUTHENTICATED, reason BAD_CREDENTIAL, for an unknown token, or as of
  /// CheckStill.
  [[nodiscard]] Result<PrincipalPtr> AuthenticateLogin(std::string_view word);
  void LogOut(std::string_view word) { logins_.End(word); }

  /// Counts one call of the principal. RESOURCE_EXHAUSTED, reason OUT_OF_QUOTA.
  Status Count(const Principal& principal) { return has_keys_ ? rates_.Count(principal.name) : Status::Ok(); }

  /// The principal's budget of bytes in flight, within `all`; without keys `all` itself. Lives as long as the gate.
  std::shared_ptr<ByteBudget> BudgetOf(const Principal& principal, const std::shared_ptr<ByteBudget>& all) {
    return has_keys_ ? budgets_.Of(principal.name, all) : all;
  }
  [[nodiscard]] const CallLimits& limits() const { return options_.limits; }
  /// Records which principal created which map; null without keys.
  [[nodiscard]] MapOwners* owners() { return options_.owners != nullptr ? options_.owners.get() : owners_.get(); }

  [[nodiscard]] Tickets& tickets() { return tickets_; }
  [[nodiscard]] LiveStreams& streams() { return streams_; }

  /// Records the decision on a call that changes something, or on any refused call. A failed write is reported to
  /// on_fault and ignored, unless the audit log is required: then an admitted call gets the error of AuditLog::Write
  /// and is refused.
  Status Audit(const AuditEntry& entry) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool has_audit() const { return audit_ != nullptr; }
  /// See AuditLog::Reopen; OK without an audit log.
  Status ReopenAudit() { return audit_ != nullptr ? audit_->Reopen() : Status::Ok(); }

  /// Rows of the audit log that its table lacks, see AuditTable.
  [[nodiscard]] std::int64_t num_audit_dropped() const {
    return options_.audit_table != nullptr ? options_.audit_table->num_dropped() : 0;
  }

  /// Reads the keys again if they have changed, and ends the streams of keys that are no longer valid.
  void Look() DHPMAP_EXCLUDES(source_mutex_, mutex_);

 private:
  Gate(GateOptions options, bool has_keys);
  Status ReadKeys() DHPMAP_EXCLUDES(source_mutex_, mutex_);
  void LookAgainAndAgain() DHPMAP_EXCLUDES(source_mutex_, mutex_);
  [[nodiscard]] Result<std::shared_ptr<const KeyRing>> Ring() const DHPMAP_EXCLUDES(mutex_);
  enum FaultKind { kKeyFault, kAuditFault };
  /// Calls on_fault with an error, unless the last outcome of this kind was the same.
  void Tell(const Status& outcome, FaultKind kind) DHPMAP_EXCLUDES(mutex_);

  const GateOptions options_;
  const bool has_keys_;
  const Result<CallTable> calls_;
  const PrincipalPtr local_;
  std::shared_ptr<const FleetKey> fleet_key_;  ///< constant once a door is open
  CallRates rates_;
  FailedLogins failed_logins_;
  Tickets tickets_;
  LoginSessions logins_;
  std::unique_ptr<AuditLog> audit_;  ///< the file; may be null
  CallerBudgets budgets_;
  std::unique_ptr<MapOwners> owners_;  ///< those of a file
  LiveStreams streams_;

  Mutex source_mutex_;  ///< taken before the other
  std::shared_ptr<KeySource> source_ DHPMAP_GUARDED_BY(source_mutex_);
  const double longest_outage_s_;
  mutable Mutex mutex_;
  CondVar changed_;
  bool is_ending_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::shared_ptr<const KeyRing> ring_ DHPMAP_GUARDED_BY(mutex_);
  double read_at_s_ DHPMAP_GUARDED_BY(mutex_) = 0;  ///< of passing_s: when the keys were known to be up to date
  std::array<std::string, 2> faults_ DHPMAP_GUARDED_BY(mutex_);  ///< the last of each kind; empty: none since
  std::thread looker_;
};

}  // namespace dhpmap::auth
