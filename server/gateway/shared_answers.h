// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "mapping/base/mutex.h"
#include "server/gateway/transcoder.h"

namespace dhpmap::gateway {

/// Caches the last event message in each format. The clients that follow a map get the same message at about the same
/// time; only the first waits for its conversion. Thread-safe.
class SharedAnswers {
 public:
  /// See ToStreamAnswer.
  Result<std::string> Make(const Route& route, std::string_view message, AnswerFormat format) DHPMAP_EXCLUDES(mutex_) {
    {
      const MutexLock lock(mutex_);
      const Answer& last = last_[format];
      if (last.route == &route && last.message == message) return last.text;
    }
    DHPMAP_ASSIGN_OR_RETURN(std::string text, ToStreamAnswer(route, message, format));
    const MutexLock lock(mutex_);
    last_[format] = {&route, std::string(message), text};
    return text;
  }

 private:
  struct Answer {
    const Route* route = nullptr;
    std::string message, text;
  };
  Mutex mutex_;
  std::map<AnswerFormat, Answer> last_ DHPMAP_GUARDED_BY(mutex_);
};

}  // namespace dhpmap::gateway
