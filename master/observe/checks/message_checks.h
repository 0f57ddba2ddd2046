// Checks of messages.
#ifndef STRIDE_MASTER_OBSERVE_CHECKS_MESSAGE_CHECKS_H
#define STRIDE_MASTER_OBSERVE_CHECKS_MESSAGE_CHECKS_H

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "master/observe/checks/check.h"

namespace stride::checks {

/// Answer: each request is followed by a reply in time. Its margin is the least time that was left
/// at a reply, or else the greatest time by which one was late: a reply that answers no open
/// request answers the oldest one whose time was out; with `repeats` each reply does.
class AnswerCheck final : public Check {
 public:
  /// What it demands is an AnswerDemand.
  explicit AnswerCheck(const Definition& definition);

  void on_message(const core::Message& message) override;
  void persist(core::StateArchive& state) override;
  void on_point(Time time) override;

 private:
  Time deadline(Time request) const { return later(request, demand_.within); }
  /// Gives up the requests whose time was out before this time.
  void expire_before(Time time);
  void add_reply(Time time);
  void add_request(Time time);
  void add_late_reply(Time time);
  void extend_margin(Duration margin, Time time);
  core::Verdict judged(const Ending& ending) const override;
  core::Verdict unanswered_verdict() const;
  core::Margin margin(const Ending& ending) const override;

  const AnswerDemand& demand_;
  std::vector<Time> open_;  ///< requests, the oldest first
  std::deque<Time> late_;   ///< those whose time was out before a reply came, likewise
  std::uint64_t requests_ = 0;
  std::uint64_t answered_ = 0;
  Duration slowest_{};
  std::optional<Time> unanswered_;     ///< the first request without a reply in time
  std::optional<Time> last_;           ///< the last communication point
  Duration margin_ = Duration::max();  ///< the least of the requests that were answered
  Time margin_at_{};
};

/// Count: how many messages travel during the interval. Its margin is how many more or fewer there
/// may be, or, if negative, how many are too many or missing.
class CountCheck final : public Check {
 public:
  /// What it demands is a CountDemand.
  explicit CountCheck(const Definition& definition);

  void on_message(const core::Message& message) override;
  void persist(core::StateArchive& state) override;
  void on_point(Time time) override { last_ = time; }

 private:
  core::Verdict judged(const Ending& ending) const override;
  core::Margin margin(const Ending& ending) const override;
  std::string text() const;

  const CountDemand& demand_;
  std::uint64_t count_ = 0;
  std::optional<Time> exceeded_at_;
  std::optional<Time> last_;  ///< the last communication point
};

}  // namespace stride::checks

#endif
