// The coverage of a scenario, resolved to the variables of its system.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_DEFINITION_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_DEFINITION_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "master/base/error.h"
#include "master/engine/model/variable_id.h"
#include "master/observe/coverage/bins.h"

namespace stride::coverage {

/// What the bins of a point are of. Values: of a signal. Transitions: from one value of a signal to
/// the next. Words, Lengths: of messages. Sequences: from one word to that of the next message.
/// Gaps: the times between messages. Cross: of bins of other points at the same time.
enum class Kind : std::uint8_t { Values, Transitions, Words, Lengths, Sequences, Gaps, Cross };

/// As coverage.json has it: "values".
const char* name(Kind kind);
/// Nothing for another text.
std::optional<Kind> kind_of(std::string_view name);

inline bool is_of_signal(Kind kind) { return kind == Kind::Values || kind == Kind::Transitions; }

/// A cross has so many parts at most.
inline constexpr std::size_t kMostParts = 4;

/// A coverpoint or a cross.
struct PointDefinition {
  std::string name;  ///< unique in its group
  Kind kind = Kind::Values;
  core::VariableId id{};    ///< of no cross
  std::size_t element = 0;  ///< of a signal
  std::string signal{};     ///< the name within the component
  std::string unit{};       ///< of measure, of values
  std::uint64_t at_least = 1;
  bool is_open = false;  ///< its bins are found only as they are seen
  std::vector<DeclaredBin> bins{};
  std::vector<std::string> ignored{};       ///< names or globs of bins; applied to `bins` already
  std::optional<Classes> classes{};         ///< of a signal
  std::optional<std::uint64_t> greatest{};  ///< of lengths
  std::vector<std::pair<std::string, std::int64_t>> items{};  ///< of an Enumeration's messages
  bool is_text = false;                                       ///< its words are of a Binary
  std::vector<std::size_t> of{};  ///< of a cross: the indices of earlier points of the group

  /// Whether a bin with this name, which was not declared, is ignored.
  bool ignores(const std::string& bin) const;
  /// Whether a bin with this name, declared or not, is not ignored.
  bool counts(const std::string& bin) const;
};

/// A covergroup: the points of one component.
struct GroupDefinition {
  std::size_t component = 0;
  std::string name;              ///< of the component; unique
  std::optional<double> goal{};  ///< a percentage
  std::vector<PointDefinition> points{};
  core::Location where{};
};

/// The bins of a cross of these points: of each bin that counts with each one of the others. Throws
/// std::invalid_argument if there are more than kMostBins.
std::vector<DeclaredBin> cross_bins(std::span<const PointDefinition* const> parts);
/// What is between the names in that of a cross, or of one of its bins.
inline constexpr std::string_view kCrossJoint = " × ";
/// "a × b", into a text that is there.
void append_crossed(std::string& text, std::string_view bin);

/// The same for points of a component that mean the same, of any scenario: what they are called,
/// what is counted, in which unit and into which bins; of a cross also what its parts mean. 16
/// hexadecimal digits.
std::string hash(const GroupDefinition& group, const PointDefinition& point);

/// What a definition is told by.
struct GroupDigest {
  std::string component;
  std::optional<double> goal{};
  std::vector<std::string> points{};  ///< hash() of each
};

/// The same for the same definitions, whatever the scenario: 64 hexadecimal digits.
std::string hash(std::span<const GroupDigest> groups);
std::string hash(std::span<const GroupDefinition> groups);

}  // namespace stride::coverage

#endif
