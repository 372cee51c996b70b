// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The nvm authors
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace nvm::io {

/// Which of the two times of a recorded message dates it.
enum class ClockChoice {
  kAutomatic,  ///< the header's, unless it stands still
  kHeader,
  kRecord,
};

/// When a message was stamped by its sender, and when it was recorded.
struct MessageTime {
  double stamp = 0.0;   ///< [s]
  double record = 0.0;  ///< [s]
};

/// Takes the jitter off the times of a sensor that measures at a constant rate: a straight line
/// through the last hundred of them, followed from message to message.
class StampSmoother {
 public:
  /// Begins with the line through the ascending `times`, at least two.
  explicit StampSmoother(const std::vector<double>& times);

  /// The time on the line for `time`, which is above that of the call before. Times that are
  /// missing do not matter; one half a period off the line begins a new line.
  double smooth(double time);

  double period() const { return period_; }

  /// The median distance of `times` from the line that the constructor laid [s].
  double jitter() const { return jitter_; }

 private:
  double level_ = 0.0;
  double period_ = 0.0;
  double jitter_ = 0.0;
  double count_ = 0.0;
};

/// Dates the messages of one topic: judges whether their stamps are of use, leaves out those that
/// repeat or come late, and follows stamps that jump against the recorder's clock.
class MessageClock {
 public:
  MessageClock() = default;

  /// Learns from the first messages. `smooths`: jitter above 1.5 ms is taken off.
  MessageClock(const std::vector<MessageTime>& first, ClockChoice choice, bool smooths);

  /// The time [s] of the next message, above that of the one before; nothing when it repeats, is
  /// late, or its stamp jumps: it is to be left out. When three in a row have jumped alike, the
  /// jump is taken off the stamps from then on.
  std::optional<double> date(const MessageTime& message);

  bool uses_record() const { return uses_record_; }
  bool smooths() const { return smoother_.has_value(); }
  double jitter() const { return jitter_; }  ///< [s] of the first messages
  double offset() const { return offset_; }  ///< median of record - stamp [s] of them

  /// The jumps that were taken off, for the user; nothing without one.
  std::optional<std::string> jump_note(const std::string& messages) const;

 private:
  void learn_offset(std::vector<double> offsets);
  bool may_begin(const MessageTime& message) const;
  bool follows(double time, double record) const;

  bool uses_record_ = false;
  double period_ = 0.0;
  double offset_ = 0.0;
  double offset_spread_ = 0.0;  ///< median distance from offset_ [s]
  double jitter_ = 0.0;
  std::optional<StampSmoother> smoother_;
  double previous_ = -std::numeric_limits<double>::infinity();
  double previous_record_ = 0.0;
  double previous_smooth_ = -std::numeric_limits<double>::infinity();
  double jump_ = 0.0;     ///< that is taken off, negated
  double suspect_ = 0.0;  ///< the jump of the messages that were left out last
  int suspect_count_ = 0;
  std::size_t jump_count_ = 0;
  MessageTime first_jump_;  ///< the time before it, and the jump negated
};

/// The clocks of a bag's two topics.
struct Clocks {
  MessageClock cloud;
  MessageClock imu;
  std::vector<std::string> notes;  ///< on what was chosen, for the user
};

/// Chooses by the first messages of both topics. Automatically, the record times date a topic whose
/// stamps stand still, and one whose stamps are in another clock than the other topic's (a second
/// apart or more) and the recorder's.
Clocks choose_clocks(
    const std::vector<MessageTime>& clouds,
    const std::vector<MessageTime>& imu,
    ClockChoice choice);

}  // namespace nvm::io
