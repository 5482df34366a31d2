// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/ledger/state_names.h"

#include <memory>

namespace dhpmap::rig {

void StateNames::Bind(const std::string& name, const std::string& state) {
  Bind(name, state, [](const std::string& text) { return text; });
}

void StateNames::Bind(const std::string& name, const google::protobuf::Message& state) {
  Bind(name, state.SerializeAsString(), [&state](const std::string& bytes) {
    const std::unique_ptr<google::protobuf::Message> message(state.New());
    return message->ParseFromString(bytes) ? message->ShortDebugString() : "?";
  });
}

void StateNames::Bind(const std::string& name, const std::string& state, const InWords& in_words) {
  const auto [known, is_new] = states_.emplace(name, state);
  if (is_new || known->second == state) return;
  complaints_.push_back("law 1: " + name + " names two states: " + in_words(known->second) + " and " + in_words(state));
  known->second = state;  // one complaint for each change
}

}  // namespace dhpmap::rig
