// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map/session_marks.h"

#include <algorithm>
#include <utility>

namespace dhpmap {
namespace {

constexpr std::size_t kMaxNameBytes = 64;

bool MayBeInName(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
         c == ':' || c == '-';
}

bool IsBefore(const SessionMark& mark, std::string_view session) { return mark.session < session; }

}  // namespace

Status ValidateSessionName(std::string_view session) {
  if (!session.empty() && session.size() <= kMaxNameBytes && std::all_of(session.begin(), session.end(), MayBeInName)) {
    return Status::Ok();
  }
  return InvalidArgument("the name of the session is not usable")
      .WithReason("BAD_SESSION")
      .WithViolation("session", "1 to 64 of A-Z a-z 0-9 . _ : -");
}

Result<SessionMarks> SessionMarks::Create(std::vector<SessionMark> marks) {
  SessionMarks created;
  if (marks.size() > kMost)
    return DataLoss("has " + std::to_string(marks.size()) + " sessions, more than there may be");
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (!ValidateSessionName(marks[i].session).ok() || (i > 0 && marks[i].session <= marks[i - 1].session)) {
      return DataLoss("the names of its sessions are damaged");
    }
  }
  created.marks_ = std::move(marks);
  return created;
}

std::optional<std::int64_t> SessionMarks::LastOf(std::string_view session) const {
  const auto found = std::lower_bound(marks_.begin(), marks_.end(), session, IsBefore);
  if (found == marks_.end() || found->session != session) return std::nullopt;
  return found->sequence;
}

void SessionMarks::Set(SessionMark mark) {
  auto place = std::lower_bound(marks_.begin(), marks_.end(), mark.session, IsBefore);
  if (place != marks_.end() && place->session == mark.session) {
    *place = std::move(mark);
    return;
  }
  if (marks_.size() >= kMost) {
    marks_.erase(std::min_element(marks_.begin(), marks_.end(),
                                  [](const SessionMark& a, const SessionMark& b) { return a.time_ns < b.time_ns; }));
    place = std::lower_bound(marks_.begin(), marks_.end(), mark.session, IsBefore);
  }
  marks_.insert(place, std::move(mark));
}

}  // namespace dhpmap
