// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/login_sessions.h"

#include <utility>

namespace dhpmap::auth {

std::string LoginSessions::Begin(PrincipalPtr principal, std::int64_t now_s) {
  std::array<unsigned char, 32> bytes{};
  randomness_(bytes);
  std::string word = HexOf(bytes);
  const Digest digest = DigestOf(word);
  const MutexLock lock(mutex_);
  MakeRoom(principal->name);
  const std::uint64_t number = next_number_++;
  by_name_[principal->name].insert(number);
  logins_.emplace(digest, Login{std::move(principal), now_s + kLife_s, number});
  by_age_.emplace(number, digest);
  return word;
}

PrincipalPtr LoginSessions::Find(std::string_view word, std::int64_t now_s) {
  const Digest digest = DigestOf(word);
  const MutexLock lock(mutex_);
  const auto found = logins_.find(digest);
  if (found == logins_.end()) return nullptr;
  if (found->second.end_s > now_s) return found->second.principal;
  Forget(found);
  return nullptr;
}

void LoginSessions::End(std::string_view word) {
  const Digest digest = DigestOf(word);
  const MutexLock lock(mutex_);
  const auto found = logins_.find(digest);
  if (found != logins_.end()) Forget(found);
}

void LoginSessions::MakeRoom(const std::string& name) {
  const auto its = by_name_.find(name);
  if (its != by_name_.end() && its->second.size() >= kMostOfOne) {
    return Forget(logins_.find(by_age_.at(*its->second.begin())));
  }
  if (logins_.size() >= kMost) Forget(logins_.find(by_age_.begin()->second));
}

void LoginSessions::Forget(std::map<Digest, Login>::iterator login) {
  const auto its = by_name_.find(login->second.principal->name);
  its->second.erase(login->second.number);
  if (its->second.empty()) by_name_.erase(its);
  by_age_.erase(login->second.number);
  logins_.erase(login);
}

}  // namespace dhpmap::auth
