// SPDX-License-Identifier: BSD-3-Clause
#include "tests/rig/clients/backing_up_client.h"

#include <fstream>
#include <thread>

namespace dhpmap::rig {

void BackingUpClient::Run(const Life& life) {
  constexpr int kLongestWait_ms = 200;
  Connection server(life, ledger_);
  bool goes_on = true;
  while (goes_on && !life.is_ending) {
    std::this_thread::sleep_for(std::chrono::milliseconds(Any(kLongestWait_ms)));
    goes_on = BackUp(life, server);
  }
}

bool BackingUpClient::BackUp(const Life& life, Connection& server) {
  const std::filesystem::path part = file_.string() + ".part";
  FinishedBackup backup{.file = file_};
  for (const FedMap& map : life.maps) backup.num_stored[map.history] = ledger_.NumStoredFrames(map.history);
  backup.asked = ledger_.Now();
  const CallUnderWay counted(life.under_way, Phase::kBackup);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + Connection::kTimeout);
  const auto stream = server.maps->BackupMaps(&context, {});
  const bool is_whole = Receive(*stream, part);
  const Outcome outcome = server.Judge("BackupMaps", {}, stream->Finish());
  backup.answered = ledger_.Now();
  if (outcome.fate != Fate::kAnswered) return false;
  if (!is_whole) ledger_.Complain("law 6: a backup ended well, but is not of the size that it said");
  std::filesystem::rename(part, file_);
  finished_ = std::move(backup);
  return true;
}

bool BackingUpClient::Receive(grpc::ClientReader<v1::BackupMapsResponse>& stream, const std::filesystem::path& file) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  v1::BackupMapsResponse part;
  std::int64_t num_bytes = 0, total_bytes = -1;
  while (stream.Read(&part)) {
    if (total_bytes < 0) total_bytes = part.total_bytes();
    out.write(part.data().data(), static_cast<std::streamsize>(part.data().size()));
    num_bytes += static_cast<std::int64_t>(part.data().size());
  }
  out.close();
  return out.good() && num_bytes == total_bytes;
}

}  // namespace dhpmap::rig
