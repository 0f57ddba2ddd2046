#include "master/trace/advance_time.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include <fmt/format.h>

namespace stride::trace {
namespace {

void check_type(const Reader& reader, const Declaration& declaration) {
  constexpr std::array<std::string_view, 12> kNumbers = {"wire", "integer", "reg",  "time",
                                                         "bit",  "logic",   "int",  "longint",
                                                         "tri",  "var",     "port", "parameter"};
  constexpr std::uint32_t kMost = 64;
  const std::string_view type = reader.header().at(declaration.type);
  const bool is_number = std::find(kNumbers.begin(), kNumbers.end(), type) != kNumbers.end();
  if (is_number && declaration.width > 0 && declaration.width <= kMost) return;
  reader.fail(declaration.line,
              fmt::format("{} is declared as {} {}; expected integer 64 or wire 64", kAdvanceTime,
                          Words::shown(type), declaration.width));
}

/// The digits of a scalar or a vector, without leading zeros.
std::string_view digits_of(std::string_view value) {
  const bool is_vector = value.front() == 'b' || value.front() == 'B';
  const std::string_view digits = is_vector ? value.substr(1) : value;
  return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
}

}  // namespace

bool is_advance_time(const Header& header, const Declaration& declaration) {
  return header.at(declaration.name) == kAdvanceTime;
}

std::optional<AdvanceTime> AdvanceTime::of(const Reader& reader) {
  const Header& header = reader.header();
  const Declaration* found = nullptr;
  for (const Declaration& declaration : header.declarations) {
    if (!is_advance_time(header, declaration)) continue;
    check_type(reader, declaration);
    if (found != nullptr && found->code != declaration.code) {
      reader.fail(
          declaration.line,
          fmt::format("there is a second {}, the first is in line {}", kAdvanceTime, found->line),
          "a trace is of one kernel, and has one; trace it once only");
    }
    found = &declaration;
  }
  if (found == nullptr) return std::nullopt;
  AdvanceTime made;
  made.code_ = found->code;
  for (const Declaration& declaration : header.declarations) {
    if (declaration.code == made.code_ && !is_advance_time(header, declaration)) {
      made.is_alone_ = false;
    }
  }
  return made;
}

void AdvanceTime::update(const Reader& reader, const Entry& change) {
  const std::string_view digits = digits_of(change.value);
  constexpr std::size_t kMost = 63;
  std::uint64_t value = 0;
  const char* const end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, value, 2);
  const bool is_empty = change.value == "b" || change.value == "B";
  if (is_empty || read.ptr != end) {
    reader.fail(change.line, fmt::format("{} is '{}'; expected a whole number, such as b1001",
                                         kAdvanceTime, Words::shown(change.value)));
  }
  if (digits.size() > kMost) {
    reader.fail(change.line, fmt::format("{} is negative, or beyond 2^63 - 1", kAdvanceTime));
  }
  const auto total = static_cast<std::int64_t>(value);
  if (total < total_) {
    reader.fail(
        change.line,
        fmt::format("{} falls to {} from {} in line {}; what was skipped is never given back",
                    kAdvanceTime, total, total_, line_),
        "it is the total that was skipped so far, not the length of the last skip");
  }
  total_ = total;
  line_ = change.line;
}

}  // namespace stride::trace
