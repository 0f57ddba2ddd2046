// Seeded damage to texts and files, for the tests that feed parsers with it.
#ifndef STRIDE_TESTS_FUZZ_MUTATOR_H
#define STRIDE_TESTS_FUZZ_MUTATOR_H

#include <algorithm>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stride::tests {

class Mutator {
 public:
  /// `alphabet` holds the characters that mean something to the parser.
  explicit Mutator(unsigned seed, std::string alphabet = "<>&\"'/=:.%-0 \n")
      : random_(seed), alphabet_(std::move(alphabet)) {}

  /// The text in which another value is between two quotes: one that is elsewhere in it, or an
  /// unusual one; so what is well-formed stays it. As mutate() where nothing is quoted.
  std::string replace_quoted(const std::string& text) {
    const std::vector<std::string_view> values = quoted(text);
    if (values.empty()) return mutate(text);
    const std::string_view replaced = values[below(values.size())];
    const auto& unusual = kUnusual[below(std::size(kUnusual))];
    const std::string_view value = below(2) == 0 ? unusual : values[below(values.size())];
    const std::size_t at = replaced.data() - text.data();
    return text.substr(0, at) + std::string(value) + text.substr(at + replaced.size());
  }

  /// The text with one to four changes: cut off, a byte replaced, a part removed, doubled or
  /// swapped, a character of the alphabet put in.
  std::string mutate(std::string text) {
    for (std::size_t left = 1 + below(4); left > 0 && !text.empty(); --left) mutate_once(text);
    return text;
  }

 private:
  /// None leads to a folder of the machine's.
  static constexpr std::string_view kUnusual[] = {
      "",    "0",    "-1",     "1e400",   "1e-400", "nan",  "18446744073709551616",
      "inf", "true", "../no/", "file:no", "*",      "%00",  "-9223372036854775809",
      " ",   "#",    "1e18",   "0x10",    "a.b.c",  "2 3 4"};

  /// What is between pairs of quotes.
  static std::vector<std::string_view> quoted(std::string_view text) {
    std::vector<std::string_view> values;
    for (std::size_t end = 0;; ++end) {
      const std::size_t begin = text.find('"', end);
      if (begin == text.npos) return values;
      end = text.find('"', begin + 1);
      if (end == text.npos) return values;
      values.push_back(text.substr(begin + 1, end - begin - 1));
    }
  }

  std::size_t below(std::size_t limit) { return random_() % limit; }

  void mutate_once(std::string& text) {
    const std::size_t at = below(text.size());
    const std::size_t length = std::min(below(40), text.size() - at);
    switch (below(6)) {
      case 0:
        text.resize(at);
        return;
      case 1:
        text[at] = static_cast<char>(below(256));
        return;
      case 2:
        text.erase(at, length);
        return;
      case 3:
        text.insert(below(text.size()), text.substr(at, length));
        return;
      case 4:
        text.insert(at, 1, alphabet_[below(alphabet_.size())]);
        return;
      default:
        std::swap(text[at], text[below(text.size())]);
    }
  }

  std::mt19937 random_;
  std::string alphabet_;
};

}  // namespace stride::tests

#endif
