#include "master/observe/trace/instants.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

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

/// By the letter of its type: whether its code is behind a blank.
bool is_vector(std::string_view value) {
  return std::string_view("bBrRsS").find(value.front()) != std::string_view::npos;
}

void write_line(Spool& text, std::string_view line) {
  text.write(line);
  text.write('\n');
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
    reader.fail(change.line,
                fmt::format("{} falls to {} from {} in line {}; skipped time never decreases",
                            kAdvanceTime, total, total_, line_),
                "it is the total that was skipped so far, not the length of the last skip");
  }
  total_ = total;
  line_ = change.line;
}

InstantReader::InstantReader(Reader& reader, Text text)
    : reader_(reader), keeps_text_(text == Text::Keep), advance_(AdvanceTime::of(reader)) {}

bool InstantReader::next(Instant& instant) {
  if (!is_first_ && ahead_ == nullptr) return false;
  instant.has_stamp = ahead_ != nullptr;
  instant.stamp = ahead_ != nullptr ? ahead_->stamp : 0;
  instant.line = ahead_ != nullptr ? ahead_->line : 0;
  instant.changes = 0;
  instant.is_empty = true;
  instant.text.clear();
  is_first_ = false;
  while ((ahead_ = reader_.next()) != nullptr) {
    const bool is_stamp = ahead_->kind == Entry::Kind::Stamp;
    if (is_stamp && !(instant.has_stamp && ahead_->stamp == instant.stamp)) break;
    take(instant, *ahead_);
  }
  if (reader_.cut()) return false;
  finish(instant);
  return true;
}

void InstantReader::take(Instant& instant, const Entry& entry) {
  switch (entry.kind) {
    case Entry::Kind::Stamp:
      return;
    case Entry::Kind::Change:
      return take_change(instant, entry);
    case Entry::Kind::Dump:
      end_dump(instant);
      is_in_dump_ = true;
      break;
    case Entry::Kind::DumpEnd:
      return end_dump(instant);
    case Entry::Kind::Section:
      break;
  }
  instant.is_empty = false;
  if (keeps_text_) write_line(instant.text, entry.section);
}

void InstantReader::take_change(Instant& instant, const Entry& entry) {
  if (advance_ && advance_->is(entry)) {
    advance_->update(reader_, entry);
    if (advance_->is_alone()) return;
  }
  instant.is_empty = false;
  ++instant.changes;
  if (!keeps_text_) return;
  instant.text.write(entry.value);
  if (is_vector(entry.value)) instant.text.write(' ');
  write_line(instant.text, entry.code_text);
}

void InstantReader::end_dump(Instant& instant) {
  if (std::exchange(is_in_dump_, false) && keeps_text_) write_line(instant.text, "$end");
}

void InstantReader::finish(Instant& instant) {
  end_dump(instant);
  instant.skipped = advance_ ? advance_->total() : 0;
  if (instant.stamp > std::numeric_limits<std::int64_t>::max() - instant.skipped) {
    reader_.fail(instant.line,
                 fmt::format("the true time of #{} is beyond 2^63 - 1, with {} of {}",
                             instant.stamp, kAdvanceTime, instant.skipped),
                 "a trace of such a length needs a coarser $timescale");
  }
  instant.time = instant.stamp + instant.skipped;
}

}  // namespace stride::trace
