// SPDX-License-Identifier: BSD-3-Clause
#include "server/grpc/stream_turns.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace dhpmap {
namespace {

using Intake = StreamTurns::Intake;
using Outlet = StreamTurns::Outlet;
using Todo = StreamTurns::Todo;

/// Reads one message and accepts it as a frame. Returns whether the next may be read.
bool ReadAndAccept(StreamTurns& turns) {
  Todo todo;
  EXPECT_TRUE(turns.OnRead(true, todo));
  EXPECT_TRUE(turns.OnAccepted());
  return turns.OnHandled().read;
}

TEST(StreamTurns, PausesAtTheLimitInFlightAndResumesAfterAWrite) {
  StreamTurns turns(2);
  EXPECT_TRUE(turns.OnStart().read);
  EXPECT_TRUE(ReadAndAccept(turns));
  EXPECT_FALSE(ReadAndAccept(turns));
  EXPECT_EQ(turns.intake(), Intake::kPaused);
  Todo todo;
  EXPECT_TRUE(turns.OnAcknowledged(todo));
  EXPECT_TRUE(todo.write);
  EXPECT_TRUE(turns.OnAcknowledged(todo));
  EXPECT_FALSE(todo.write) << "one write at a time";
  todo = turns.OnWritten(true, 1);
  EXPECT_TRUE(todo.read && todo.write && !todo.end);
}

TEST(StreamTurns, EndsOnceAllIsAcknowledgedAfterTheLastMessage) {
  StreamTurns turns(4);
  (void)turns.OnStart();
  EXPECT_TRUE(ReadAndAccept(turns));
  Todo todo;
  EXPECT_FALSE(turns.OnRead(false, todo));
  EXPECT_FALSE(todo.end);
  EXPECT_TRUE(turns.OnAcknowledged(todo));
  EXPECT_FALSE(todo.end) << "it is not with the client yet";
  EXPECT_TRUE(turns.OnWritten(true, 0).end);
  EXPECT_EQ(turns.intake(), Intake::kOver);
  EXPECT_FALSE(turns.OnStop().end) << "said once";
}

TEST(StreamTurns, AStopDropsTheHandledMessageAndIgnoresTheRunningRead) {
  StreamTurns handling(4);
  (void)handling.OnStart();
  Todo todo;
  EXPECT_TRUE(handling.OnRead(true, todo));
  EXPECT_FALSE(handling.OnStop().end);
  EXPECT_EQ(handling.intake(), Intake::kHandlingLast);
  EXPECT_FALSE(handling.OnAccepted());
  EXPECT_TRUE(handling.OnHandled().end);

  StreamTurns reading(4);
  (void)reading.OnStart();
  EXPECT_TRUE(reading.OnStop().end);
  EXPECT_FALSE(reading.OnRead(true, todo));
  EXPECT_FALSE(todo.read || todo.write || todo.end);
}

TEST(StreamTurns, NothingIsWrittenToADisconnectedClient) {
  StreamTurns turns(4);
  (void)turns.OnStart();
  for (int i = 0; i < 3; ++i) ReadAndAccept(turns);
  Todo todo;
  EXPECT_TRUE(turns.OnAcknowledged(todo));
  EXPECT_TRUE(turns.OnAcknowledged(todo));
  EXPECT_FALSE(turns.OnWritten(false, 1).end) << "a third frame is with the writer";
  EXPECT_EQ(turns.outlet(), Outlet::kBroken);
  EXPECT_EQ(turns.num_in_flight(), 1);
  EXPECT_FALSE(turns.OnAcknowledged(todo)) << "nobody is there to read it";
  EXPECT_TRUE(todo.end);
}

TEST(StreamTurns, KnowsTheLastFrameAfterAHalfClose) {
  StreamTurns turns(4);
  (void)turns.OnStart();
  ReadAndAccept(turns);
  ReadAndAccept(turns);
  EXPECT_FALSE(turns.IsAtLastFrame());
  Todo todo;
  EXPECT_FALSE(turns.OnRead(false, todo));
  EXPECT_FALSE(turns.IsAtLastFrame()) << "two are with the writer";
  EXPECT_TRUE(turns.OnAcknowledged(todo));
  EXPECT_TRUE(turns.IsAtLastFrame());
  EXPECT_FALSE(turns.OnSettled().end) << "the first acknowledgement is under way";
  EXPECT_FALSE(turns.IsAtLastFrame());
  EXPECT_TRUE(turns.OnWritten(true, 0).end);
  EXPECT_TRUE(turns.is_over());
}

TEST(StreamTurns, AFrameSettledWithoutAcknowledgementFreesItsPlaceAndEnds) {
  StreamTurns turns(1);
  (void)turns.OnStart();
  EXPECT_FALSE(ReadAndAccept(turns));
  EXPECT_TRUE(turns.OnSettled().read);
  Todo todo;
  EXPECT_TRUE(turns.OnRead(true, todo));
  EXPECT_TRUE(turns.OnAccepted());
  EXPECT_FALSE(turns.OnStop().end);
  EXPECT_FALSE(turns.OnSettled().end) << "it is still being handled";
  EXPECT_TRUE(turns.OnHandled().end);
}

/// Simulates gRPC, the writer and the client at random, and checks each action of the stream.
class RandomPlay {
 public:
  RandomPlay(int max_in_flight, unsigned seed) : turns_(max_in_flight), max_in_flight_(max_in_flight), random_(seed) {}

