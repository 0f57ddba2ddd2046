#ifndef STRIDE_MASTER_LOADER_PROCESS_OUTPUT_TAIL_H
#define STRIDE_MASTER_LOADER_PROCESS_OUTPUT_TAIL_H

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

namespace stride::isolation {

/// The last lines that a unit has logged or printed, for the error that reports its end.
class OutputTail {
 public:
  static constexpr std::size_t kMost = 8;
  static constexpr std::size_t kLongest = 200;  ///< of a line; what is behind is cut off

  void add_logged(std::string_view line) { add("logged", line); }
  void add_printed(std::string_view line) { add("printed", line); }

  /// "\n  it logged: LINE\n  it printed: LINE", in the order in which they came.
  std::string text() const;

 private:
  void add(const char* how, std::string_view line);

  std::deque<std::string> lines_;
};

/// Splits what a unit has printed into lines.
class PrintedLines {
 public:
  /// To be filled with bytes as they come.
  std::string& bytes() { return bytes_; }
  /// Calls take(line) for each line that is complete.
  template <class Take>
  void take(Take&& take) {
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = bytes_.find('\n', begin)) != std::string::npos;
         begin = end + 1) {
      take(std::string_view(bytes_).substr(begin, end - begin));
    }
    bytes_.erase(0, begin);
    if (bytes_.size() > kLongest) take_rest(take);
  }
  /// Likewise for what has no end.
  template <class Take>
  void take_rest(Take&& take) {
    if (!bytes_.empty()) take(std::string_view(bytes_));
    bytes_.clear();
  }

 private:
  static constexpr std::size_t kLongest = std::size_t{1} << 16;

  std::string bytes_;
};

}  // namespace stride::isolation

#endif
