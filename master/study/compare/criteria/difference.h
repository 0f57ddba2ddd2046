// What two runs do not have in common.
#ifndef STRIDE_MASTER_STUDY_COMPARE_CRITERIA_DIFFERENCE_H
#define STRIDE_MASTER_STUDY_COMPARE_CRITERIA_DIFFERENCE_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

namespace stride::compare {

/// Of what one is; at one instant, those before come first.
enum class Kind { Message, Event, Signal, Coverage, Check, Verdict, Outcome, File };

/// As in the table and in JSON: "signal".
const char* name(Kind kind);

/// The greatest difference of the finite values of a signal, and where it is.
struct Extreme {
  double value = 0;
  Time time;
  std::string a;
  std::string b;
};

/// All differences of one signal, one stream of messages, one verdict.
struct Difference {
  Kind kind = Kind::Signal;
  std::string name;
  /// Of the first one; nothing for what is of the run as a whole.
  std::optional<Time> time{};
  std::string a{};        ///< what each run has there
  std::string b{};        ///< likewise
  std::size_t count = 1;  ///< of places that differ: values, messages, bins
  std::optional<Extreme> absolute{};
  std::optional<Extreme> relative{};  ///< to the value of B, where that is not 0
};

/// What one has of a row that the other has not.
inline constexpr const char* kRow = "a row";

using Differences = std::vector<Difference>;

}  // namespace stride::compare

#endif
