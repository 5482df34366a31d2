// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "mapping/base/mutex.h"
#include "server/gateway/transcoder.h"

namespace dhpmap::gateway {

/// The last message of events in each format, as it was written: of the many who follow a map, each gets the same at
/// about the same time, and only the first waits for it to be made. Thread-safe.
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