  /// Runs to the end; returns the number of frames that were acknowledged or dropped.
  int Run() {
    Take(turns_.OnStart());
    for (int step = 0; !ended_; ++step) {
      EXPECT_LT(step, 100'000) << "the stream never ends";
      if (step >= 100'000) break;
      Step(step > 500);
    }
    return num_done_;
  }
  int num_accepted() const { return num_accepted_; }

 private:
  int Pick(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  void Take(Todo todo) {
    EXPECT_FALSE(todo.read && is_reading_) << "one read at a time";
    EXPECT_FALSE(todo.write && is_writing_) << "one write at a time";
    is_reading_ = is_reading_ || todo.read;
    is_writing_ = is_writing_ || todo.write;
    if (todo.end) {
      EXPECT_FALSE(std::exchange(ended_, true)) << "ended twice";
      EXPECT_EQ(num_accepted_, num_done_) << "ended before all was acknowledged";
      EXPECT_FALSE(is_handling_);
    }
    EXPECT_LE(num_accepted_ - num_done_, max_in_flight_);
  }

  void Step(bool must_end) {
    Todo todo;
    switch (Pick(6)) {
      case 0:
        if (!is_reading_) return;
        is_reading_ = false;
        is_handling_ = turns_.OnRead(!must_end && Pick(50) != 0, todo);
        return Take(todo);
      case 1:
        if (!is_handling_) return;
        if (Pick(10) != 0 && turns_.OnAccepted()) ++num_accepted_, ++with_writer_;
        is_handling_ = false;
        return Take(turns_.OnHandled());
      case 2:
        if (with_writer_ == 0) return;
        EXPECT_EQ(turns_.IsAtLastFrame(), with_writer_ == 1 && turns_.intake() == Intake::kEnded);
        --with_writer_;
        if (Pick(5) == 0) {
          ++num_done_;
          return Take(turns_.OnSettled());
        }
        if (turns_.OnAcknowledged(todo)) ++num_waiting_;
        else ++num_done_;
        return Take(todo);
      case 3: {
        if (!is_writing_) return;
        is_writing_ = false;
        const bool ok = Pick(60) != 0;
        const int num_others = num_waiting_ - 1;
        num_done_ += ok ? 1 : num_waiting_;
        num_waiting_ = ok ? num_others : 0;
        return Take(turns_.OnWritten(ok, num_others));
      }
      default:
        if (Pick(200) == 0) Take(turns_.OnStop());
    }
  }

  StreamTurns turns_;
  const int max_in_flight_;
  std::mt19937 random_;
  bool is_reading_ = false, is_handling_ = false, is_writing_ = false, ended_ = false;
  int num_accepted_ = 0, with_writer_ = 0, num_waiting_ = 0, num_done_ = 0;
};

TEST(StreamTurns, AnyOrderOfEventsEndsOnceWithAllAcknowledged) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    RandomPlay play(1 + static_cast<int>(seed % 4), seed);
    const int num_done = play.Run();
    EXPECT_EQ(num_done, play.num_accepted()) << seed;
  }
}

}  // namespace
}  // namespace dhpmap
