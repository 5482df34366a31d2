// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mapping/base/mutex.h"
#include "storage/history/seen_clock.h"

namespace dhpmap::postgres {

/// A row of table servers.
struct ServerRow {
  std::int64_t server = 0;
  std::int64_t beat = 0;  ///< differs from beat to beat
  std::string address;
  std::string version;
  bool is_draining = false;
  std::int64_t knows_schema = 0;  ///< the newest step that its version knows
};

/// Judges which servers are alive by this process's own clock. A server is dead if its beat has not changed for a
/// lease, provided that this process's own beats succeeded meanwhile. So a silent database makes no server dead. Makes
/// no queries. Thread-safe.
class Peers {
 public:
  /// `me`: this process. `time`: empty: the steady clock.
  Peers(std::int64_t me, double lease_s, PassingTime time);

  static constexpr std::int64_t kNoRow = -1;  ///< in place of a beat

  enum class Verdict {
    kAlive,
    kUnclear,  ///< no beat was seen yet; or own beats fail
    kDead,
  };
  struct Opinion {
    Verdict verdict = Verdict::kUnclear;
    std::int64_t beat = kNoRow;  ///< the beat that the verdict rests on
    std::int64_t age_ns = 0;     ///< since that beat was first seen
  };
  struct Judged {
    ServerRow row;
    Verdict verdict = Verdict::kUnclear;
  };

  /// After a successful beat: `sent_ns` (of Now_ns) is when it was sent, `rows` are all rows after it.
  void OnBeaten(std::int64_t sent_ns, const std::vector<ServerRow>& rows) DHPMAP_EXCLUDES(mutex_);
  /// Whether a beat sent then is so late that another process may have taken maps of this one. If so, check the maps
  /// after the beat and before OnBeaten.
  [[nodiscard]] bool ComesLate(std::int64_t sent_ns) const DHPMAP_EXCLUDES(mutex_);

  /// Whether no other process can have taken maps of this one: a beat sent less than half a lease ago has succeeded.
  /// The other half allows for answers on their way, and for clocks of different speed.
  [[nodiscard]] bool IsFresh() const DHPMAP_EXCLUDES(mutex_);
  /// The opinion of a server that owns a map. A server without a row is also watched for a lease before it counts as
  /// dead.
  [[nodiscard]] Opinion OpinionOf(std::int64_t server) DHPMAP_EXCLUDES(mutex_);
  /// All servers with a row, this one included.
  [[nodiscard]] std::vector<Judged> All() const DHPMAP_EXCLUDES(mutex_);
  /// The row as last read; nothing if there is none.
  [[nodiscard]] std::optional<ServerRow> Find(std::int64_t server) const DHPMAP_EXCLUDES(mutex_);
  /// Servers that have been dead for a hundred leases.
  [[nodiscard]] std::vector<std::int64_t> LongDead() const DHPMAP_EXCLUDES(mutex_);
  /// Living servers that take maps, without this one.
  [[nodiscard]] std::vector<std::int64_t> Takers() const DHPMAP_EXCLUDES(mutex_);

  [[nodiscard]] std::int64_t me() const { return me_; }
  [[nodiscard]] std::int64_t lease_ns() const { return lease_ns_; }
  [[nodiscard]] std::int64_t Now_ns() const { return time_(); }

 private:
  struct Peer {
    ServerRow row;
    std::int64_t changed_ns = 0;  ///< when its present beat was first seen
    bool has_beaten = false;      ///< its beat was seen to change while own beats succeeded
  };
  void See(const ServerRow& row, std::int64_t now_ns, bool begins_anew) DHPMAP_REQUIRES(mutex_);
  [[nodiscard]] bool IsFreshAt(std::int64_t now_ns) const DHPMAP_REQUIRES(mutex_);
  [[nodiscard]] Verdict VerdictOf(const Peer& peer, std::int64_t now_ns) const DHPMAP_REQUIRES(mutex_);

  const std::int64_t me_;
  const std::int64_t lease_ns_;
  const PassingTime time_;
  mutable Mutex mutex_;
  std::optional<std::int64_t> last_sent_ns_ DHPMAP_GUARDED_BY(mutex_);  // of the last beat that succeeded
  std::map<std::int64_t, Peer> peers_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::postgres
