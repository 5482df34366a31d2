// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>
#include <memory>

#include "server/base/lane.h"

namespace dhpmap::testing {

/// Keeps one thread of a lane busy until it is let go.
class LanePlug {
 public:
  explicit LanePlug(Lane& lane) {
    lane.Post([ends = ends_] {
      ends->begun.set_value();
      ends->release.get_future().wait();
    });
    ends_->begun.get_future().wait();
  }
  void Release() { ends_->release.set_value(); }

 private:
  struct Ends {
    std::promise<void> begun, release;
  };
  std::shared_ptr<Ends> ends_ = std::make_shared<Ends>();  // the lane's, too, whose thread may go on after we are gone
};

}  // namespace dhpmap::testing
