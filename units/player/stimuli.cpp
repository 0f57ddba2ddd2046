#include "units/player/stimuli.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>
#include <stdexcept>

#include <stride/time_text.h>

#include "units/player/csv.h"
#include "units/player/table.h"
#include "units/xml/file.h"

namespace player {
namespace {

constexpr const char* kFormat = "stride stimuli";
constexpr const char* kVersion = "1";
constexpr std::size_t kByteOrderMark = 3;  ///< bytes that may come before it
constexpr std::size_t kMostElements = 1u << 20;

stride::Time parse_time(const std::string& text) {
  if (const auto time = stride::time_of_decimal(text)) return *time;
  throw std::invalid_argument("'" + text +
                              "' is not a time; expected seconds such as 14.200358702064");
}

class Reader {
 public:
  Reader(const std::string& text, const std::string& file) : rows_(text, file) {}

  Stimuli read() {
    read_head();
    while (next_row()) {
      if (!read_row()) continue;
      result_.begin = result_.start();
      return std::move(result_);
    }
    rows_.fail(
        "the file is cut off: its end mark is missing; capture again, or end it with a line "
        "such as " +
        time_text_ + ",end,,\"cut off\"");
  }

 private:
  using Row = std::vector<std::string>;

  bool next_row() { return rows_.next(); }
  const Row& row() const { return rows_.fields(); }

  void expect_fields(std::size_t count, const char* form) const {
    if (row().size() != count) {
      rows_.fail("the line has " + std::to_string(row().size()) + " fields, expected " + form);
    }
  }

  // ---- The head ----

  void read_head() {
    if (!next_row() || row()[0] != kFormat) {
      rows_.fail(std::string("expected '") + kFormat + "," + kVersion +
                 "', as stride run --capture writes it");
    }
    if (row().size() != 2 || row()[1] != kVersion) {
      rows_.fail("the version is '" + (row().size() > 1 ? row()[1] : "") + "', expected " +
                 kVersion + "; capture again with this version of stride");
    }
    while (true) {
      if (!next_row()) rows_.fail("the file is cut off within its head");
      if (row()[0] == "time") break;
      read_head_row();
    }
    expect_fields(4, "time,event,variable,value");
    for (std::size_t i = 0; i < result_.inputs.size(); ++i) find_clock(i);
  }

  void read_head_row() {
    const std::string& what = row()[0];
    if (what == "unit") return read_word(result_.unit);
    if (what == "component") return read_word(result_.component);
    if (what == "system") return read_word(result_.system);
    if (what == "input") return read_input();
    if (what == "item") return read_item();
    if (what == "set") return read_start_value();
    if (what == "skip" || what == "tolerance") return;  // human-readable, about the unit
    rows_.fail("'" + what +
               "' is not known here; expected unit, component, system, input, item, set, skip, "
               "tolerance or time");
  }

  void read_word(std::string& word) const {
    expect_fields(2, "two");
    word = row()[1];
  }

  void read_input() {
    if (row().size() < 7) expect_fields(7, "input,NAME,TYPE,VARIABILITY,UNIT,CLOCK,SIZES,START");
    Input input;
    input.name = row()[1];
    if (!places_.emplace(input.name, result_.inputs.size()).second) {
      rows_.fail("the input '" + input.name + "' is described twice");
    }
    checked([&] { input.type = type_named(row()[2]); });
    input.is_continuous = row()[3] == "continuous";
    input.unit = row()[4];
    clock_names_.push_back(row()[5]);
    read_sizes(input, row()[6]);
    input.values = values_of(input.type);
    if (input.type != Type::Clock) append(input, 7);
    result_.inputs.push_back(std::move(input));
  }

  void read_sizes(Input& input, const std::string& text) const {
    std::istringstream stream(text);
    for (std::string word; stream >> word;) {
      std::size_t size = 0;
      const char* const last = word.data() + word.size();
      const auto [end, mistake] = std::from_chars(word.data(), last, size);
      if (mistake != std::errc() || end != last || size == 0 || size > kMostElements / input.size) {
        rows_.fail("'" + text + "' are not sizes of an array; expected numbers such as '3 2'");
      }
      input.dimensions.push_back(size);
      input.size *= size;
    }
  }

  void read_item() {
    expect_fields(4, "item,INPUT,NAME,NUMBER");
    Input& input = known(row()[1]);
    if (input.type != Type::Enumeration) rows_.fail("'" + input.name + "' is not an Enumeration");
    Values number = values_of(Type::Enumeration);
    checked([&] { append_parsed(number, Type::Enumeration, row()[3]); });
    input.items.emplace_back(row()[2], std::get<std::vector<std::int64_t>>(number).front());
  }

  /// Of an input it is its value from the start on; parameters are for human readers.
  void read_start_value() {
    if (row().size() < 3) expect_fields(3, "set,VARIABLE,VALUE");
    const std::optional<std::size_t> place = find(row()[1]);
    if (!place || result_.inputs[*place].type == Type::Clock) return;
    Input& input = result_.inputs[*place];
    input.values = values_of(input.type);
    append(input, 2);
  }

