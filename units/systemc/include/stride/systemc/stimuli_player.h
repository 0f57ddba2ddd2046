// Plays captured stimuli (docs/stimuli.md) to a model of SystemC. Needs SystemC and C++17, and
// nothing else of stride: a testbench may take this file alone.
#ifndef STRIDE_SYSTEMC_STIMULI_PLAYER_H
#define STRIDE_SYSTEMC_STIMULI_PLAYER_H

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <systemc>
#include <type_traits>
#include <utility>
#include <vector>

namespace stride::systemc {

/// Drives the signals of a device, and hands messages to it, at the instants at which the device
/// got them in the run in which they were captured, and in the same order within an instant. To be
/// used by sc_main, which lets it run the simulation:
///
///     stride::systemc::StimuliPlayer player("stimuli.csv");
///     player.drive("level", device.level);
///     player.on_message("message.text", [&](const std::string& text) { device.take(text); });
///     player.run();
///
/// The instant 0 of the simulation is that at which the captured run began. An input that nothing
/// is called for is left out. All functions throw std::runtime_error: "FILE:LINE: message".
class StimuliPlayer {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// Reads the file, of version 1. One that is cut off or out of order is refused.
  explicit StimuliPlayer(std::string file);

  /// Writes each value of the input to the signal, its start value now: bool, a number, or
  /// std::string; an array is one by its elements, "name[2,1]" or "name[3]", counted from 1. Throws
  /// also if there is no such input, or a value is none of this type.
  template <class T>
  void drive(const std::string& input, sc_core::sc_signal_inout_if<T>& signal);

  /// Calls take(value) where the input, such as a message, gets a value, with a std::string, Bytes
  /// (Binary), bool or a number.
  template <class T>
  void on_message(const std::string& input, std::function<void(const T&)> take);
  template <class Take>
  void on_message(const std::string& input, Take&& take) {
    on_message(input, std::function(std::forward<Take>(take)));
  }
  /// Calls tick() where the triggered clock ticks.
  void on_tick(const std::string& clock, std::function<void()> tick);

  /// What was set before the run: names and values, as the file has them.
  const std::map<std::string, std::vector<std::string>>& settings() const { return settings_; }

  /// Where the captured run ended.
  const sc_core::sc_time& end() const { return end_; }

  /// Runs the simulation up to the end, or to an earlier instant, from where it is now. A model
  /// that pauses it is continued; one that stops it ends it.
  void run() { run(end_); }
  void run(const sc_core::sc_time& until);

 private:
  /// A change of an input.
  struct Row {
    sc_core::sc_time time;
    int event = -1;  ///< the event iteration; -1: before the step that begins there
    std::size_t input = 0;
    std::size_t value = 0;  ///< which one of its values
  };
  struct Value {
    std::vector<std::string> elements;
    int line = 0;
  };
  struct Input {
    std::string name;
    std::string type;
    std::vector<std::size_t> sizes;
    Value start;
    std::vector<Value> values;  ///< behind that
    std::vector<std::function<void(std::size_t)>> targets;
  };

  void parse(const std::string& text);
  void parse_entry(const std::vector<std::string>& fields);
  void parse_row(const std::vector<std::string>& fields);
  void add_input(const std::vector<std::string>& fields);
  sc_core::sc_time parse_time(const std::string& text);
  std::uint64_t picoseconds(const std::string& text) const;
  std::vector<std::string> take_line(std::string_view& rest);
  std::string take_field(std::string_view& rest);
  Input& find(const std::string& name);
  std::pair<Input*, std::size_t> find_element(const std::string& name);
  template <class T>
  T parse_value(const Input& input, const Value& value, std::size_t element) const;
  /// All that the input has behind its start value.
  template <class T>
  std::vector<T> parse_values(const Input& input, std::size_t element) const;
  void play(const Row& row);
  static void settle();
  [[noreturn]] void fail(int line, const std::string& message) const {
    throw std::runtime_error(file_ + ":" + std::to_string(line) + ": " + message);
  }

