// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "mapping/base/mutex.h"
#include "mapping/base/result.h"
#include "server/auth/audit_log.h"
#include "server/auth/call_limits.h"
#include "server/auth/call_needs.h"
#include "server/auth/caller_budgets.h"
#include "server/auth/failed_logins.h"
#include "server/auth/keys/key_file.h"
#include "server/auth/keys/key_ring.h"
#include "server/auth/keys/utc_text.h"
#include "server/auth/live_streams.h"
#include "server/auth/login_sessions.h"
#include "server/auth/map_owners.h"
#include "server/auth/tickets.h"

namespace dhpmap::auth {

struct GateOptions {
  std::string key_file;
  std::string audit_file;          ///< empty: none is written
  bool is_audit_required = false;  ///< what cannot be written down is not done
  std::string owners_file;         ///< see MapOwners; empty: they are forgotten with the process
  CallLimits limits;
  /// s between looks at the file and at what has expired; 0: only when Look is called.
  double look_s = 0.25;
  WallClock now_s = SystemWallClock();
  PassingTime passing_s = SystemPassingTime();
  Randomness randomness = SystemRandomness();
  /// Told why the file cannot be used as it is now; what it had before goes on. For the log.
  std::function<void(const Status&)> on_fault;
};

/// What both doors ask who calls, and whether they may. Thread-safe; outlives the doors.
class Gate {
 public:
  /// Without keys: whoever asks is the principal "local", an admin, and everything goes on unchecked.
  static std::shared_ptr<Gate> Open();
  /// Errors as of ReadKeyFile. A file without keys is one: then nobody comes in.
  static Result<std::shared_ptr<Gate>> WithKeys(GateOptions options);
  ~Gate();
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  [[nodiscard]] bool has_keys() const { return has_keys_; }
  /// Not OK: an rpc does not say who may call it, and nothing must be served.
  [[nodiscard]] Status CheckCalls() const { return calls_.ok() ? Status::Ok() : calls_.status(); }
  /// Needs CheckCalls to be OK. Null for an rpc that there is not.
  [[nodiscard]] const CallNeeds* NeedsOf(std::string_view path) const { return calls_->Find(path); }

  /// Whose key that is: "Bearer dhp_...", as in the header or metadata `authorization`, all values of it together.
  /// UNAUTHENTICATED, reason NO_CREDENTIAL, if there is none, and as of KeyRing::Find; INVALID_ARGUMENT, reason
  /// AMBIGUOUS_CREDENTIAL, if there are several. Without keys everybody is "local".
  [[nodiscard]] Result<PrincipalPtr> Authenticate(const std::vector<std::string_view>& authorizations) const;
  /// The same of a caller at `address` (net::PeerKey; empty: none is known). Of wrong keys from one that has shown too
  /// many, as of FailedLogins::Count in place of BAD_CREDENTIAL; a good one is let in all the same.
  [[nodiscard]] Result<PrincipalPtr> AuthenticateFrom(std::string_view address,
                                                      const std::vector<std::string_view>& authorizations);
  [[nodiscard]] Result<PrincipalPtr> AuthenticateKey(std::string_view key_text) const;
  /// Whether who was let in before is still.
  [[nodiscard]] Status CheckStill(const Principal& principal) const;

  /// Logs a browser in: the word of its session. It ends with its key.
  std::string LogIn(PrincipalPtr principal) { return logins_.Begin(std::move(principal), options_.now_s()); }
  /// Whose session that is. UNAUTHENTICATED, reason BAD_CREDENTIAL, if it is none, and as of CheckStill.
  [[nodiscard]] Result<PrincipalPtr> AuthenticateLogin(std::string_view word);
  void LogOut(std::string_view word) { logins_.End(word); }

  /// Who asks may begin one call more. RESOURCE_EXHAUSTED, reason OUT_OF_QUOTA.
  Status Count(const Principal& principal) { return has_keys_ ? rates_.Count(principal.name) : Status::Ok(); }

  /// What the principal may have in flight of `all`, which counts there, too; without keys `all` itself. Lives as long
  /// as the gate.
  std::shared_ptr<ByteBudget> BudgetOf(const Principal& principal, const std::shared_ptr<ByteBudget>& all) {
    return has_keys_ ? budgets_.Of(principal.name, all) : all;
  }
  [[nodiscard]] const CallLimits& limits() const { return options_.limits; }
  /// Who has made which map; null without keys.
  [[nodiscard]] MapOwners* owners() { return owners_.get(); }

  [[nodiscard]] Tickets& tickets() { return tickets_; }
  [[nodiscard]] LiveStreams& streams() { return streams_; }

  /// Writes down what was decided of a call that changes something, or of any that was refused. What cannot be written
  /// is told as a fault, and goes on; where it is required, as of AuditLog::Write, and a call that was let in is
  /// refused by that.
  Status Audit(const AuditEntry& entry) DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] bool has_audit() const { return audit_ != nullptr; }
  /// See AuditLog::Reopen; OK where there is none.
  Status ReopenAudit() { return audit_ != nullptr ? audit_->Reopen() : Status::Ok(); }

  /// Reads the file again if it has changed, and ends the streams of keys that are good no longer.
  void Look() DHPMAP_EXCLUDES(mutex_);

 private:
  Gate(GateOptions options, bool has_keys);
  Status Load() DHPMAP_EXCLUDES(mutex_);
  void LookAgainAndAgain() DHPMAP_EXCLUDES(mutex_);
  [[nodiscard]] std::shared_ptr<const KeyRing> Ring() const DHPMAP_EXCLUDES(mutex_);
  void Tell(const Status& fault) DHPMAP_EXCLUDES(mutex_);

  const GateOptions options_;
  const bool has_keys_;
  const Result<CallTable> calls_;
  const PrincipalPtr local_;
  CallRates rates_;
  FailedLogins failed_logins_;
  Tickets tickets_;
  LoginSessions logins_;
  std::unique_ptr<AuditLog> audit_;  ///< may be null
  CallerBudgets budgets_;
  std::unique_ptr<MapOwners> owners_;
  LiveStreams streams_;

  mutable Mutex mutex_;
  CondVar changed_;
  bool is_ending_ DHPMAP_GUARDED_BY(mutex_) = false;
  std::shared_ptr<const KeyRing> ring_ DHPMAP_GUARDED_BY(mutex_);
  FileState state_ DHPMAP_GUARDED_BY(mutex_);    ///< of the file as it was read; none: it could not be
  std::string fault_ DHPMAP_GUARDED_BY(mutex_);  ///< told last; empty: none since
  std::thread looker_;
};

}  // namespace dhpmap::auth
