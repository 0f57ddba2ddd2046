#include "master/study/compare/streams.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/report/message_rows.h"

namespace stride::compare {
namespace {

using Stream = Streams::Stream;
using Entries = std::vector<StreamEntry>;

void add(Streams& streams, const std::string& name, const std::string& variable,
         StreamEntry entry) {
  const auto [place, is_new] = streams.places.try_emplace(name, streams.streams.size());
  if (is_new) streams.streams.push_back({name, variable});
  streams.streams[place->second].entries.push_back(std::move(entry));
  streams.order.push_back(place->second);
}

bool are_equal(const StreamEntry& a, const StreamEntry& b, std::optional<Duration> tolerance) {
  if (!tolerance) return a == b;
  return std::chrono::abs(a.time - b.time) <= *tolerance && a.payload == b.payload &&
         a.content == b.content;
}

/// What tells it from the other one.
std::string text_of(const StreamEntry& entry, const StreamEntry& other) {
  if (entry.payload != other.payload || entry.content != other.content) {
    if (entry.content != other.content) return entry.content;
    return entry.payload;
  }
  if (entry.time != other.time) return fmt::format("at {} s", core::to_text(entry.time));
  return fmt::format("in iteration {}", entry.index);
}

std::optional<Difference> compare_entries(Kind kind, const std::string& name, const Entries& a,
                                          const Entries& b, std::optional<Duration> tolerance) {
  Difference difference{kind, name, {}, {}, {}, 0};
  const std::size_t common = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (are_equal(a[i], b[i], tolerance)) continue;
    if (++difference.count > 1) continue;
    difference.time = std::min(a[i].time, b[i].time);
    difference.a = text_of(a[i], b[i]);
    difference.b = text_of(b[i], a[i]);
  }
  if (a.size() != b.size() && difference.count == 0) {
    difference.time = a.size() > b.size() ? a[common].time : b[common].time;
    difference.a = fmt::format("{} in all", a.size());
    difference.b = fmt::format("{} in all", b.size());
  }
  difference.count += std::max(a.size(), b.size()) - common;
  if (difference.count == 0) return std::nullopt;
  return difference;
}

bool is_selected(const Streams& streams, const Stream& stream, const Selection& selection) {
  return streams.kind != Kind::Message || selection.has(stream.variable);
}

/// The streams that either has, in the order of their names.
std::map<std::string, std::pair<const Entries*, const Entries*>> pair_streams(
    const Streams& a, const Streams& b, const Selection& selection) {
  static const Entries kNone;
  std::map<std::string, std::pair<const Entries*, const Entries*>> pairs;
  for (const Stream& stream : a.streams) {
    if (is_selected(a, stream, selection)) pairs[stream.name] = {&stream.entries, &kNone};
  }
  for (const Stream& stream : b.streams) {
    if (!is_selected(b, stream, selection)) continue;
    pairs.try_emplace(stream.name, &kNone, &kNone).first->second.second = &stream.entries;
  }
  return pairs;
}

struct Row {
  const std::string* stream;
  Time time;
};

std::vector<Row> selected_rows(const Streams& streams, const Selection& selection) {
  std::vector<std::size_t> counts(streams.streams.size(), 0);
  std::vector<Row> rows;
  for (const std::size_t place : streams.order) {
    const Stream& stream = streams.streams[place];
    const StreamEntry& entry = stream.entries[counts[place]++];
    if (is_selected(streams, stream, selection)) rows.push_back({&stream.name, entry.time});
  }
  return rows;
}

/// Where all streams are equal: whether their rows alternate in another way.
std::optional<Difference> other_order(const Streams& a, const Streams& b,
                                      const Selection& selection, const std::string& file) {
  const std::vector<Row> rows_a = selected_rows(a, selection);
  const std::vector<Row> rows_b = selected_rows(b, selection);
  const auto [mine, other] = std::ranges::mismatch(
      rows_a, rows_b, [](const Row& x, const Row& y) { return *x.stream == *y.stream; });
  if (mine == rows_a.end() || other == rows_b.end()) return std::nullopt;
  return Difference{Kind::File, file, std::min(mine->time, other->time),
                    fmt::format("first {}", *mine->stream),
                    fmt::format("first {}", *other->stream)};
}

}  // namespace

Streams read_messages(const std::filesystem::path& file) {
  report::MessageRows rows(file);
  Streams streams{.kind = Kind::Message};
  rows.table().require_header();
  while (rows.table().next()) {
    report::RecordedMessage message = rows.message();
    const std::string variable = message.component + "." + message.variable;
    add(streams, variable + " " + message.direction, variable,
        {message.time, message.index, std::move(message.payload), std::move(message.content)});
  }
  streams.cut = rows.table().cut();
  return streams;
}

Streams read_events(const std::filesystem::path& file) {
  report::Table table(file);
  Streams streams{.kind = Kind::Event};
  table.require_header();
  const std::size_t time = table.place("time");
  const std::size_t component = table.place("component");
  const std::size_t kind = table.place("kind");
  while (table.next()) {
    const Time at = table.time(time);
    if (table.field(kind).text != "event") continue;
    const std::string name = table.field(component).value();
    add(streams, name, name, {.time = at});
  }
  streams.cut = table.cut();
  return streams;
}

Differences compare_streams(const Streams& a, const Streams& b,
                            std::optional<Duration> time_tolerance, const Selection& selection,
                            const std::string& file) {
  Differences differences;
  for (const auto& [name, entries] : pair_streams(a, b, selection)) {
    auto difference =
        compare_entries(a.kind, name, *entries.first, *entries.second, time_tolerance);
    if (difference) differences.push_back(*std::move(difference));
  }
  if (differences.empty() && !time_tolerance) {
    if (auto order = other_order(a, b, selection, file)) differences.push_back(*std::move(order));
  }
  return differences;
}

}  // namespace stride::compare
