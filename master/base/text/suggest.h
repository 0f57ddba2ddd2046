#ifndef STRIDE_MASTER_BASE_TEXT_SUGGEST_H
#define STRIDE_MASTER_BASE_TEXT_SUGGEST_H

#include <span>
#include <string>

namespace stride::core {

/// The candidate that differs by case only, else the one with the smallest edit distance
/// (Levenshtein), or an empty text if none is near enough to be what was meant.
std::string nearest(const std::string& word, std::span<const std::string> candidates);

/// "did you mean 'x'?", or else "known are: a, b, c" (shortened where there are many).
std::string suggestion(const std::string& word, std::span<const std::string> candidates);

}  // namespace stride::core

#endif
