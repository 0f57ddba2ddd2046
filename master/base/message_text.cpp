#include "master/base/message_text.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "master/base/text/readable_text.h"

namespace stride::core {
namespace {

constexpr std::string_view kLeastIndent = "  ";  // as that of hints
constexpr std::string_view kIndent = "    ";
constexpr std::size_t kMostMessageLines = 100;

/// Bytes up to which a text stays as it is, and of a longer one those that are shown.
struct Limit {
  std::size_t most, head, tail;
};
constexpr Limit kWord{400, 240, 80};  // paths are seldom longer
constexpr Limit kLine{2000, 1500, 300};

std::string shortened(std::string_view text, const Limit& limit) {
  if (text.size() <= limit.most) return std::string(text);
  std::size_t head = limit.head;
  std::size_t tail = text.size() - limit.tail;
  while (head > 0 && is_within_character(text[head])) --head;
  while (tail < text.size() && is_within_character(text[tail])) ++tail;
  return fmt::format("{}… ({} more characters) …{}", text.substr(0, head),
                     character_count(text.substr(head, tail - head)), text.substr(tail));
}

std::string shortened_line(std::string_view line) {
  std::string text;
  while (true) {
    const std::size_t end = std::min(line.find(' '), line.size());
    text += shortened(line.substr(0, end), kWord);
    if (end == line.size()) return shortened(text, kLine);
    text += ' ';
    line.remove_prefix(end + 1);
  }
}

std::string escaped(std::string_view text, char character, std::string_view replacement) {
  std::string safe;
  for (const char c : text) {
    if (c == character) {
      safe += replacement;
    } else {
      safe += c;
    }
  }
  return safe;
}

std::vector<std::string> lines_of(std::string_view message) {
  std::vector<std::string> lines;
  while (true) {
    const std::size_t end = std::min(message.find('\n'), message.size());
    const std::string_view line = message.substr(0, end);
    const bool is_indented = lines.empty() || line.empty() || line.starts_with(kLeastIndent);
    lines.push_back(std::string(is_indented ? "" : kIndent) + escaped(line, '\0', "\\x00"));
    if (end == message.size()) return lines;
    message.remove_prefix(end + 1);
  }
}

std::string joined_lines(const std::vector<std::string>& lines) {
  std::string text = lines.front();
  for (std::size_t i = 1; i < lines.size(); ++i) text += '\n' + lines[i];
  return text;
}

}  // namespace

std::string log_text(std::string_view message) { return joined_lines(lines_of(message)); }

std::string message_text(std::string_view message) {
  std::vector<std::string> lines = lines_of(message);
  if (lines.size() > kMostMessageLines + 1) {
    const std::string rest = fmt::format("  … and {} more lines", lines.size() - kMostMessageLines);
    lines.resize(kMostMessageLines);
    lines.push_back(rest);
  }
  for (std::string& line : lines) line = shortened_line(line);
  return joined_lines(lines);
}

std::string name_text(std::string_view name) {
  return escaped(escaped(name, '\n', "\\x0a"), '\0', "\\x00");
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

}  // namespace stride::core
