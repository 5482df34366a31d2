// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mapping/base/mutex.h"
#include "tests/support/wrapped_store.h"

namespace dhpmap::testing {

/// A memory store whose disk can fill up for a while. Thread-safe.
class FailingStore final : public WrappedStore {
 public:
  void set_full(bool is_full) { is_full_ = is_full; }
  /// Runs before each commit that is not refused.
  void set_before_commit(std::function<void()> hook) { before_commit_.Set(std::move(hook)); }
  /// Runs before each map is loaded.
  void set_before_load(std::function<void()> hook) { before_load_.Set(std::move(hook)); }
  [[nodiscard]] int num_refused() const { return num_refused_; }

  Status CreateMap(const MapSnapshot& snapshot) override { return is_full_ ? Full() : inner().CreateMap(snapshot); }
  Status Commit(const StateMarks& before, const MapSnapshot& after, Durability durability) override {
    if (is_full_) return Full();
    before_commit_.Run();
    return inner().Commit(before, after, durability);
  }
  Status CommitEdit(const StateMarks& before, const MapSnapshot& after, const EditRecord& edit) override {
    if (is_full_) return Full();
    before_commit_.Run();
    return inner().CommitEdit(before, after, edit);
  }
  Result<std::shared_ptr<const MapSnapshot>> LoadMap(const std::string& name) override {
    before_load_.Run();
    return inner().LoadMap(name);
  }
  Status DeleteMap(const std::string& name) override { return is_full_ ? Full() : inner().DeleteMap(name); }
  Status Reserve(const std::string& name, const NumberMarks& marks) override {
    return is_full_ ? Full() : inner().Reserve(name, marks);
  }

 private:
  class Hook {
   public:
    void Set(std::function<void()> run) {
      const MutexLock lock(mutex_);
      run_ = std::move(run);
    }
    /// May run on several threads at once.
    void Run() {
      std::function<void()> run;
      {
        const MutexLock lock(mutex_);
        run = run_;
      }
      if (run) run();
    }

   private:
    Mutex mutex_;
    std::function<void()> run_ DHPMAP_GUARDED_BY(mutex_);
  };

  Status Full() {
    ++num_refused_;
    return ResourceExhausted("the disk is full");
  }

  Hook before_commit_, before_load_;
  std::atomic<bool> is_full_ = false;
  std::atomic<int> num_refused_ = 0;
};

}  // namespace dhpmap::testing
