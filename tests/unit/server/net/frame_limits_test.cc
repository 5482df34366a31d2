// SPDX-License-Identifier: BSD-3-Clause
#include "server/net/frame_limits.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/unit/server/net/http2_bytes.h"

namespace dhpmap::net {
namespace {

using namespace frame_flags;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::FrameBytes;
using testing::FrameHeadBytes;

/// A connection with the test's own clock.
class FrameLimitsTest : public ::testing::Test {
 protected:
  Refusal Client(const std::string& bytes) { return limits_.FromClient(bytes, now_); }
  Refusal Server(const std::string& bytes) { return limits_.FromServer(bytes, now_); }
  Refusal Open(std::uint32_t stream) {
    return Client(FrameBytes(FrameType::kHeaders, kEndHeaders, stream, testing::CallFields("/a/b")));
  }
  static std::string Reset(std::uint32_t stream, std::uint32_t code = 8) {
    return FrameBytes(FrameType::kReset, 0, stream, testing::BigEndianBytes(code, 4));
  }
  /// Number of accepted repetitions, and the refusal that ends them.
  template <typename Do>
  std::pair<int, Refusal> Until(Do&& act, int most = 5000) {
    for (int i = 0; i < most; ++i) {
      if (const Refusal refusal = act(i); refusal != Refusal::kNone) return {i, refusal};
    }
    return {most, Refusal::kNone};
  }
  static std::uint32_t StreamOf(int i) { return static_cast<std::uint32_t>(2 * i + 1); }

