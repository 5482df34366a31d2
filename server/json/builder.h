// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "server/json/writer.h"

namespace dhpmap::json {

/// Writes JSON text piece by piece and sets the commas. Thread-compatible.
class Builder {
 public:
  Builder& BeginObject() { return Begin('{'); }
  Builder& EndObject() { return End('}'); }
  Builder& BeginArray() { return Begin('['); }
  Builder& EndArray() { return End(']'); }
  Builder& Key(std::string_view key) {
    Separate();
    AppendString(key, &text_);
    text_ += ':';
    needs_comma_ = false;
    return *this;
  }
  Builder& String(std::string_view value) {
    Separate();
    AppendString(value, &text_);
    return *this;
  }
  /// Inserts text that is already JSON.
  Builder& Raw(std::string_view json) {
    Separate();
    text_ += json;
    return *this;
  }
  Builder& Member(std::string_view key, std::string_view value) { return Key(key).String(value); }
  Builder& RawMember(std::string_view key, std::string_view json) { return Key(key).Raw(json); }

  [[nodiscard]] std::string Take() { return std::move(text_); }

 private:
  Builder& Begin(char c) {
    Separate();
    text_ += c;
    needs_comma_ = false;
    return *this;
  }
  Builder& End(char c) {
    text_ += c;
    needs_comma_ = true;
    return *this;
  }
  void Separate() {
    if (needs_comma_) text_ += ',';
    needs_comma_ = true;
  }

  std::string text_;
  bool needs_comma_ = false;
};

}  // namespace dhpmap::json
