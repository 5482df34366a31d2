// SPDX-License-Identifier: BSD-3-Clause
#include "server/gateway/path_template.h"

#include <algorithm>
#include <array>
#include <utility>

#include "server/http/url.h"

namespace dhpmap::gateway {
namespace {
constexpr std::size_t kMaxSegments = 32;
}

/// Recursive descent over the grammar; fails at the first error.
class TemplateParser {
 public:
  explicit TemplateParser(std::string_view text) : text_(text) { path_.text_ = text; }

  Result<PathTemplate> Parse() {
    if (!Take('/') || !Segments(false)) return Error();
    if (Take(':')) {
      path_.verb_ = Literal();
      if (path_.verb_.empty()) return Error();
    }
    if (at_ != text_.size() || path_.segments_.size() > kMaxSegments) return Error();
    for (std::size_t i = 0; i + 1 < path_.segments_.size(); ++i) {
      if (path_.segments_[i].kind == PathTemplate::Kind::kMany) return Error();
    }
    return std::move(path_);
  }

 private:
  bool Segments(bool in_variable) {
    do {
      if (!Segment(in_variable)) return false;
    } while (Take('/'));
    return true;
  }

  bool Segment(bool in_variable) {
    if (Take('{')) return !in_variable && Variable();
    if (Take('*')) {
      path_.segments_.push_back({Take('*') ? PathTemplate::Kind::kMany : PathTemplate::Kind::kOne, ""});
      return true;
    }
    std::string literal = Literal();
    if (literal.empty()) return false;
    path_.segments_.push_back({PathTemplate::Kind::kLiteral, std::move(literal)});
    return true;
  }

  bool Variable() {
    const std::size_t start = at_;
    while (at_ < text_.size() && text_[at_] != '=' && text_[at_] != '}') ++at_;
    PathTemplate::Variable variable{std::string(text_.substr(start, at_ - start)), path_.segments_.size(), 0};
    if (variable.field_path.empty()) return false;
    if (Take('=')) {
      if (!Segments(true)) return false;
    } else {
      path_.segments_.push_back({PathTemplate::Kind::kOne, ""});
    }
    variable.end = path_.segments_.size();
    path_.variables_.push_back(std::move(variable));
    return Take('}');
  }

  std::string Literal() {
    const std::size_t start = at_;
    while (at_ < text_.size() && std::string_view("/{}*:=").find(text_[at_]) == std::string_view::npos) ++at_;
    return std::string(text_.substr(start, at_ - start));
  }

  bool Take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  [[nodiscard]] Status Error() const {
    return InvalidArgument("path template '" + std::string(text_) + "' is wrong at character " +
                           std::to_string(at_ + 1));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  PathTemplate path_;
};

Result<PathTemplate> PathTemplate::Parse(std::string_view text) { return TemplateParser(text).Parse(); }

std::optional<std::vector<std::string>> PathTemplate::Match(std::string_view path) const {
  std::string_view verb;
  const std::size_t colon = path.rfind(':');
  if (colon != std::string_view::npos && path.find('/', colon) == std::string_view::npos) {
    verb = path.substr(colon + 1);
    if (verb.empty()) return std::nullopt;
    path = path.substr(0, colon);
  }
  if (verb != verb_ || path.empty() || path.front() != '/') return std::nullopt;

  std::array<std::size_t, kMaxSegments + 1> starts;  // of each segment in `path`, plus the end
  std::size_t num_starts = 0;
  std::size_t at = 1;
  for (const Segment& segment : segments_) {
    if (at > path.size()) return std::nullopt;
    const std::size_t end = segment.kind == Kind::kMany ? path.size() : std::min(path.find('/', at), path.size());
    const std::string_view value = path.substr(at, end - at);
    if (segment.kind == Kind::kLiteral ? value != segment.text : value.empty()) return std::nullopt;
    starts[num_starts++] = at;
    at = end + 1;
  }
  if (at != path.size() + 1) return std::nullopt;
  starts[num_starts] = at;

  std::vector<std::string> values;
  for (const Variable& variable : variables_) {
    const std::size_t begin = starts[variable.begin];
    const std::string_view raw = path.substr(begin, starts[variable.end] - 1 - begin);
    auto value = http::PercentDecode(raw, false, !variable.is_one_segment(*this));
    if (!value) return std::nullopt;
    values.push_back(std::move(*value));
  }
  return values;
}

std::string PathTemplate::Shape() const {
  std::string shape;
  for (const Segment& segment : segments_) {
    shape += '/';
    shape += segment.kind == Kind::kLiteral ? segment.text : segment.kind == Kind::kOne ? "*" : "**";
  }
  return verb_.empty() ? shape : shape + ':' + verb_;
}

}  // namespace dhpmap::gateway
