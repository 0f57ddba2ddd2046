#include "master/cli/table.h"

#include <algorithm>

#include <fmt/format.h>

namespace stride::cli {
namespace {

/// Characters, not bytes: the continuation bytes of UTF-8 do not count.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string pad(const std::string& text, std::size_t to, Table::Align align) {
  const std::string blanks(to - std::min(to, width(text)), ' ');
  return align == Table::Align::Left ? text + blanks : blanks + text;
}

std::string repeat(const std::string& text, std::size_t count) {
  std::string line;
  for (std::size_t i = 0; i < count; ++i) line += text;
  return line;
}

}  // namespace

std::string Table::text() const {
  std::vector<std::size_t> widths;
  for (const Column& column : columns_) widths.push_back(width(column.title));
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  }
  const auto line = [&](auto&& cell) {
    std::string text = " ";
    for (std::size_t i = 0; i < columns_.size(); ++i) text += " " + cell(i) + " ";
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
  };
  std::string text =
      line([&](std::size_t i) { return pad(columns_[i].title, widths[i], columns_[i].align); });
  text += line([&](std::size_t i) { return repeat("─", widths[i]); });
  for (const auto& row : rows_) {
    text += line([&](std::size_t i) { return pad(row[i], widths[i], columns_[i].align); });
  }
  return text;
}

}  // namespace stride::cli
