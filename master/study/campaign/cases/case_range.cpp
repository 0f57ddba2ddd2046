#include "master/study/campaign/cases/case_range.h"

#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include "master/study/campaign/plan.h"

namespace stride::campaign {

std::optional<std::uint64_t> parse_case_index(std::string_view text) {
  std::uint64_t index = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, index);
  const bool is_whole = error == std::errc() && rest == end && index < Plan::kMostCases;
  return is_whole ? std::optional(index) : std::nullopt;
}

std::string to_text(const CaseRange& range) {
  if (range.first == range.last) return fmt::format("{}", range.first);
  return fmt::format("{}-{}", range.first, range.last);
}

std::optional<CaseRange> parse_case_range(std::string_view text) {
  const std::size_t dash = text.find('-');
  const auto first = parse_case_index(text.substr(0, dash));
  const auto last =
      dash == std::string_view::npos ? first : parse_case_index(text.substr(dash + 1));
  if (!first || !last || *first > *last) return std::nullopt;
  return CaseRange{*first, *last};
}

}  // namespace stride::campaign
