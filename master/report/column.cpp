#include "master/report/column.h"

#include <charconv>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <stride/value_text.h>

#include "master/base/message_text.h"

namespace stride::report {
namespace {

using Booleans = std::vector<std::uint8_t>;
using Integers = std::vector<std::int32_t>;
using Doubles = std::vector<double>;
using core::ValueType;

/// Each integer up to here is a double.
constexpr std::int64_t kMostExact = std::int64_t{1} << 53;

bool is_text(ValueType type) { return type == ValueType::String || type == ValueType::Binary; }

Column::Values empty_values(ValueType type) {
  if (type == ValueType::Boolean) return Booleans();
  if (is_text(type)) return Texts();
  if (core::is_real(type)) return Doubles();
  return Integers();
}

/// The whole text as a number.
template <class Number>
std::optional<Number> parse(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || at != end || text.empty()) return std::nullopt;
  return number;
}

/// Whether a double has it as it is written: not the digits of a text such as 007, and no integer
/// that a double does not have.
bool is_exact_number(std::string_view text) {
  if (!parse<double>(text)) return false;
  const std::string_view digits = text.substr(text.starts_with('-') ? 1 : 0);
  if (digits.find_first_not_of("0123456789") != std::string_view::npos) return true;
  if (digits.size() > 1 && digits.front() == '0') return false;
  const auto number = parse<std::int64_t>(text);
  return number && -kMostExact <= *number && *number <= kMostExact;
}

[[noreturn]] void reject(std::string_view text, ValueType type, const char* expected) {
  constexpr std::size_t kMostShown = 40;
  throw std::invalid_argument(fmt::format(
      "expected {} (the type is {}), found '{}{}'", expected, core::name(type),
      core::name_text(text.substr(0, kMostShown)), text.size() > kMostShown ? "…" : ""));
}

/// As signals.csv has it.
std::string text_of(double value, ValueType type) {
  if (!core::is_real(type)) return std::to_string(static_cast<std::int64_t>(value));
  std::string text;
  append_value(text, value);
  return text;
}

template <class Element>
void keep_in(std::vector<Element>& values, std::size_t first, std::span<const std::size_t> rows) {
  std::size_t to = first;
  for (const std::size_t row : rows) values[to++] = values[row];
  values.resize(to);
}

void keep_in(Texts& texts, std::size_t first, std::span<const std::size_t> rows) {
  texts.keep(first, rows);
}

}  // namespace

void Texts::add(const std::string& text) {
  const auto [place, is_new] =
      places_.try_emplace(text, static_cast<std::int32_t>(distinct_.size()));
  if (is_new) distinct_.push_back(text);
  indices_.push_back(place->second);
}

void Texts::keep(std::size_t first, std::span<const std::size_t> rows) {
  keep_in(indices_, first, rows);
  if (distinct_.size() > 2 * indices_.size()) drop_unused();
}

void Texts::drop_unused() {
  std::vector<std::string> all = std::exchange(distinct_, {});
  std::vector<std::int32_t> places(all.size(), -1);
  for (const std::int32_t index : indices_) places[static_cast<std::size_t>(index)] = 0;
  places_.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (places[i] < 0) continue;
    places[i] = static_cast<std::int32_t>(distinct_.size());
    places_.emplace(all[i], places[i]);
    distinct_.push_back(std::move(all[i]));
  }
  for (std::int32_t& index : indices_) index = places[static_cast<std::size_t>(index)];
}

Column::Column(SignalInfo info) : info_(std::move(info)), values_(empty_values(info_.type)) {}

Column::Column(std::string name, std::string unit)
    : info_{std::move(name), std::move(unit)}, is_deduced_(true), values_(Doubles()) {}

bool Column::is_stepped() const { return !info_.is_continuous || !core::is_real(info_.type); }

std::size_t Column::size() const {
  return std::visit([](const auto& values) { return values.size(); }, values_);
}

std::string Column::text(std::size_t row) const {
  if (const Booleans* booleans = std::get_if<Booleans>(&values_)) {
    return (*booleans)[row] != 0 ? "true" : "false";
  }
  if (const Integers* integers = std::get_if<Integers>(&values_)) {
    return std::to_string((*integers)[row]);
  }
  if (const Doubles* doubles = std::get_if<Doubles>(&values_)) {
    return text_of((*doubles)[row], info_.type);
  }
  const Texts& texts = std::get<Texts>(values_);
  return texts.distinct()[static_cast<std::size_t>(texts.indices()[row])];
}

void Column::append(const core::CsvReader::Field& field) {
  if (is_deduced_) deduce(field);
  if (Doubles* doubles = std::get_if<Doubles>(&values_); doubles && core::is_real(info_.type)) {
    append_number(field.text);
  } else if (Texts* texts = std::get_if<Texts>(&values_); texts && is_text(info_.type)) {
    texts->add(field.value());
  } else if (Booleans* booleans = std::get_if<Booleans>(&values_)) {
    if (field.text != "true" && field.text != "false") {
      reject(field.text, info_.type, "true or false");
    }
    booleans->push_back(field.text == "true");
  } else {
    append_integer(field.text);
  }
}

void Column::append_number(std::string_view text) {
  const auto number = parse<double>(text);
  if (!number) reject(text, info_.type, "a number");
  std::get<Doubles>(values_).push_back(*number);
}

/// Into integers of 32 bits, doubles, or texts: whatever the column has become.
void Column::append_integer(std::string_view text) {
  const auto number = parse<std::int64_t>(text);
  if (!number && !parse<std::uint64_t>(text)) reject(text, info_.type, "an integer");
  Integers* integers = std::get_if<Integers>(&values_);
  if (integers != nullptr && number && *number == static_cast<std::int32_t>(*number)) {
    return integers->push_back(static_cast<std::int32_t>(*number));
  }
  const bool is_exact = number && -kMostExact <= *number && *number <= kMostExact;
  if (integers != nullptr) become_doubles();
  if (!is_exact && !std::holds_alternative<Texts>(values_)) become_texts();
  if (Texts* texts = std::get_if<Texts>(&values_)) return texts->add(std::string(text));
  std::get<Doubles>(values_).push_back(static_cast<double>(*number));
}

/// Where the type of the column is not known: makes it what the field fits into.
void Column::deduce(const core::CsvReader::Field& field) {
  const bool is_boolean = !field.is_quoted && (field.text == "true" || field.text == "false");
  const bool is_number = !field.is_quoted && is_exact_number(field.text);
  const ValueType type =
      is_boolean ? ValueType::Boolean : (is_number ? ValueType::Float64 : ValueType::String);
  if (size() == 0) {
    info_.type = type;
    values_ = empty_values(type);
  } else if (type != info_.type && info_.type != ValueType::String) {
    become_texts();
    info_.type = ValueType::String;
  }
}

void Column::become_doubles() {
  const Integers& integers = std::get<Integers>(values_);
  values_ = Doubles(integers.begin(), integers.end());
}

void Column::become_texts() {
  Texts texts;
  if (const Doubles* doubles = std::get_if<Doubles>(&values_)) {
    for (const double value : *doubles) texts.add(text_of(value, info_.type));
  } else {
    for (const bool value : std::get<Booleans>(values_)) texts.add(value ? "true" : "false");
  }
  values_ = std::move(texts);
}

void Column::keep(std::size_t first, std::span<const std::size_t> rows) {
  std::visit([&](auto& values) { keep_in(values, first, rows); }, values_);
}

void Column::drop_unused_texts() {
  if (Texts* texts = std::get_if<Texts>(&values_)) texts->drop_unused();
}

}  // namespace stride::report
