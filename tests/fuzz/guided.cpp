// The entry of libFuzzer, which looks for inputs by what they reach in the code. The environment
// variable STRIDE_FUZZ_PARSER names the parser.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include <spdlog/spdlog.h>

#include "tests/fuzz/engine.h"
#include "tests/fuzz/working_folder.h"

using namespace stride::tests;

namespace {

const Parser& chosen_parser() {
  const char* const name = std::getenv("STRIDE_FUZZ_PARSER");
  return find_parser(name == nullptr ? "" : name);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const WorkingFolder folder;
  static const Parser& parser = chosen_parser();
  static const bool is_silent = (spdlog::set_level(spdlog::level::off), true);
  (void)is_silent;
  std::string what;
  const std::string input(reinterpret_cast<const char*>(bytes), size);
  if (read_once(parser, input, what) != Answer::Finding) return 0;
  std::cerr << parser.name << ": finding: " << what << std::endl;
  std::abort();
}
