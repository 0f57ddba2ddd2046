// Points of the messages of a variable.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_MESSAGE_POINT_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_MESSAGE_POINT_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "master/engine/port/observer.h"
#include "master/observe/coverage/point.h"

namespace stride::coverage {

/// Words, Lengths, Sequences and Gaps.
class MessagePoint final : public Point {
 public:
  using Point::Point;

  /// One at its variable.
  void on_message(const core::Message& message);

  std::size_t latest() const override { return latest_; }
  void persist(core::StateArchive& state) override;

 private:
  std::string_view word(const core::Message& message);
  std::string_view number_word(const core::ValueBlock& block, std::size_t element);
  void add_word(const core::Message& message);
  void add_length(const core::Message& message);
  void add_to_sequence(const core::Message& message);
  void add_gap(Time time);
  void visit(std::string_view bin, Time time);

  std::size_t latest_ = kNoBin;
  std::optional<Time> before_;   ///< the message before, of Gaps
  std::string previous_, pair_;  ///< its word, of Sequences
  bool has_previous_ = false;
  std::string text_;  ///< of a word that had to be written
};

/// The first word of a text, fit to be shown, and of limited length; `made` is where it is kept if
/// it had to be changed.
std::string_view first_word(std::string_view text, std::string& made);

}  // namespace stride::coverage

#endif
