#include "master/observe/coverage/message_point.h"

#include <algorithm>
#include <iterator>
#include <type_traits>

#include <fmt/format.h>

#include "master/base/text/readable_text.h"

namespace stride::coverage {
namespace {

constexpr std::size_t kLongestWord = 64;
constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kNothing = "(empty)";

bool is_plain(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c > ' ' && c < '\x7f'; });
}

}  // namespace

std::string_view first_word(std::string_view text, std::string& made) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == text.npos) return kNothing;
  text.remove_prefix(begin);
  text = text.substr(0, text.find_first_of(kBlanks));
  if (text.size() <= kLongestWord && is_plain(text)) return text;
  made = core::readable_text(text.substr(0, 4 * kLongestWord), kLongestWord);
  return made;
}

void MessagePoint::on_message(const core::Message& message) {
  switch (definition_.kind) {
    case Kind::Words:
      return visit(word(message), message.time);
    case Kind::Lengths:
      return add_length(message);
    case Kind::Sequences:
      return add_to_sequence(message);
    default:
      return add_gap(message.time);
  }
}

void MessagePoint::visit(std::string_view bin, Time time) {
  latest_ = tally_.find_or_add(bin);
  tally_.visit(latest_, time);
}

/// That of the content if there is one; the message's block is of one element.
std::string_view MessagePoint::word(const core::Message& message) {
  if (message.block == nullptr) return "tick";
  if (definition_.is_text && !message.content.empty()) return first_word(message.content, text_);
  const core::ValueBlock& block = *message.block;
  switch (block.type()) {
    case core::ValueType::String:
      return first_word(block.strings()[message.first], text_);
    case core::ValueType::Binary: {
      const core::Binary& bytes = block.binaries()[message.first];
      if (bytes.empty()) return kNothing;
      text_.clear();
      fmt::format_to(std::back_inserter(text_), "0x{:02x}", bytes[0]);
      return text_;
    }
    default:
      return number_word(block, message.first);
  }
}

std::string_view MessagePoint::number_word(const core::ValueBlock& block, std::size_t element) {
  text_.clear();
  core::visit(block, [&](auto values) {
    using T = std::remove_const_t<typename decltype(values)::element_type>;
    if constexpr (std::is_arithmetic_v<T>) {
      const T value = values[element];
      if constexpr (std::is_same_v<T, std::int64_t>) {
        const auto item = std::ranges::find(definition_.items, value,
                                            [](const auto& named) { return named.second; });
        if (item != definition_.items.end()) return text_.assign(item->first), void();
      }
      fmt::format_to(std::back_inserter(text_), "{}", value);
    }
  });
  return text_;
}

void MessagePoint::add_length(const core::Message& message) {
  const core::ValueBlock& block = *message.block;
  const std::size_t length = block.type() == core::ValueType::String
                                 ? block.strings()[message.first].size()
                                 : block.binaries()[message.first].size();
  visit(length_bin(length, definition_.greatest), message.time);
}

void MessagePoint::add_to_sequence(const core::Message& message) {
  const std::string_view now = word(message);
  if (has_previous_) {
    set_pair(pair_, previous_, now);
    visit(pair_, message.time);
  }
  has_previous_ = true;
  previous_.assign(now);
}

void MessagePoint::add_gap(Time time) {
  if (before_) {
    latest_ = gap_bin(time - *before_);
    tally_.visit(latest_, time);
  }
  before_ = time;
}

void MessagePoint::persist(core::StateArchive& state) {
  tally_.persist(state);
  persist_bin(state, latest_, tally_.bins().size());
  state.value(before_);
  state.value(has_previous_);
  state.value(previous_);
}

}  // namespace stride::coverage
