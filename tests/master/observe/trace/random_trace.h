// Traces of all kinds, from a seed.
#ifndef STRIDE_TESTS_MASTER_OBSERVE_TRACE_RANDOM_TRACE_H
#define STRIDE_TESTS_MASTER_OBSERVE_TRACE_RANDOM_TRACE_H

#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace stride::trace {

/// A value change dump without advanceTime.
class RandomTrace {
 public:
  explicit RandomTrace(unsigned seed) : random_(seed) {
    declare();
    change();
  }

  /// As the writer writes it: an entry a line, no stamp twice, none without changes but the last.
  std::string text() const { return header_ + tidy_; }
  /// The same with other blanks, and with stamps that say nothing.
  std::string untidy_text() const { return header_ + untidy_; }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }
  bool happens(std::size_t one_in) { return below(one_in) == 0; }

  std::string code_of(std::size_t number) {
    std::string code;
    for (++number; number > 0; number = (number - 1) / 94) {
      code += static_cast<char>('!' + (number - 1) % 94);
    }
    return happens(10) ? code + "_a_long_code" : code;
  }

  void declare() {
    const char* const units[] = {"fs", "ps", "ns", "us", "ms", "s"};
    const char* const numbers[] = {"1", "10", "100"};
    header_ = "$version none $end\n$timescale " + std::string(numbers[below(3)]) + " " +
              units[below(6)] + " $end\n";
    const std::size_t count = 1 + below(200);
    std::size_t depth = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (happens(5)) {
        header_ += "$scope module s" + std::to_string(i) + " $end\n";
        ++depth;
      }
      if (depth > 0 && happens(6)) {
        header_ += "$upscope $end\n";
        --depth;
      }
      declare_variable(i);
    }
    for (; depth > 0; --depth) header_ += "$upscope $end\n";
    header_ += "$enddefinitions $end\n";
  }

  void declare_variable(std::size_t i) {
    const char* const types[] = {"wire 1",   "wire 9",  "real 64",
                                 "string 1", "event 1", "integer 32"};
    const std::size_t type = below(6);
    const bool is_alias = !variables_.empty() && happens(8);
    variables_.push_back(is_alias ? variables_[below(variables_.size())]
                                  : std::make_pair(type, code_of(i)));
    header_ += "$var " + std::string(types[variables_.back().first]) + " " +
               variables_.back().second + " v" + std::to_string(i) + " $end\n";
  }

  std::string digits(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += happens(9) ? "xzXZ"[below(4)] : "01"[below(2)];
    return text;
  }

  std::pair<std::string, std::string> random_change() {
    const auto& [type, code] = variables_[below(variables_.size())];
    switch (type) {
      case 0:
        return {digits(1) + code, ""};
      case 2:
        return {"r" + std::to_string(below(1000)) + "e-3", code};
      case 3:
        return {happens(4) ? "s" : "sa\\040text" + std::to_string(below(10)), code};
      case 4:
        return {"1" + code, ""};
      default:
        return {"b" + digits(1 + below(12)), code};
    }
  }

  std::string blank() {
    const char* const blanks[] = {"\n", " ", "\t", "\r\n", "\n\n  "};
    return blanks[below(5)];
  }

  void add(const std::string& entry) {
    tidy_ += entry + "\n";
    untidy_ += entry + blank();
  }

  void add_changes(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto [value, code] = random_change();
      tidy_ += value + (code.empty() ? "" : " " + code) + "\n";
      untidy_ += value + (code.empty() ? "" : blank() + code) + blank();
    }
  }

  void add_section(const std::string& keyword) {
    add(keyword);
    add_changes(1 + below(5));
    add("$end");
  }

  void add_stamp(std::uint64_t time) {
    tidy_ += "#" + std::to_string(time) + "\n";
    untidy_ += (happens(3) ? "#0" : "#") + std::to_string(time) + blank();
  }

  /// From a few ticks to a good part of all time.
  std::uint64_t step() { return 1 + (random_() >> (8 + below(56))); }

  void change() {
    if (happens(2)) add("$comment All initial values\nare below $end");
    if (happens(2)) add_section("$dumpvars");
    std::uint64_t time = happens(2) ? 0 : step();
    const std::size_t instants = below(100);
    for (std::size_t i = 0; i < instants; ++i) {
      if (i > 0 && happens(4)) untidy_ += "#" + std::to_string(time - 1) + "\n";
      add_stamp(time);
      add_changes(1 + below(6));
      if (happens(20)) add("$comment at " + std::to_string(time) + " $end");
      if (happens(15)) add_section(std::string("$dump") + (happens(2) ? "off" : "on"));
      if (happens(6)) untidy_ += "#" + std::to_string(time) + " ";  // once more
      const std::uint64_t next = time + step();
      if (next > kMost) break;
      time = next;
    }
    if (happens(2)) add_stamp(time + (time < kMost ? 1 : 0));
    untidy_ += "\n";
  }

  static constexpr std::uint64_t kMost = 0x7fffffffffffffff;

  std::mt19937_64 random_;
  std::string header_;
  std::string tidy_;
  std::string untidy_;
  std::vector<std::pair<std::size_t, std::string>> variables_;  ///< type and code
};

}  // namespace stride::trace

#endif
