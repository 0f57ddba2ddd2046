// What numbers become where they are values of a variable, and their text.
#ifndef STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_VALUE_KIND_H
#define STRIDE_MASTER_STUDY_CAMPAIGN_DEFINITION_VALUE_KIND_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "master/study/campaign/definition/distribution.h"

namespace stride::campaign {

struct ValueKind {
  enum class Type {
    Float64,
    Float32,
    Whole,    ///< an integer of any width
    Instant,  ///< seconds, in whole picoseconds
    Text,     ///< no number: a Boolean, an Enumeration, a String, the name of a unit, an array
  };
  Type type = Type::Float64;
  /// Of the variable, as SSP and FMI call it.
  const char* variable_type = "Float64";
  bool is_array = false;
  /// Of Whole: the least and the largest number that a seed may be.
  std::uint64_t least_seed = 1;
  std::uint64_t most_seed = UINT64_MAX;
};

/// The shortest text that reads back as the same value of this kind, which is no Text. A whole
/// number is the nearest one; an instant, too.
std::string number_text(const ValueKind& kind, double number);

/// The number that the text is, as a whole.
std::optional<double> number_of(std::string_view text);

/// The value of this kind for a point of the unit interval, see quantile(): of a uniform
/// distribution of whole numbers each has the same probability.
std::string drawn_text(const ValueKind& kind, const Distribution& distribution, double u);

/// A number for a seed, made of random bits.
std::string seed_text(const ValueKind& kind, std::uint64_t bits);

}  // namespace stride::campaign

#endif
