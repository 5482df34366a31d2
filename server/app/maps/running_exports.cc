// SPDX-License-Identifier: BSD-3-Clause
#include "server/app/maps/running_exports.h"

#include <algorithm>
#include <utility>

namespace dhpmap {
namespace {

/// The final stage of an export whose file cannot be opened or read.
ExportStage StageOf(const Status& status) {
  return status.code() == StatusCode::kCancelled ? ExportStage::kLeft : ExportStage::kFailed;
}

double SecondsSince(RunningExports::Clock::time_point begin) {
  return std::chrono::duration<double>(RunningExports::Clock::now() - begin).count();
}

}  // namespace

/// Reports progress of reading another file.
class RunningExports::File final : public StoreBackup {
 public:
  File(std::shared_ptr<RunningExports> exports, std::int64_t id, std::unique_ptr<StoreBackup> file)
      : exports_(std::move(exports)), id_(id), file_(std::move(file)) {}
  ~File() override { exports_->End(id_, ExportStage::kLeft); }
  [[nodiscard]] std::int64_t size_bytes() const override { return file_->size_bytes(); }

  Result<std::string> Read(std::size_t max_bytes) override {
    Result<std::string> part = file_->Read(max_bytes);
    if (!part.ok()) exports_->End(id_, StageOf(part.status()));
    else if (part->empty()) exports_->End(id_, ExportStage::kSent);
    else exports_->AddBytes(id_, part->size());
    return part;
  }

 private:
  const std::shared_ptr<RunningExports> exports_;
  const std::int64_t id_;
  const std::unique_ptr<StoreBackup> file_;
};

RunningExports::Opened RunningExports::Open(ExportKind kind, const std::string& map,
                                            const std::function<Opened()>& open) {
  const std::int64_t id = Begin(kind, map);
  try {
    Opened file = open();
    if (file.ok()) {
      BeginSending(id, (*file)->size_bytes());
      return std::unique_ptr<StoreBackup>(std::make_unique<File>(shared_from_this(), id, std::move(file).value()));
    }
    // Exports of missing maps are not recorded, so they do not displace results of others.
    End(id, StageOf(file.status()), file.status().code() != StatusCode::kNotFound);
    return file;
  } catch (...) {
    End(id, ExportStage::kFailed);
    throw;
  }
}

void RunningExports::Note(Export& changed) {
  changed.changed = number_.load(std::memory_order_relaxed) + 1;
  number_.store(changed.changed, std::memory_order_release);
}

std::int64_t RunningExports::Begin(ExportKind kind, const std::string& map) {
  const MutexLock lock(mutex_);
  const std::int64_t id = next_id_++;
  Export& begun = running_[id];
  begun.map = map;
  begun.progress.id = id;
  begun.progress.kind = kind;
  begun.begin = Clock::now();
  Note(begun);
  return id;
}

void RunningExports::BeginSending(std::int64_t id, std::int64_t total_bytes) {
  const MutexLock lock(mutex_);
  Export& sent = running_.at(id);
  sent.progress.stage = ExportStage::kSending;
  sent.progress.total_bytes = total_bytes;
  Note(sent);
}

void RunningExports::AddBytes(std::int64_t id, std::size_t num_bytes) {
  const MutexLock lock(mutex_);
  const auto found = running_.find(id);
  if (found != running_.end()) found->second.progress.done_bytes += static_cast<std::int64_t>(num_bytes);
}

void RunningExports::End(std::int64_t id, ExportStage stage, bool is_kept) {
  const MutexLock lock(mutex_);
  auto ended = running_.extract(id);
  if (ended.empty()) return;
  Export& last = ended.mapped();
  last.progress.stage = stage;
  last.progress.elapsed_s = SecondsSince(last.begin);
  Note(last);
  if (!is_kept) return;
  if (ended_.size() >= kMaxEnded) ended_.pop_front();
  ended_.push_back(std::move(last));
}

ExportNews RunningExports::Of(const std::string& map, std::uint64_t since) const {
  const auto is_told = [&map](const Export& one) { return one.map.empty() || one.map == map; };
  const MutexLock lock(mutex_);
  ExportNews news;
  news.number = number_.load(std::memory_order_relaxed);
  for (auto ended = ended_.rbegin(); ended != ended_.rend() && ended->changed > since; ++ended) {
    if (!is_told(*ended)) continue;
    news.has_changed = true;
    news.exports.push_back(ended->progress);
    if (news.exports.size() == kMaxTold) break;
  }
  std::reverse(news.exports.begin(), news.exports.end());
  for (const auto& [id, running] : running_) {
    if (!is_told(running)) continue;
    news.has_changed = news.has_changed || running.changed > since;
    if (++news.num_running > kMaxTold) continue;
    news.exports.push_back(running.progress);
    news.exports.back().elapsed_s = SecondsSince(running.begin);
  }
  return news;
}

}  // namespace dhpmap