  std::string file_;
  int line_ = 0;
  std::map<std::string, std::vector<std::string>> settings_;
  std::vector<Input> inputs_;
  std::vector<Row> rows_;
  std::optional<std::uint64_t> start_;  ///< [ps]
  sc_core::sc_time end_;
  bool has_head_ = false, is_complete_ = false;
  std::size_t next_ = 0;  ///< row
};

// ---- Reading ----

inline StimuliPlayer::StimuliPlayer(std::string file) : file_(std::move(file)) {
  std::ifstream stream(file_, std::ios::binary);
  if (!stream) throw std::runtime_error(file_ + ": cannot read the file");
  parse({std::istreambuf_iterator<char>(stream), {}});
}

inline void StimuliPlayer::parse(const std::string& text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::string_view rest = text;
  if (rest.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    rest.remove_prefix(kByteOrderMark.size());
  }
  int next = 1;
  while (!rest.empty()) {
    line_ = next;
    const std::string_view before = rest;
    const std::vector<std::string> fields = take_line(rest);
    const std::string_view taken = before.substr(0, before.size() - rest.size());
    next += static_cast<int>(std::count(taken.begin(), taken.end(), '\n'));
    if (is_complete_) fail(line_, "there is a row behind the end mark");
    if (line_ == 1) {
      const bool is_known = fields.size() == 2 && fields[0] == "stride stimuli" && fields[1] == "1";
      if (!is_known) fail(1, "expected 'stride stimuli,1': this is no file of stimuli, version 1");
    } else if (has_head_) {
      parse_row(fields);
    } else {
      parse_entry(fields);
    }
  }
  if (!is_complete_) fail(line_, "the file has no end mark: it was cut off");
}

inline void StimuliPlayer::parse_entry(const std::vector<std::string>& fields) {
  if (fields[0] == "input") {
    add_input(fields);
  } else if (fields[0] == "set" && fields.size() > 2) {
    settings_[fields[1]] = {fields.begin() + 2, fields.end()};
  } else if (fields[0] == "time") {
    has_head_ = true;
  }
}

inline void StimuliPlayer::add_input(const std::vector<std::string>& fields) {
  constexpr std::size_t kName = 1, kType = 2, kSizes = 6, kStart = 7;
  if (fields.size() <= kSizes) fail(line_, "the line of an input is too short");
  Input input{fields[kName], fields[kType], {}, {{}, line_}, {}, {}};
  const std::string& sizes = fields[kSizes];
  for (const char* at = sizes.data(); at < sizes.data() + sizes.size(); ++at) {
    std::size_t size = 0;
    const auto [rest, error] = std::from_chars(at, sizes.data() + sizes.size(), size);
    if (error != std::errc()) fail(line_, "'" + sizes + "' are no sizes of an array");
    input.sizes.push_back(size);
    at = rest;
  }
  if (fields.size() > kStart) input.start.elements.assign(fields.begin() + kStart, fields.end());
  inputs_.push_back(std::move(input));
}

inline void StimuliPlayer::parse_row(const std::vector<std::string>& fields) {
  if (fields.size() < 4) fail(line_, "a row has four fields at least");
  const sc_core::sc_time time = parse_time(fields[0]);
  if (!rows_.empty() && time < rows_.back().time) fail(line_, "this is earlier than the row above");
  if (fields[1] == "step") return;
  if (fields[1] == "end") {
    end_ = time;
    is_complete_ = true;
    return;
  }
  Row row{time, -1, 0, 0};
  const std::string& event = fields[1];
  if (!event.empty()) {
    const auto [rest, error] =
        std::from_chars(event.data(), event.data() + event.size(), row.event);
    if (error != std::errc() || *rest != '\0') fail(line_, "'" + event + "' is no event iteration");
  }
  Input& input = find(fields[2]);
  row.input = static_cast<std::size_t>(&input - inputs_.data());
  row.value = input.values.size();
  input.values.push_back({{fields.begin() + 3, fields.end()}, line_});
  rows_.push_back(row);
}

/// Exact decimals of seconds.
inline std::uint64_t StimuliPlayer::picoseconds(const std::string& text) const {
  constexpr std::size_t kPlaces = 12;
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string digits = text.substr(0, point);
  std::string places = point < text.size() ? text.substr(point + 1) : "";
  const bool is_exact = places.size() <= kPlaces;
  places.resize(kPlaces, '0');
  digits += places;
  std::uint64_t count = 0;
  const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
  if (!is_exact || error != std::errc() || *rest != '\0' || point == 0) {
    fail(line_, "'" + text + "' is no time in seconds");
  }
  return count;
}

inline sc_core::sc_time StimuliPlayer::parse_time(const std::string& text) {
  const std::uint64_t time = picoseconds(text);
  if (!start_) start_ = time;
  if (time < *start_) fail(line_, "this is earlier than the first row");
  return sc_core::sc_time(static_cast<double>(time - *start_), sc_core::SC_PS);
}

/// RFC 4180: its fields, of which one in quotation marks may hold line feeds.
inline std::vector<std::string> StimuliPlayer::take_line(std::string_view& rest) {
  std::vector<std::string> fields;
  for (;;) {
    fields.push_back(take_field(rest));
    if (rest.substr(0, 2) == "\r\n") rest.remove_prefix(1);
    const bool is_comma = !rest.empty() && rest.front() == ',';
    const bool is_end = !rest.empty() && rest.front() == '\n';
    if (!is_comma && !is_end) fail(line_, "a field does not end with a comma or the line");
    rest.remove_prefix(1);
    if (is_end) return fields;
  }
}

inline std::string StimuliPlayer::take_field(std::string_view& rest) {
  if (rest.empty() || rest.front() != '"') {
    std::size_t end = std::min(rest.find_first_of(",\n"), rest.size());
    if (rest.substr(end, 1) == "\n" && end > 0 && rest[end - 1] == '\r') --end;
    const std::string field(rest.substr(0, end));
    rest.remove_prefix(end);
    return field;
  }
  std::string field;
  for (;;) {
    const std::size_t end = rest.find('"', 1);
    if (end == std::string_view::npos) fail(line_, "the file is cut off within a quoted text");
    field += rest.substr(1, end - 1);
    rest.remove_prefix(end + 1);
    if (rest.empty() || rest.front() != '"') return field;
    field += '"';
  }
}

inline StimuliPlayer::Input& StimuliPlayer::find(const std::string& name) {
  for (Input& input : inputs_) {
    if (input.name == name) return input;
  }
  fail(line_, "there is no input '" + name + "'");
}

// ---- Values ----

/// "name[2,1]" and the place of that element, as they follow each other; "name" and the first one.
inline std::pair<StimuliPlayer::Input*, std::size_t> StimuliPlayer::find_element(
    const std::string& name) {
  for (Input& input : inputs_) {
    if (input.name == name && input.sizes.empty()) return {&input, 0};
    const std::size_t length = input.name.size();
    const bool is_element =
        name.compare(0, length + 1, input.name + "[") == 0 && name.back() == ']';
    if (!is_element || input.sizes.empty()) continue;
    std::size_t place = 0;
    const char* at = name.data() + length;
    for (const std::size_t size : input.sizes) {
      std::size_t index = 0;
      const bool is_begun = *at == '[' || *at == ',';
      const auto [rest, error] = std::from_chars(at + 1, name.data() + name.size(), index);
      if (!is_begun || error != std::errc() || index < 1 || index > size) {
        fail(input.start.line, "there is no element '" + name + "'");
      }
      place = place * size + index - 1;
      at = rest;
    }
    if (*at == ']') return {&input, place};
  }
  throw std::runtime_error(file_ + ": there is no input '" + name + "'");
}

template <class T>
T StimuliPlayer::parse_value(const Input& input, const Value& value, std::size_t element) const {
  const std::string text = element < value.elements.size() ? value.elements[element] : "";
  const char* const end = text.data() + text.size();
  const auto refuse = [&] {
    fail(value.line,
         "'" + text + "' is no value of '" + input.name + "' for a signal of this type");
  };
  T read{};
  if constexpr (std::is_same_v<T, std::string>) {
    read = text;
  } else if constexpr (std::is_same_v<T, bool>) {
    if (text != "true" && text != "false") refuse();
    read = text == "true";
  } else if constexpr (std::is_same_v<T, Bytes>) {
    for (const char* at = text.data(); at < end; at += 2) {
      std::uint8_t byte = 0;
      const auto [rest, error] = std::from_chars(at, std::min(at + 2, end), byte, 16);
      if (error != std::errc() || rest != at + 2) refuse();
      read.push_back(byte);
    }
  } else {
    static_assert(std::is_arithmetic_v<T>, "bool, a number, std::string or Bytes");
    const auto [rest, error] = std::from_chars(text.data(), end, read);
    if (error != std::errc() || rest != end) refuse();
  }
  return read;
}

template <class T>
std::vector<T> StimuliPlayer::parse_values(const Input& input, std::size_t element) const {
  std::vector<T> values;
  for (const Value& value : input.values) values.push_back(parse_value<T>(input, value, element));
  return values;
}

template <class T>
void StimuliPlayer::drive(const std::string& name, sc_core::sc_signal_inout_if<T>& signal) {
  const auto [input, element] = find_element(name);
  std::vector<T> values = parse_values<T>(*input, element);
  signal.write(parse_value<T>(*input, input->start, element));
  input->targets.push_back(
      [&signal, values = std::move(values)](std::size_t value) { signal.write(values[value]); });
}

template <class T>
void StimuliPlayer::on_message(const std::string& name, std::function<void(const T&)> take) {
  const auto [input, element] = find_element(name);
  input->targets.push_back([take = std::move(take), values = parse_values<T>(*input, element)](
                               std::size_t value) { take(values[value]); });
}

inline void StimuliPlayer::on_tick(const std::string& clock, std::function<void()> tick) {
  Input& input = *find_element(clock).first;
  if (input.type != "Clock") fail(input.start.line, "'" + clock + "' is no clock");
  input.targets.push_back([tick = std::move(tick)](std::size_t) { tick(); });
}

// ---- Playing ----

inline void StimuliPlayer::run(const sc_core::sc_time& until) {
  const auto has_stopped = [] { return sc_core::sc_get_status() == sc_core::SC_STOPPED; };
  const auto advance = [&](const sc_core::sc_time& time) {
    settle();
    while (!has_stopped() && sc_core::sc_time_stamp() < time) {
      sc_core::sc_start(time - sc_core::sc_time_stamp());  // not what is due at its last instant
      settle();
    }
  };
  while (next_ < rows_.size() && rows_[next_].time <= until && !has_stopped()) {
    const Row& first = rows_[next_];
    advance(first.time);
    for (; next_ < rows_.size() && rows_[next_].time == first.time &&
           rows_[next_].event == first.event;
         ++next_) {
      play(rows_[next_]);
    }
  }
  advance(until);
}

inline void StimuliPlayer::play(const Row& row) {
  for (const auto& target : inputs_[row.input].targets) target(row.value);
}

inline void StimuliPlayer::settle() {
  while (sc_core::sc_get_status() != sc_core::SC_STOPPED &&
         (sc_core::sc_get_status() == sc_core::SC_ELABORATION ||
          sc_core::sc_pending_activity_at_current_time())) {
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
  }
}

}  // namespace stride::systemc

#endif
