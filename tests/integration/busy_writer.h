// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <future>
#include <memory>

#include "server/app/open_map/open_map.h"

namespace dhpmap::testing {

/// Keeps the writer of a map busy during its lifetime.
class BusyWriter {
 public:
  explicit BusyWriter(OpenMap& session) {
    auto begun = std::make_shared<std::promise<void>>();
    const auto has_begun = begun->get_future();
    session.Edit(
        [begun, go = go_.get_future().share()](Map&) -> Result<SubmapId> {
          begun->set_value();
          go.wait();
          return SubmapId(0);
        },
        [](const Result<EditOutcome>&) {});
    has_begun.wait();
  }
  ~BusyWriter() { go_.set_value(); }

 private:
  std::promise<void> go_;
};

}  // namespace dhpmap::testing
