#include "master/report/message_rows.h"

#include <charconv>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

namespace stride::report {
namespace {

std::uint64_t index_of(const Table& table, std::size_t place) {
  const std::string_view text = table.field(place).text;
  std::uint64_t index = 0;
  const auto [at, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || at != text.data() + text.size()) {
    table.fail(place, fmt::format("expected an integer, found '{}'", text));
  }
  return index;
}

/// As EventRecorder writes it.
std::string direction_of(const Table& table, std::size_t place) {
  const std::string direction = table.field(place).value();
  if (direction == "sent" || direction == "received" || direction == "intervention") {
    return direction;
  }
  table.fail(place, fmt::format("expected sent, received or intervention, found '{}'", direction));
}

}  // namespace

MessageRows::MessageRows(const std::filesystem::path& file) : table_(file) {
  if (table_.columns().empty()) return;
  time_ = table_.place("time");
  index_ = table_.place("index");
  component_ = table_.place("component");
  variable_ = table_.place("variable");
  direction_ = table_.place("direction");
  payload_ = table_.place("payload");
  content_ = table_.find("content");
}

RecordedMessage MessageRows::message() const {
  return {table_.time(time_),
          index_of(table_, index_),
          table_.field(component_).value(),
          table_.field(variable_).value(),
          direction_of(table_, direction_),
          table_.field(payload_).value(),
          content_ ? table_.field(*content_).value() : std::string()};
}

}  // namespace stride::report
