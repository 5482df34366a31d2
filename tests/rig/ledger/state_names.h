// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <google/protobuf/message.h>

#include <cstddef>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

namespace dhpmap::rig {

/// What was seen against a law, for people.
using Complaints = std::vector<std::string>;

/// Names of states (an etag; a history and a revision), each with the state that it was first seen with. A name that is
/// seen with another one is a complaint. Thread-compatible.
class StateNames {
 public:
  explicit StateNames(Complaints& complaints) : complaints_(complaints) {}

  /// `name` is complete: two different things never share one.
  void Bind(const std::string& name, const std::string& state);
  void Bind(const std::string& name, const google::protobuf::Message& state);

  [[nodiscard]] std::size_t size() const { return states_.size(); }

 private:
  using InWords = std::function<std::string(const std::string&)>;
  void Bind(const std::string& name, const std::string& state, const InWords& in_words);

  Complaints& complaints_;
  std::unordered_map<std::string, std::string> states_;
};

}  // namespace dhpmap::rig
