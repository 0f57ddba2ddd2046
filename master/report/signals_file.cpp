#include "master/report/signals_file.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/report/thinning.h"

namespace stride::report {
namespace {

Column deduced_column(const std::string& heading) {
  const std::size_t at = heading.rfind(" [");
  if (at == std::string::npos || !heading.ends_with(']')) return Column(heading, "");
  return Column(heading.substr(0, at), heading.substr(at + 2, heading.size() - at - 3));
}

/// At least as many as there are, the header left out; 0 where the file is so small that it does
/// not matter.
std::size_t count_rows(const std::filesystem::path& file, std::size_t limit) {
  constexpr std::size_t kLeastValue = 2;  // a digit and a comma
  std::error_code error;
  if (std::filesystem::file_size(file, error) < kLeastValue * limit || error) return 0;
  const core::Descriptor opened = core::open_input(file);
  std::vector<char> piece(std::size_t{1} << 16);
  std::size_t lines = 0;
  try {
    while (const std::size_t count = core::read_from(opened, piece.data(), piece.size())) {
      const auto end = piece.begin() + static_cast<std::ptrdiff_t>(count);
      lines += static_cast<std::size_t>(std::count(piece.begin(), end, '\n'));
    }
  } catch (const std::system_error&) {  // an error where the rows are read
  }
  return std::max<std::size_t>(lines, 1) - 1;
}

class SignalsReader {
 public:
  SignalsReader(const std::filesystem::path& file, std::span<const SignalInfo> infos,
                const SignalLimits& limits)
      : table_(file) {
    if (table_.columns().empty()) return;
    const std::span<const std::string> headings = table_.columns();
    if (headings[0] != "time") table_.fail(0, "expected the column 'time'");
    const std::size_t count = std::min(headings.size() - 1, limits.columns);
    signals_.columns = signal_columns(headings.subspan(1, count), infos);
    signals_.left_out = headings.size() - 1 - count;
    thinner_ = Thinner(count_rows(file, limits.values), count, limits.values);
    signals_.thinned = thinner_.block();
  }

  Signals read() {
    while (!table_.columns().empty() && table_.next()) take_row();
    thinner_.finish(signals_.times, signals_.columns);
    return std::move(signals_);
  }
  std::optional<std::size_t> cut() const { return table_.cut(); }

 private:
  void take_row() {
    const Time time = table_.time(0);
    std::vector<Time>& times = signals_.times;
    if (!times.empty() && time < times.back()) table_.fail(0, "the time goes back");
    if (!times.empty() && time == times.back()) {
      drop_last_row();
    } else {
      thinner_.make_room(times, signals_.columns);
    }
    append_fields(signals_.columns, table_);
    times.push_back(time);
  }

  void drop_last_row() {
    signals_.times.pop_back();
    for (Column& column : signals_.columns) column.keep(signals_.times.size(), {});
  }

  Table table_;
  Signals signals_;
  Thinner thinner_;
};

}  // namespace

std::vector<Column> signal_columns(std::span<const std::string> headings,
                                   std::span<const SignalInfo> infos) {
  std::map<std::string, const SignalInfo*> known;
  for (const SignalInfo& info : infos) known.emplace(core::with_unit(info.name, info.unit), &info);
  std::vector<Column> columns;
  for (const std::string& heading : headings) {
    const auto found = known.find(heading);
    columns.push_back(found == known.end() ? deduced_column(heading) : Column(*found->second));
  }
  return columns;
}

void append_fields(std::span<Column> columns, const Table& table) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    try {
      columns[i].append(table.field(i + 1));
    } catch (const std::invalid_argument& mistake) {
      table.fail(i + 1, mistake.what());
    }
  }
}

Signals read_signals(const std::filesystem::path& file, std::span<const SignalInfo> infos,
                     const SignalLimits& limits, Notes& notes) {
  SignalsReader reader(file, infos, limits);
  Signals signals = reader.read();
  notes.add_cut(file, reader.cut());
  if (signals.left_out > 0) {
    notes.add(file, fmt::format("the first {} signals are shown, {} are left out; record fewer to "
                                "choose which",
                                signals.columns.size(), signals.left_out));
  }
  if (signals.thinned) {
    notes.add(file, fmt::format("there are too many values to show them all; of each {} rows those "
                                "with a least or a greatest value are shown",
                                *signals.thinned));
  }
  return signals;
}

}  // namespace stride::report
