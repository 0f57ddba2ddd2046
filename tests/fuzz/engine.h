// Feeds parsers with damaged seeds: the engine that needs no compiler of its own.
#ifndef STRIDE_TESTS_FUZZ_ENGINE_H
#define STRIDE_TESTS_FUZZ_ENGINE_H

#include <cstddef>
#include <string>
#include <vector>

#include "tests/fuzz/parser.h"

namespace stride::tests {

/// One input may take so much. Memory is that of the whole process, and is not limited where
/// AddressSanitizer needs its own.
inline constexpr unsigned kSecondsPerInput = 10;
inline constexpr std::size_t kMemory = std::size_t{1} << 30;

/// How a parser took an input.
enum class Answer { Accepted, Refused, Finding };

/// Calls the parser in this process; `what` becomes the text of the refusal or of the finding.
Answer read_once(const Parser& parser, const std::string& bytes, std::string& what);

struct Finding {
  std::string bytes;
  std::string what;
};

struct Tally {
  std::size_t accepted = 0;
  std::size_t refused = 0;
  std::vector<Finding> findings;  ///< kMostFindings at most, behind which nothing is tried
};

inline constexpr std::size_t kMostFindings = 10;

/// Calls the parser in processes of their own with its seeds and then with damaged ones, `inputs`
/// in all. The inputs depend on `seed` and their number only.
Tally run(const Parser& parser, std::size_t inputs, unsigned seed);

}  // namespace stride::tests

#endif
