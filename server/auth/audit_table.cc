// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/audit_table.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/guarded.h"
#include "mapping/base/this_thread.h"

namespace dhpmap::auth {
namespace {

/// The database refuses text that is not UTF-8, or that has a NUL: with it, the whole batch.
std::string Plain(std::string_view text) {
  std::string plain(text.substr(0, AuditEntry::kMostTextBytes));
  std::replace_if(
      plain.begin(), plain.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return plain;
}

AuditRow RowOf(const AuditEntry& entry, std::int64_t now_s) {
  AuditRow row{.time_s = now_s, .rpc = Plain(entry.rpc), .map = Plain(entry.map), .decision = Plain(entry.Verdict())};
  if (entry.principal != nullptr) {
    row.principal = Plain(entry.principal->name);
    row.key_id = Plain(entry.principal->key_id);
  }
  return row;
}

}  // namespace

AuditTable::AuditTable(std::shared_ptr<AuthTables> tables, AuditTableOptions options)
    : tables_(std::move(tables)), options_(std::move(options)) {
  if (options_.flush_s > 0) writer_ = std::thread([this] { Loop(); });
}

AuditTable::~AuditTable() {
  {
    const MutexLock lock(mutex_);
    is_ending_ = true;
  }
  wake_.NotifyAll();
  if (writer_.joinable()) writer_.join();
  (void)Flush();
}

void AuditTable::Write(const AuditEntry& entry) {
  const std::int64_t now_s = options_.now_s();
  bool is_full = false;
  {
    const MutexLock lock(mutex_);
    if (!refusals_.Admit(entry, now_s)) return;
    is_full = waiting_.size() >= kMostWaiting;
    if (is_full) {
      Drop(1);
    } else {
      AuditRow row = RowOf(entry, now_s);
      row.server = options_.server;
      row.number = next_number_++;
      row.num_left_out = refusals_.TakeLeftOut() + std::exchange(num_missing_, 0);
      waiting_.push_back(std::move(row));
      if (waiting_.size() == kMostOfABatch) wake_.NotifyAll();
    }
  }
  if (is_full) Tell(ResourceExhausted("the database does not take the audit log: rows are dropped"));
}

Status AuditTable::Flush() {
  const MutexLock lock(flush_mutex_);
  for (;;) {
    const std::vector<AuditRow> batch = NextBatch();
    if (batch.empty()) return Status::Ok();
    const Status stored = Guarded<Status>([&] { return tables_->AppendAudit(batch); });
    const bool may_be_taken_later =
        stored.code() == StatusCode::kUnavailable || stored.code() == StatusCode::kResourceExhausted;
    if (!may_be_taken_later) Remove(batch.size(), stored.ok());
    if (stored.ok()) continue;
    Tell(stored);
    return stored;
  }
}

std::vector<AuditRow> AuditTable::NextBatch() const {
  const MutexLock lock(mutex_);
  const auto num = static_cast<std::ptrdiff_t>(std::min(waiting_.size(), kMostOfABatch));
  return {waiting_.begin(), waiting_.begin() + num};
}

void AuditTable::Remove(std::size_t num_rows, bool are_stored) {
  const MutexLock lock(mutex_);
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(num_rows));
  if (are_stored) is_faulty_ = false;
  else Drop(num_rows);
}

void AuditTable::Drop(std::size_t num_rows) {
  num_missing_ += static_cast<std::int64_t>(num_rows);
  num_dropped_ += static_cast<std::int64_t>(num_rows);
}

void AuditTable::Tell(const Status& fault) {
  {
    const MutexLock lock(mutex_);
    if (std::exchange(is_faulty_, true)) return;
  }
  if (options_.on_fault) options_.on_fault(fault);
}

std::int64_t AuditTable::num_dropped() const {
  const MutexLock lock(mutex_);
  return num_dropped_;
}

void AuditTable::Loop() {
  NameThisThread("map-audit");
  const auto pause =
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(options_.flush_s));
  for (bool has_failed = false;;) {
    {
      const MutexLock lock(mutex_);
      wake_.WaitFor(mutex_, pause, [&]() DHPMAP_REQUIRES(mutex_) {
        return is_ending_ || (waiting_.size() >= kMostOfABatch && !has_failed);
      });
      if (is_ending_) return;
    }
    has_failed = !Flush().ok();
  }
}

}  // namespace dhpmap::auth