  void find_clock(std::size_t i) {
    const std::string& clock = clock_names_[i];
    if (clock.empty()) return;
    Input& input = result_.inputs[i];
    input.clock = find(clock);
    if (input.clock && result_.inputs[*input.clock].type == Type::Clock) return;
    rows_.fail("the head has no clock '" + clock + "', which the input '" + input.name +
               "' belongs to");
  }

  // ---- The rows ----

  /// Whether it is the last one.
  bool read_row() {
    if (row().size() < 4) expect_fields(4, "time,event,variable,value");
    Entry entry;
    checked([&] { entry.time = parse_time(row()[0]); });
    check_order(entry.time);
    const std::string& event = row()[1];
    if (event == "end") {
      read_end();
    } else if (event == "step") {
      read_step(entry);
    } else {
      read_value(entry);
    }
    result_.entries.push_back(entry);
    time_text_ = row()[0];
    return entry.kind == Entry::Kind::End;
  }

  /// The time goes on by steps only, and no further than they lead.
  void check_order(stride::Time time) const {
    if (result_.entries.empty()) return;
    const Entry& last = result_.entries.back();
    if (time < last.time) {
      rows_.fail("out of order: the time " + row()[0] + " s is before the " + time_text_ +
                 " s of the line above");
    }
    if (last.kind != Entry::Kind::Step && time != last.time) {
      rows_.fail("out of order: no step leads from " + time_text_ +
                 " s, the time of the line above, "
                 "to " +
                 row()[0] + " s");
    }
    if (last.kind == Entry::Kind::Step && time > last.target) {
      rows_.fail("out of order: the time " + row()[0] +
                 " s is behind the end of the step in the line above");
    }
  }

  void read_step(Entry& entry) const {
    expect_fields(4, "TIME,step,,END");
    entry.kind = Entry::Kind::Step;
    checked([&] { entry.target = parse_time(row()[3]); });
    if (entry.target < entry.time) rows_.fail("the step ends before it begins");
  }

  void read_value(Entry& entry) {
    read_event(entry);
    Input& input = known(row()[2]);
    entry.input = static_cast<std::size_t>(&input - result_.inputs.data());
    if (input.type == Type::Clock) {
      expect_fields(4, "TIME,EVENT,CLOCK,");
      if (!row()[3].empty()) rows_.fail("the tick of a clock has no value");
      entry.kind = Entry::Kind::Tick;
      return;
    }
    entry.kind = Entry::Kind::Value;
    entry.first = std::visit([](const auto& list) { return list.size(); }, input.values);
    append(input, 3);
  }

  void read_event(Entry& entry) const {
    const std::string& text = row()[1];
    if (!text.empty()) {
      const char* const last = text.data() + text.size();
      const auto [end, mistake] = std::from_chars(text.data(), last, entry.event);
      if (mistake != std::errc() || end != last || entry.event < 0) {
        rows_.fail("'" + text +
                   "' is not an event; expected the number of an iteration, step, end, or "
                   "nothing");
      }
    }
    if (result_.entries.empty()) return;
    const Entry& before = result_.entries.back();
    const bool follows = before.time == entry.time && before.kind != Entry::Kind::Step;
    if (follows && entry.event < before.event) {
      rows_.fail("out of order: the event iteration is before that of the line above");
    }
  }

  void read_end() {
    expect_fields(4, "TIME,end,,REASON");
    result_.ending = row()[3];
    if (!rows_.at_end()) rows_.fail("the file continues after its end mark");
  }

  // ---- Values ----

  std::optional<std::size_t> find(const std::string& name) const {
    const auto found = places_.find(name);
    return found == places_.end() ? std::nullopt : std::optional(found->second);
  }

  Input& known(const std::string& name) {
    if (const auto place = find(name)) return result_.inputs[*place];
    std::string names;
    for (const Input& input : result_.inputs) {
      names.append(names.empty() ? "" : ", ").append(input.name);
    }
    rows_.fail("the head has no input '" + name + "', only " + (names.empty() ? "none" : names));
  }

  /// The fields from `first` on.
  void append(Input& input, std::size_t first) const {
    if (row().size() - first != input.size) {
      rows_.fail("'" + input.name + "' has " + std::to_string(input.size) +
                 (input.size == 1 ? " element" : " elements") + ", the line gives " +
                 std::to_string(row().size() - first));
    }
    checked([&] {
      for (std::size_t i = first; i < row().size(); ++i) {
        append_parsed(input.values, input.type, row()[i]);
      }
    });
  }

  template <class Work>
  void checked(Work&& work) const {
    try {
      work();
    } catch (const std::invalid_argument& mistake) {
      rows_.fail(mistake.what());
    }
  }

  CsvRows rows_;
  Stimuli result_;
  std::map<std::string, std::size_t> places_;  ///< of the inputs, by name
  std::vector<std::string> clock_names_;       ///< by input
  std::string time_text_ = "0";                ///< of the last row
};

}  // namespace

Stimuli parse_stimuli(const std::string& text, const std::string& file) {
  return Reader(text, file).read();
}

Stimuli load_stimuli(const std::string& file) {
  const std::string text = xml::read_file(file, "what stride run --capture wrote, or a table");
  return text.find(kFormat) <= kByteOrderMark ? parse_stimuli(text, file) : parse_table(text, file);
}

}  // namespace player
