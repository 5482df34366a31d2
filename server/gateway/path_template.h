// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mapping/base/result.h"

namespace dhpmap::gateway {

/// A path template of google.api.http: "/v1/{name=maps/*}:stats". Grammar as in google/api/http.proto. Immutable.
class PathTemplate {
 public:
  enum class Kind { kLiteral, kOne, kMany };  ///< text, "*" (one segment), "**" (the rest; last segment only)
  struct Segment {
    Kind kind;
    std::string text;  ///< of a literal
  };
  struct Variable {
    std::string field_path;  ///< as written: "submap.name"
    std::size_t begin;       ///< its value is segments [begin, end)
    std::size_t end;
    [[nodiscard]] bool is_one_segment(const PathTemplate& path) const {
      return end == begin + 1 && path.segments()[begin].kind != Kind::kMany;
    }
  };

  /// INVALID_ARGUMENT if the text does not follow the grammar.
  static Result<PathTemplate> Parse(std::string_view text);

  /// Values of the variables in order, percent-decoded ("%2F" stays in values of several segments); nothing if the path
  /// does not match. A ':' in the last segment starts a verb; write "%3A" for a plain colon.
  [[nodiscard]] std::optional<std::vector<std::string>> Match(std::string_view encoded_path) const;

  [[nodiscard]] const std::vector<Segment>& segments() const { return segments_; }
  [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }
  [[nodiscard]] const std::string& verb() const { return verb_; }  ///< without the colon; may be empty
  [[nodiscard]] const std::string& text() const { return text_; }

  /// Equal for templates that match the same paths: "/v1/maps/*:stats".
  [[nodiscard]] std::string Shape() const;

 private:
  friend class TemplateParser;
  std::string text_;
  std::vector<Segment> segments_;
  std::vector<Variable> variables_;
  std::string verb_;
};

}  // namespace dhpmap::gateway
