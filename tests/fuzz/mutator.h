// Seeded damage to texts and files, for the tests that feed parsers with it.
#ifndef STRIDE_TESTS_FUZZ_MUTATOR_H
#define STRIDE_TESTS_FUZZ_MUTATOR_H

#include <algorithm>
#include <random>
#include <string>
#include <utility>

namespace stride::tests {

class Mutator {
 public:
  /// `alphabet` holds the characters that mean something to the parser.
  explicit Mutator(unsigned seed, std::string alphabet = "<>&\"'/=:.%-0 \n")
      : random_(seed), alphabet_(std::move(alphabet)) {}

  /// The text with one to four changes: cut off, a byte replaced, a part removed, doubled or
  /// swapped, a character of the alphabet put in.
  std::string mutate(std::string text) {
    for (std::size_t left = 1 + below(4); left > 0 && !text.empty(); --left) mutate_once(text);
    return text;
  }

 private:
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