  FrameLimits::Time now_ = FrameLimits::Time() + seconds(1000);
  FrameLimits limits_{nullptr};
};

using Ends = std::pair<int, Refusal>;
constexpr int kResets = static_cast<int>(FrameLimits::kResets);

TEST_F(FrameLimitsTest, RefusesThe129thOpenStreamEvenUnacknowledged) {
  EXPECT_EQ(Until([&](int i) { return Open(StreamOf(i)); }), Ends(128, Refusal::kTooManyStreams));
}

TEST_F(FrameLimitsTest, AcceptsAnyNumberOfStreamsThatTheServerEnds) {
  const auto ended = Until([&](int i) {
    const Refusal refusal = Open(StreamOf(i));
    EXPECT_EQ(Server(FrameBytes(FrameType::kHeaders, kEndHeaders | kEndStream, StreamOf(i), "\x88")), Refusal::kNone);
    return refusal;
  });
  EXPECT_EQ(ended, Ends(5000, Refusal::kNone));
  EXPECT_EQ(limits_.num_streams(), 0u);
}

TEST_F(FrameLimitsTest, LetsAClientCancelAllItsCallsTwice) {
  int next = 0;
  for (int round = 0; round < 2; ++round) {
    const int first = next;
    for (std::size_t i = 0; i < FrameLimits::kMostStreams; ++i) ASSERT_EQ(Open(StreamOf(next++)), Refusal::kNone);
    for (int i = first; i < next; ++i) ASSERT_EQ(Client(Reset(StreamOf(i))), Refusal::kNone) << i;
  }
}

TEST_F(FrameLimitsTest, AcceptsTheWindowUpdatesOfTheMostConcurrentCalls) {
  for (std::size_t i = 0; i < FrameLimits::kMostStreams; ++i) {  // as gRPC's Python client begins its calls
    const std::uint32_t stream = StreamOf(static_cast<int>(i));
    ASSERT_EQ(Open(stream), Refusal::kNone);
    ASSERT_EQ(Client(FrameBytes(FrameType::kWindowUpdate, 0, stream, "1234")), Refusal::kNone) << i;
    ASSERT_EQ(Client(FrameBytes(FrameType::kWindowUpdate, 0, 0, "1234")), Refusal::kNone) << i;
  }
  for (std::size_t i = 0; i < FrameLimits::kMostStreams; ++i) {  // and ends those that the server has refused
    const std::uint32_t stream = StreamOf(static_cast<int>(i));
    ASSERT_EQ(Server(FrameBytes(FrameType::kHeaders, kEndHeaders | kEndStream, stream, "\x88")), Refusal::kNone);
    ASSERT_EQ(Client(Reset(stream)), Refusal::kNone) << i;
  }
}

TEST_F(FrameLimitsTest, EndsRapidResetsAfterABurstAndAccepts33PerSecond) {
  int next = 0;
  const auto open_and_reset = [&](int) {
    const std::uint32_t stream = StreamOf(next++);
    const Refusal refusal = Open(stream);
    return refusal != Refusal::kNone ? refusal : Client(Reset(stream));
  };
  EXPECT_EQ(Until(open_and_reset), Ends(kResets, Refusal::kTooManyResets));
  FrameLimits other(nullptr);
  for (int i = 0; i < 3000; ++i) {  // a planner that cancels its calls, 30 per second
    now_ += milliseconds(33);
    const std::uint32_t stream = StreamOf(i);
    ASSERT_EQ(other.FromClient(FrameBytes(FrameType::kHeaders, kEndHeaders, stream, "\x82"), now_), Refusal::kNone);
    ASSERT_EQ(other.FromClient(Reset(stream), now_), Refusal::kNone);
  }
}

TEST_F(FrameLimitsTest, DoesNotCountResetsOfCallsBeingAnswered) {
  const auto watch_and_reset = [&](int i) {
    const Refusal refusal = Open(StreamOf(i));
    EXPECT_EQ(Server(FrameBytes(FrameType::kHeaders, kEndHeaders, StreamOf(i), "\x88")), Refusal::kNone);
    return refusal != Refusal::kNone ? refusal : Client(Reset(StreamOf(i)));
  };
  EXPECT_EQ(Until(watch_and_reset), Ends(5000, Refusal::kNone));
}

TEST_F(FrameLimitsTest, CountsResetsThatTheClientProvokes) {
  const auto made_to_reset = [&](int i) {
    const Refusal refusal = Open(StreamOf(i));
    return refusal != Refusal::kNone ? refusal : Server(Reset(StreamOf(i), 1));
  };
  EXPECT_EQ(Until(made_to_reset), Ends(kResets, Refusal::kTooManyResets));
}

TEST_F(FrameLimitsTest, DoesNotCountTheResetWithWhichGrpcEndsACallEarly) {
  const auto ended_early = [&](int i) {
    const Refusal refusal = Open(StreamOf(i));
    EXPECT_EQ(Server(FrameBytes(FrameType::kHeaders, kEndHeaders | kEndStream, StreamOf(i), "\x88")), Refusal::kNone);
    return refusal != Refusal::kNone ? refusal : Server(Reset(StreamOf(i), 0));
  };
  EXPECT_EQ(Until(ended_early), Ends(5000, Refusal::kNone));
}

TEST_F(FrameLimitsTest, EndsEndlessContinuations) {
  ASSERT_EQ(Client(FrameBytes(FrameType::kHeaders, 0, 1, "\x82")), Refusal::kNone);
  EXPECT_EQ(Until([&](int) { return Client(FrameBytes(FrameType::kContinuation, 0, 1, "\x82")); }),
            Ends(7, Refusal::kHeaderTooLarge));
}

TEST_F(FrameLimitsTest, EndsEmptyContinuationsToo) {
  ASSERT_EQ(Client(FrameBytes(FrameType::kHeaders, 0, 1)), Refusal::kNone);
  EXPECT_EQ(Until([&](int) { return Client(FrameBytes(FrameType::kContinuation, 0, 1)); }),
            Ends(7, Refusal::kHeaderTooLarge));
}

TEST_F(FrameLimitsTest, RefusesAHeaderBlockAbove16KiBBeforeItHasArrived) {
  ASSERT_EQ(Client(FrameHeadBytes(10'000, FrameType::kHeaders, 0, 1) + "\x44\x7f\x91\x4d" + std::string(9'996, 'p')),
            Refusal::kNone);
  EXPECT_EQ(Client(FrameHeadBytes(10'000, FrameType::kContinuation, 0, 1)), Refusal::kHeaderTooLarge);
}

TEST_F(FrameLimitsTest, SkipsPriorityAndPaddingOfHeaders) {
  const std::string fields = testing::CallFields("/a/b");
  const std::string padded = "\x03" + std::string(5, '\xFF') + fields + "\xFF\xFF\xFF";
  EXPECT_EQ(Client(FrameBytes(FrameType::kHeaders, kEndHeaders | kPadded | kPriority, 1, padded)), Refusal::kNone);
  EXPECT_EQ(Client(FrameBytes(FrameType::kHeaders, kEndHeaders | kPadded, 3, "\x05\x82")), Refusal::kMalformed);
  FrameLimits other(nullptr);
  EXPECT_EQ(other.FromClient(FrameBytes(FrameType::kHeaders, kEndHeaders | kPriority, 1, "\x82"), now_),
            Refusal::kMalformed);
}

TEST_F(FrameLimitsTest, EndsControlFramesAfter200) {
  for (const std::string& frame :
       {FrameBytes(FrameType::kPing, 0, 0, "12345678"), FrameBytes(FrameType::kSettings, 0, 0),
        FrameBytes(FrameType::kSettings, kAck, 0), FrameBytes(FrameType::kData, 0, 1),
        FrameBytes(FrameType::kPriority, 0, 1, "12345"), FrameBytes(FrameType::kWindowUpdate, 0, 0, "1234"),
        FrameBytes(static_cast<FrameType>(0xFA), 0, 0, "?"), FrameBytes(FrameType::kGoAway, 0, 0, "12345678")}) {
    FrameLimits limits(nullptr);
    EXPECT_EQ(Until([&](int) { return limits.FromClient(frame, now_); }), Ends(200, Refusal::kTooManyControlFrames));
  }
}

TEST_F(FrameLimitsTest, AcceptsWindowUpdatesAndPingsOfAReaderOfALongAnswer) {
  const std::string data = FrameHeadBytes(16'384, FrameType::kData, 0, 1) + std::string(16'384, 'x');
  const std::string answers = FrameBytes(FrameType::kWindowUpdate, 0, 0, "1234") +
                              FrameBytes(FrameType::kWindowUpdate, 0, 1, "1234") +
                              FrameBytes(FrameType::kPing, 0, 0, "12345678");
  ASSERT_EQ(Open(1), Refusal::kNone);
  const auto one = [&](int) {
    EXPECT_EQ(Server(data), Refusal::kNone);
    return Client(answers);
  };
  EXPECT_EQ(Until(one), Ends(5000, Refusal::kNone));
}

TEST_F(FrameLimitsTest, AcceptsDataOfAnyLengthUpToAFrame) {
  ASSERT_EQ(Open(1), Refusal::kNone);
  const std::string data = FrameHeadBytes(16'384, FrameType::kData, 0, 1) + std::string(16'384, 'x');
  EXPECT_EQ(Until([&](int) { return Client(data); }), Ends(5000, Refusal::kNone));
  EXPECT_EQ(Client(FrameHeadBytes(16'385, FrameType::kData, 0, 1)), Refusal::kFrameTooLarge);
}

TEST_F(FrameLimitsTest, EndsAClientThatDoesNotAcknowledgeSettingsInTime) {
  ASSERT_EQ(Server(FrameBytes(FrameType::kSettings, 0, 0)), Refusal::kNone);
  EXPECT_EQ(limits_.AtTime(now_ + seconds(10)), Refusal::kNone);
  EXPECT_EQ(limits_.AtTime(now_ + milliseconds(10'001)), Refusal::kSettingsUnacknowledged);
  ASSERT_EQ(Client(FrameBytes(FrameType::kSettings, kAck, 0)), Refusal::kNone);
  EXPECT_EQ(limits_.AtTime(now_ + seconds(1000)), Refusal::kNone);
}

TEST_F(FrameLimitsTest, RefusesFramesThatWouldHideAHeaderBlock) {
  const auto after_headers = [&](const std::string& frame) {
    FrameLimits limits(nullptr);
    EXPECT_EQ(limits.FromClient(FrameBytes(FrameType::kHeaders, 0, 1, "\x82"), now_), Refusal::kNone);
    return limits.FromClient(frame, now_);
  };
  EXPECT_EQ(after_headers(FrameBytes(FrameType::kData, 0, 1, "x")), Refusal::kMalformed);
  EXPECT_EQ(after_headers(FrameBytes(FrameType::kContinuation, kEndHeaders, 3, "\x82")), Refusal::kMalformed);
  EXPECT_EQ(after_headers(FrameBytes(FrameType::kContinuation, kEndHeaders, 1, "\x82")), Refusal::kNone);
  EXPECT_EQ(Client(FrameBytes(FrameType::kContinuation, kEndHeaders, 1, "\x82")), Refusal::kMalformed);
}

TEST_F(FrameLimitsTest, DecidesTheSameForAnyPieces) {
  std::string bytes;
  for (int i = 0; i < 20; ++i) {
    bytes += FrameBytes(FrameType::kHeaders, kEndHeaders, StreamOf(i), testing::CallFields("/a/b"));
    bytes += FrameBytes(FrameType::kData, kEndStream, StreamOf(i), std::string(50, 'x'));
    if (i % 2 == 0) bytes += Reset(StreamOf(i));
  }
  for (const std::size_t piece_bytes : {1, 5, 9, 64}) {
    FrameLimits limits(nullptr);
    for (std::size_t at = 0; at < bytes.size(); at += piece_bytes) {
      ASSERT_EQ(limits.FromClient(std::string_view(bytes).substr(at, piece_bytes), now_), Refusal::kNone);
    }
    EXPECT_EQ(limits.num_streams(), 10u);
  }
}

TEST_F(FrameLimitsTest, LimitsTheResetsOfAllConnectionsOfAPeer) {
  PeerTable peers(100);
  const auto reset_all = [&] {
    FrameLimits limits(peers.Join("192.0.2.7", now_));
    return Until([&](int i) {
             (void)limits.FromClient(FrameBytes(FrameType::kHeaders, kEndHeaders, StreamOf(i), "\x82"), now_);
             return limits.FromClient(Reset(StreamOf(i)), now_);
           })
        .first;
  };
  int num_resets = 0;
  for (int i = 0; i < 20; ++i) num_resets += reset_all();
  EXPECT_EQ(num_resets, 20 * static_cast<int>(FrameLimits::kOwnResets) + static_cast<int>(PeerCounts::kResets));
}

TEST(PeerTable, LimitsTheConnectionsOfAPeerAndDropsIdlePeers) {
  PeerTable peers(2);
  auto now = PeerTable::Time() + seconds(1000);
  auto first = peers.Join("a", now);
  const auto second = peers.Join("a", now);
  EXPECT_NE(second, nullptr);
  EXPECT_EQ(peers.Join("a", now), nullptr);
  EXPECT_NE(peers.Join("b", now), nullptr);
  first.reset();
  EXPECT_NE(peers.Join("a", now), nullptr);
  for (int i = 0; i < 100'000; ++i) (void)peers.Join(std::to_string(i), now);
  EXPECT_LT(peers.size(), 200u);
}

TEST(PeerTable, RemembersTheResetsOfAPeer) {
  PeerTable peers(2);
  const auto now = PeerTable::Time() + seconds(1000);
  while (peers.Join("a", now)->TakeReset(now)) continue;
  for (int i = 0; i < 1000; ++i) (void)peers.Join(std::to_string(i), now);
  EXPECT_FALSE(peers.Join("a", now)->TakeReset(now));
  EXPECT_TRUE(peers.Join("a", now + seconds(1))->TakeReset(now + seconds(1)));
}

}  // namespace
}  // namespace dhpmap::net
