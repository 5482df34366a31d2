// SPDX-License-Identifier: BSD-3-Clause
#include "server/auth/keys/key_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "server/auth/keys/key_book.h"
#include "tests/support/scenes.h"
#include "tests/unit/server/auth/keys/known_bytes.h"

namespace dhpmap::auth {
namespace {

namespace fs = std::filesystem;

class KeyFileTest : public ::testing::Test {
 protected:
  Status Add(const std::string& name) const {
    return ChangeKeyFile(path, [&](std::vector<KeyRecord>& records) {
      return AddKey({.name = name, .maps = {"a-*", "!a-b"}, .expires_s = 1'796'040'000}, 5, SystemRandomness(), records)
          .status();
    });
  }
  void Write(const std::string& text) const {
    std::ofstream(path) << text;
    ASSERT_EQ(chmod(path.c_str(), 0600), 0);
  }
  [[nodiscard]] std::string Text() const {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  testing::TempDir folder;
  const std::string path = (folder.path() / "keys").string();
};

TEST_F(KeyFileTest, AWrittenFileIsReadBackAndContainsNoKey) {
  std::string shown;
  std::vector<KeyRecord> written;
  ASSERT_TRUE(
      ChangeKeyFile(path, [&](std::vector<KeyRecord>& records) {
        auto key = AddKey({.name = "anna", .role = Role::kRobot, .maps = {"a-*", "!a-b"}}, 5, KnownBytes(), records);
        shown = key->text;
        written = records;
        written[0].revoked_s.reset();
        return Status::Ok();
      }).ok());
  const auto read = ReadKeyFile(path);
  ASSERT_TRUE(read.ok()) << read.status().ToString();
  EXPECT_EQ(read->records, written);
  EXPECT_EQ(Text().find(shown.substr(17, 64)), std::string::npos);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0600u);
}

TEST_F(KeyFileTest, ARecordIsReadBackUnchanged) {
  std::vector<KeyRecord> records;
  ASSERT_TRUE(AddKey({.name = "a", .maps = {"x"}, .expires_s = 99}, 5, KnownBytes(), records).ok());
  records[0].revoked_s = 50;
  const auto read = RecordFromLine(LineOf(records[0]));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(*read, records[0]);
}

TEST_F(KeyFileTest, AChangedFileIsDetected) {
  ASSERT_TRUE(Add("anna").ok());
  const auto before = *StateOfKeyFile(path);
  EXPECT_EQ(ReadKeyFile(path)->state, before);
  ASSERT_TRUE(Add("bert").ok());
  EXPECT_NE(*StateOfKeyFile(path), before);
}

TEST_F(KeyFileTest, AFileThatOthersMayReadOrWriteIsRefused) {
  ASSERT_TRUE(Add("anna").ok());
  for (const mode_t mode : {0604, 0640, 0620, 0666}) {
    ASSERT_EQ(chmod(path.c_str(), mode), 0);
    EXPECT_EQ(ReadKeyFile(path).status().reason(), Reason("BAD_KEY_FILE")) << std::oct << mode;
    EXPECT_FALSE(Add("bert").ok()) << "nor is it changed";
  }
}

TEST_F(KeyFileTest, LinksAndOtherThanFilesAreRefused) {
  ASSERT_TRUE(Add("anna").ok());
  const std::string real = path + ".real";
  fs::rename(path, real);
  fs::create_symlink(real, path);
  EXPECT_EQ(ReadKeyFile(path).status().reason(), Reason("BAD_KEY_FILE"));
  EXPECT_FALSE(Add("bert").ok());
  EXPECT_TRUE(fs::is_symlink(path));
  fs::remove(path);
  fs::create_directory(path);
  EXPECT_FALSE(ReadKeyFile(path).ok());
  fs::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_FALSE(ReadKeyFile(path).ok()) << "and it does not wait for somebody to write";
  fs::remove(path);
  EXPECT_FALSE(ReadKeyFile(path).ok()) << "there is none";
}

TEST_F(KeyFileTest, AnInvalidLineRefusesTheWholeFile) {
  ASSERT_TRUE(Add("anna").ok());
  const std::string good = Text();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const std::string& wrong :
       {good + good, good + "{}\n", good + "x\n", with("viewer", "owner"), with("anna", "an na"), with("\"a-*\"", "7"),
        with("\"sha256\"", "\"sha\""), with("2026-11-30T12:00:00Z", "soon")}) {
    Write(wrong);
    const Status status = ReadKeyFile(path).status();
    EXPECT_EQ(status.reason(), Reason("BAD_KEY_FILE")) << wrong;
    EXPECT_NE(status.message().find("line "), std::string::npos) << status.message();
    EXPECT_FALSE(Add("bert").ok());
    EXPECT_EQ(Text(), wrong) << "nothing is lost of it";
  }
  Write(good + "\n\n");
  EXPECT_TRUE(ReadKeyFile(path).ok());
}

TEST_F(KeyFileTest, AFailedChangeKeepsTheFile) {
  ASSERT_TRUE(Add("anna").ok());
  const std::string before = Text();
  EXPECT_FALSE(ChangeKeyFile(path, [](std::vector<KeyRecord>& records) {
                 records.clear();
                 return InvalidArgument("no");
               }).ok());
  EXPECT_EQ(Text(), before);
}

TEST_F(KeyFileTest, ConcurrentChangesAreAllKept) {
  constexpr int kThreads = 4, kEach = 10;
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([this, t] {
      for (int i = 0; i < kEach; ++i) {
        EXPECT_TRUE(Add("k" + std::to_string(t) + "-" + std::to_string(i)).ok());
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(ReadKeyFile(path)->records.size(), std::size_t{kThreads * kEach});
}

}  // namespace
}  // namespace dhpmap::auth
