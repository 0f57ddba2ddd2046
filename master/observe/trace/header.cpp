#include "master/observe/trace/header.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace stride::trace {
namespace {

std::uint64_t key_of(std::string_view code) {
  std::uint64_t key = 0;
  std::memcpy(&key, code.data(), code.size());
  return key;
}

bool is_declaration(std::string_view word) {
  return word == "$var" || word == "$scope" || word == "$upscope" || word == "$enddefinitions";
}

/// A code is of printable characters, so that it cannot be mistaken.
bool is_code(std::string_view word) {
  return std::all_of(word.begin(), word.end(), [](char c) { return c > ' ' && c < 127; });
}

class HeaderReader {
 public:
  explicit HeaderReader(Words& words) : words_(words) {}

  Header read() {
    words_.record_into(&header_.text);
    while (read_section()) continue;
    words_.record_into(nullptr);
    if (!has_timescale_) {
      fail("there is no $timescale",
           "put '$timescale 1 ns $end', or what the unit of the time stamps is, before "
           "$enddefinitions");
    }
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const {
    words_.fail(words_.line(), message, hint);
  }

  /// The position of the last word in the text.
  Span span_of(std::string_view word) const {
    return {header_.text.size() - word.size(), header_.text.size()};
  }

  /// False behind $enddefinitions.
  bool read_section() {
    const std::string_view keyword = words_.next();
    line_ = words_.line();
    if (keyword.empty() || words_.is_at_end()) {
      fail("the file ends before $enddefinitions, so it was cut off or is not a value change dump");
    }
    if (keyword.front() != '$' || keyword == "$end") {
      fail(fmt::format("'{}' is where a section such as $timescale, $scope or $var is expected",
                       Words::shown(keyword)),
           header_.text.size() == keyword.size()
               ? "expected a value change dump (.vcd); gunzip a compressed file, and turn an FST "
                 "file into one with fst2vcd"
               : "");
    }
    begin_ = span_of(keyword).begin;
    section_ = keyword;
    read_words();
    if (section_ == "$timescale") add_timescale();
    if (section_ == "$scope") open_scope();
    if (section_ == "$upscope" && depth_-- == 0) fail("$upscope closes no scope");
    if (section_ == "$var") add_variable();
    if (section_ != "$enddefinitions") return true;
    header_.end_definitions = begin_;
    return false;
  }

  void read_words() {
    parts_.clear();
    while (true) {
      const std::string_view word = words_.next();
      if (word == "$end") return;
      if (word.empty()) {
        fail(
            fmt::format("the file ends within the {} of line {}; it was cut off", section_, line_));
      }
      // the code of a $var may be any word
      const bool is_free = section_ == "$comment" || (section_ == "$var" && parts_.size() == 2);
      if (!is_free && is_declaration(word)) {
        fail(fmt::format("the {} of line {} has no $end before '{}'", section_, line_,
                         Words::shown(word)));
      }
      if (header_.text.size() - begin_ > Words::kLongest) {
        fail(fmt::format("the {} of line {} has no $end", section_, line_));
      }
      // only these are looked at
      if (parts_.size() < kParts) parts_.push_back(span_of(word));
    }
  }

  void add_timescale() {
    if (has_timescale_) fail("there is a second $timescale");
    has_timescale_ = true;
    const Span inside = parts_.empty() ? Span{} : Span{parts_.front().begin, parts_.back().end};
    try {
      header_.timescale = Timescale::parse(header_.at(inside));
    } catch (const std::invalid_argument& error) {
      words_.fail(line_, error.what());
    }
  }

  void open_scope() {
    if (depth_++ == 0 && header_.first_scope_end == 0) {
      header_.first_scope_end = header_.text.size();
    }
  }

  void add_variable() {
    if (parts_.size() < 4) {
      words_.fail(line_, fmt::format("a $var has a type, a width, a code and a name, this one has "
                                     "only {} of them",
                                     parts_.size()));
    }
    const std::string_view width = header_.at(parts_[1]);
    const std::string_view code = header_.at(parts_[2]);
    Declaration made;
    const auto read = std::from_chars(width.data(), width.data() + width.size(), made.width);
    if (read.ec != std::errc{} || read.ptr != width.data() + width.size()) {
      words_.fail(line_, fmt::format("'{}' is not a width in bits", Words::shown(width)));
    }
    if (!is_code(code)) {
      words_.fail(line_,
                  fmt::format("'{}' is not an identifier code; expected printable characters",
                              Words::shown(code)));
    }
    made.code = header_.codes.add(code);
    made.line = line_;
    made.section = {begin_, header_.text.size()};
    made.type = parts_[0];
    made.name = parts_[3];
    // a range may be at the name, or behind a blank
    const std::string_view name = header_.at(made.name);
    const std::size_t range = name.find('[', 1);
    if (range != std::string_view::npos) made.name.end = made.name.begin + range;
    header_.declarations.push_back(made);
  }

  static constexpr std::size_t kParts = 4;

  Words& words_;
  Header header_;
  bool has_timescale_ = false;
  int depth_ = 0;
  // of the section that is being read
  std::string section_;
  std::int64_t line_ = 0;
  std::size_t begin_ = 0;
  std::vector<Span> parts_;
};

}  // namespace

/// Where the key is, or would be.
std::size_t CodeTable::slot_of(std::uint64_t key) const {
  constexpr std::uint64_t kFibonacci = 0x9e3779b97f4a7c15;
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = static_cast<std::size_t>((key * kFibonacci) >> 32) & mask;
  while (slots_[at].key != 0 && slots_[at].key != key) at = (at + 1) & mask;
  return at;
}

void CodeTable::grow() {
  std::vector<Slot> smaller(slots_.size() * 2);
  smaller.swap(slots_);
  for (const Slot& slot : smaller) {
    if (slot.key != 0) slots_[slot_of(slot.key)] = slot;
  }
}

std::uint32_t CodeTable::add(std::string_view code) {
  if (const auto known = find(code)) return *known;
  if (code.size() > sizeof(std::uint64_t)) {
    long_codes_.emplace(code, size_);
    return size_++;
  }
  if (2 * (std::size_t{size_} + 1) > slots_.size()) grow();
  slots_[slot_of(key_of(code))] = {key_of(code), size_};
  return size_++;
}

std::optional<std::uint32_t> CodeTable::find(std::string_view code) const {
  if (code.size() > sizeof(std::uint64_t)) {
    const auto found = long_codes_.find(std::string(code));
    if (found == long_codes_.end()) return std::nullopt;
    return found->second;
  }
  const Slot& slot = slots_[slot_of(key_of(code))];
  if (slot.key == 0 || code.empty()) return std::nullopt;
  return slot.number;
}

Header read_header(Words& words) { return HeaderReader(words).read(); }

}  // namespace stride::trace
