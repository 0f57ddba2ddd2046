#include "master/front/cli/terminal/table.h"

#include <algorithm>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "master/base/text/readable_text.h"

namespace stride::cli {
namespace {

std::string pad(const std::string& text, std::size_t to, Table::Align align) {
  const std::string blanks(to - std::min(to, core::character_count(text)), ' ');
  return align == Table::Align::Left ? text + blanks : blanks + text;
}

std::string repeat(const std::string& text, std::size_t count) {
  std::string line;
  for (std::size_t i = 0; i < count; ++i) line += text;
  return line;
}

}  // namespace

std::size_t output_width() {
  constexpr std::size_t kElsewhere = 120;
  winsize size{};
  const bool is_terminal = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_terminal ? size.ws_col : kElsewhere;
}

std::vector<std::size_t> Table::widths(std::size_t most) const {
  constexpr std::size_t kBetween = 2;
  std::vector<std::size_t> widths;
  for (const Column& column : columns_) widths.push_back(core::character_count(column.title));
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], core::character_count(row[i]));
  }
  std::size_t whole = 0;
  for (const std::size_t column : widths) whole += kBetween + column;
  for (std::size_t i = 0; i < widths.size() && whole > most; ++i) {
    if (!columns_[i].is_cut) continue;
    const std::size_t room = widths[i] - std::min(widths[i], whole - most);
    const std::size_t kept = std::max(room, core::character_count(columns_[i].title));
    whole -= widths[i] - kept;
    widths[i] = kept;
  }
  return widths;
}

std::string Table::text(std::size_t most) const {
  const std::vector<std::size_t> widths = this->widths(most);
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
    text += line([&](std::size_t i) {
      return pad(core::readable_text(row[i], widths[i]), widths[i], columns_[i].align);
    });
  }
  return text;
}

}  // namespace stride::cli
