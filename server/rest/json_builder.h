// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "server/rest/json_writer.h"

namespace dhpmap::rest {

/// Writes JSON text piece by piece and sets the commas. Thread-compatible.
class JsonBuilder {
 public:
  JsonBuilder& BeginObject() { return Begin('{'); }
  JsonBuilder& EndObject() { return End('}'); }
  JsonBuilder& BeginArray() { return Begin('['); }
  JsonBuilder& EndArray() { return End(']'); }
  JsonBuilder& Key(std::string_view key) {
    Separate();
    AppendJsonString(key, &text_);
    text_ += ':';
    needs_comma_ = false;
    return *this;
  }
  JsonBuilder& String(std::string_view value) {
    Separate();
    AppendJsonString(value, &text_);
    return *this;
  }
  /// Text that is JSON already.
  JsonBuilder& Raw(std::string_view json) {
    Separate();
    text_ += json;
    return *this;
  }
  JsonBuilder& Member(std::string_view key, std::string_view value) { return Key(key).String(value); }
  JsonBuilder& RawMember(std::string_view key, std::string_view json) { return Key(key).Raw(json); }

  [[nodiscard]] std::string Take() { return std::move(text_); }

 private:
  JsonBuilder& Begin(char c) {
    Separate();
    text_ += c;
    needs_comma_ = false;
    return *this;
  }
  JsonBuilder& End(char c) {
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

}  // namespace dhpmap::rest
