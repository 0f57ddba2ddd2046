#include "units/player/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <stride/time_text.h>

#include "units/player/csv.h"
#include "units/player/heading.h"

namespace player {
namespace {

/// After a step that has ended there, in the event.
constexpr std::int32_t kInEvent = 1;

/// Picoseconds that are what sums of doubles leave in place of 0.
constexpr long double kNoise = 1e-3L;

struct Column {
  Heading heading;
  std::size_t input = 0;
  bool has_value = false;  ///< in a row so far
  stride::Time latest{};   ///< of the latest value
  int values_at_once = 0;  ///< different ones at that time

  Course course() const { return *heading.course; }
  bool is_event() const { return course() == Course::Event; }
};

bool is_number(const std::string& text) {
  double number = 0;
  const std::string plain = plain_value(Type::Float64, text);
  const char* const last = plain.data() + plain.size();
  const auto [end, mistake] = std::from_chars(plain.data(), last, number);
  return mistake == std::errc() && end == last;
}

/// Whether it is a whole number that a double would round.
bool is_too_long(const std::string& text) {
  constexpr std::size_t kAlwaysExact = 15;  // digits
  const std::string plain = plain_value(Type::Float64, text);
  const std::size_t sign = plain.rfind('-', 0) == 0 ? 1 : 0;
  if (plain.size() - sign <= kAlwaysExact) return false;
  if (plain.find_first_not_of("0123456789", sign) != std::string::npos) return false;
  std::uint64_t whole = 0;
  double number = 0;
  const char* const first = plain.data() + sign;
  const char* const last = plain.data() + plain.size();
  std::from_chars(first, last, number);
  if (std::from_chars(first, last, whole).ec != std::errc()) return false;  // beyond any integer
  return number >= 0x1p64 || static_cast<std::uint64_t>(number) != whole;
}

/// 0 and 1 are numbers.
bool is_truth(const std::string& text) {
  const std::string plain = plain_value(Type::Boolean, text);
  return (plain == "true" || plain == "false") && !is_number(text);
}

/// "0,5", as one half is written in many languages.
bool has_decimal_comma(const std::string& text) {
  std::string number = trimmed(text);
  const std::size_t comma = number.find(',');
  if (comma == std::string::npos) return false;
  number[comma] = '.';
  return is_number(number);
}

/// What the values of a column look like that does not name its type.
class Looks {
 public:
  void add(const std::string& text, int line, bool is_quoted) {
    Kind& kind = is_number(text) ? number_ : is_truth(text) ? truth_ : other_;
    if (kind.count++ == 0) kind.line = line, kind.text = text;
    are_decimal_commas_ &= has_decimal_comma(text);
    if (too_long_.line == 0 && is_too_long(text)) too_long_ = {line, text};
    has_bare_value_ |= !is_quoted && &kind != &other_;
  }

  /// Boolean or Float64 if all of them are such values, else String. Throws std::invalid_argument
  /// for a column of several kinds, unless quotation marks say that it is text.
  Type type() const {
    const Kind* const kinds[] = {&number_, &truth_, &other_};
    std::vector<const Kind*> seen;
    for (const Kind* kind : kinds) {
      if (kind->line != 0) seen.push_back(kind);
    }
    if (seen.size() > 1 && has_bare_value_) refuse(seen);
    if (seen.size() == 1 && are_decimal_commas_) {
      throw Mistake(other_.line, "'" + other_.text +
                                     "' looks like a number with a decimal comma; expected a "
                                     "decimal point, or ': String' behind the heading for text");
    }
    if (seen.size() > 1 || other_.line != 0) return Type::String;
    if (too_long_.line != 0) refuse_too_long();
    return truth_.line != 0 ? Type::Boolean : Type::Float64;
  }

  struct Mistake : std::invalid_argument {
    Mistake(int where, const std::string& text) : std::invalid_argument(text), line(where) {}
    int line;
  };

 private:
  struct Kind {
    int line = 0;        ///< of the first one; 0: there is none
    std::string text{};  ///< likewise
    int count = 0;
  };

  /// What is rarest is the mistake, or the later one of two kinds that are as rare.
  [[noreturn]] void refuse(std::vector<const Kind*> seen) const {
    std::sort(seen.begin(), seen.end(), [](const Kind* a, const Kind* b) {
      return a->count != b->count ? a->count > b->count : a->line < b->line;
    });
    const Kind &common = *seen.front(), &odd = *seen.back();
    const char* const name = &common == &number_  ? "a number"
                             : &common == &truth_ ? "true or false"
                                                  : "text";
    const auto has = [&](char sign) {
      return &odd == &other_ && odd.text.find(sign) != std::string::npos;
    };
    throw Mistake(odd.line, "'" + odd.text + "' is not " + name + " as '" + common.text +
                                "' in line " + std::to_string(common.line) + " is; " +
                                (has(';') ? "expected commas between fields; " : "") +
                                (has(',') ? "expected a decimal point; " : "") +
                                "leave the field empty if there is no value, or write ': " +
                                (other_.line == 0 ? "Boolean" : "String") +
                                "' behind the heading if all of them are meant so");
  }

  [[noreturn]] void refuse_too_long() const {
    throw Mistake(too_long_.line,
                  "'" + too_long_.text +
                      "' has more digits than a Float64, the type of a column of numbers; write "
                      "': Int64' or ': UInt64' behind the heading for whole numbers, or "
                      "': Float64' to round them");
  }

  Kind number_, truth_, other_, too_long_;
  bool are_decimal_commas_ = true;
  bool has_bare_value_ = false;  ///< without quotation marks, and not text anyhow
};

/// Of the last value and the one before it.
bool ends_with_change(const Values& values) {
  return std::visit(
      [](const auto& list) {
        return list.size() < 2 || list[list.size() - 1] != list[list.size() - 2];
      },
      values);
}

void drop_last(Values& values) {
  std::visit([](auto& list) { list.pop_back(); }, values);
}

void append_nothing(Values& values) {
  std::visit([](auto& list) { list.emplace_back(); }, values);
}

std::size_t size_of(const Values& values) {
  return std::visit([](const auto& list) { return list.size(); }, values);
}

/// `frame.data` has the clock `frame.clock`, as in a declaration of a program.
std::string clock_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot != std::string::npos) return name.substr(0, dot) + ".clock";
  throw std::invalid_argument("expected a name such as '" + name +
                              ".value' for events, whose "
                              "clock is '" +
                              name + ".clock'");
}

class TableReader {
 public:
  TableReader(const std::string& text, const std::string& file)
      : text_(text), file_(file), rows_(text_, file_) {
    result_.is_table = true;
  }

  Stimuli read() {
    read_headings();
    complete_types();
    for (std::size_t i = 0; i < columns_.size(); ++i) in_column(i, [&] { add_input(i); });
    while (next_row()) read_row();
    if (is_first_) rows_.fail_at(1, "the table has headings, and no rows");
    for (std::size_t i = 0; i < columns_.size(); ++i) finish_column(i);
    result_.entries.push_back(entry(Entry::Kind::End, 0));
    result_.ending = "completed";
    return std::move(result_);
  }

 private:
  // ---- The headings ----

  void read_headings() {
    refuse_other_files();
    if (!rows_.next()) rows_.fail("the table is empty; expected a line of headings");
    const auto& fields = rows_.fields();
    refuse_other_separators(fields);
    refuse_other_order(fields);
    checked([&] { ticks_ = parse_time_heading(fields[0]); });
    if (fields.size() == 1) {
      rows_.fail("the table has no column behind 'time'; expected others, separated by commas");
    }
    for (std::size_t i = 1; i < fields.size(); ++i) read_heading(i, fields[i]);
  }

  void read_heading(std::size_t i, const std::string& field) {
    const std::string place = "column " + std::to_string(i + 1);
    try {
      columns_.push_back({parse_heading(field)});
    } catch (const std::invalid_argument& mistake) {
      rows_.fail(place + ": " + mistake.what());
    }
    const std::string& name = columns_.back().heading.name;
    const auto [first, is_new] = places_.emplace(name, i);
    if (is_new) return;
    rows_.fail("columns " + std::to_string(first->second + 1) + " and " + std::to_string(i + 1) +
               " have one name, '" + name + "'");
  }

  /// Tables that are none in UTF-8 with line feeds.
  void refuse_other_files() const {
    const std::string mark = text_.substr(0, 2);
    if (mark == "\xff\xfe" || mark == "\xfe\xff") {
      rows_.fail_at(1, "the file is in UTF-16; expected UTF-8: save it as 'CSV UTF-8'");
    }
    if (text_.find('\n') + 1 < text_.size() || text_.find('\r') == std::string::npos) return;
    if (text_.find('\r') + 2 >= text_.size()) return;
    rows_.fail_at(1,
                  "the lines end with a carriage return alone, as on an old Macintosh; expected a "
                  "line feed, alone or behind it: save it as CSV with the line ends of Unix or "
                  "Windows");
  }

  void refuse_other_separators(const std::vector<std::string>& fields) const {
    const std::string first = trimmed(fields[0]);
    for (const auto& [separator, name] : {std::pair{';', "';'"}, {'\t', "tabs"}, {'|', "'|'"}}) {
      if (first.find(separator) == std::string::npos) continue;
      rows_.fail(std::string("the fields are separated by ") + name +
                 "; expected commas, and numbers with a decimal point: save it with the separator "
                 "',', or convert it, as by pandas.read_csv(FILE, sep=…, decimal=…).to_csv(…)");
    }
  }

  /// Of lines, and of columns.
  void refuse_other_order(const std::vector<std::string>& fields) const {
    if (fields[0].compare(0, 1, "#") == 0) {
      rows_.fail(
          "the line begins with '#'; a table has no comments, and its headings are in the "
          "first line");
    }
    if (is_time_heading(fields[0])) return;
    const auto time = std::find_if(fields.begin(), fields.end(), &is_time_heading);
    if (time == fields.end()) return;
    rows_.fail("'" + *time + "' is the heading of column " +
               std::to_string(time - fields.begin() + 1) + "; expected it as the first one");
  }

  void complete_types() {
    std::vector<Looks> looks(columns_.size());
    for (CsvRows rows(text_, file_); rows.next();) {
      if (rows.line() == rows_.line()) continue;
      for (std::size_t i = 0; i < columns_.size() && i + 1 < rows.fields().size(); ++i) {
        const std::string& field = rows.fields()[i + 1];
        const bool is_quoted = rows.is_quoted(i + 1);
        if (is_quoted || !trimmed(field).empty()) looks[i].add(field, rows.line(), is_quoted);
      }
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      Heading& heading = columns_[i].heading;
      if (!heading.type) heading.type = type_of(looks[i], heading.name);
      if (!heading.course) heading.course = is_real(i) ? Course::Linear : Course::Hold;
    }
  }

  Type type_of(const Looks& looks, const std::string& name) const {
    try {
      return looks.type();
    } catch (const Looks::Mistake& mistake) {
      rows_.fail_at(mistake.line, "column '" + name + "': " + mistake.what());
    }
  }

  bool is_real(std::size_t i) const {
    const Type type = *columns_[i].heading.type;
    return type == Type::Float64 || type == Type::Float32;
  }

  void add_input(std::size_t i) {
    Column& column = columns_[i];
    const auto& [name, unit, type, course] = column.heading;
    if (course == Course::Linear && !is_real(i)) {
      throw std::invalid_argument("only Float64 and Float32 can be linear; expected hold or event");
    }
    if (!unit.empty() && !is_real(i)) {
      throw std::invalid_argument("a value with a unit of measure, [" + unit +
                                  "], is a Float64 or Float32; expected ': Float64', or no unit");
    }
    std::optional<std::size_t> clock;
    if (column.is_event()) clock = clock_named(clock_of(name));
    column.input = result_.inputs.size();
    Input& input = result_.inputs.emplace_back();
    input.name = name;
    input.unit = unit;
    input.type = *type;
    input.clock = clock;
    input.is_continuous = course == Course::Linear;
    input.values = values_of(*type);
    if (input.is_continuous) input.curve.emplace();
    if (clock) append_nothing(input.values);
  }

  std::size_t clock_named(const std::string& name) {
    if (places_.count(name) != 0) {
      throw std::invalid_argument("its clock '" + name + "' has the name of another column");
    }
    const auto [found, is_new] = clocks_.emplace(name, result_.inputs.size());
    if (is_new) {
      Input& clock = result_.inputs.emplace_back();
      clock.name = name;
      clock.type = Type::Clock;
      clock.values = values_of(Type::Clock);
    }
    return found->second;
  }

  // ---- The rows ----

  bool next_row() {
    if (!rows_.next()) return false;
    const std::size_t count = rows_.fields().size();
    if (count == columns_.size() + 1) return true;
    const bool is_blank = count == 1 && trimmed(rows_.fields()[0]).empty();
    if (is_blank) rows_.fail("the line is empty; expected a row, or nothing behind the last one");
    rows_.fail("the line has " + std::to_string(count) + (count == 1 ? " field" : " fields") +
               ", the headings " + std::to_string(columns_.size() + 1) + count_hint());
  }

  /// Of a line that has another number of fields.
  std::string count_hint() const {
    const auto& fields = rows_.fields();
    const bool has_semicolon =
        std::any_of(fields.begin(), fields.end(),
                    [](const std::string& field) { return field.find(';') != std::string::npos; });
    if (has_semicolon) {
      return "; fields are separated by commas, not by ';', and numbers have a decimal point";
    }
    if (fields.size() < columns_.size() + 1) return "; a field without a value is empty: ',,'";
    return "; numbers have a decimal point, and a text with a comma stands in quotation marks";
  }

  /// At an instant the values come first, then the messages, then where lines jump.
  void read_row() {
    read_time();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!columns_[i].is_event() && has_field(i)) in_column(i, [&] { read_value(i); });
    }
    for (const auto& [name, clock] : clocks_) read_message(clock);
    for (const std::size_t input : jumps_) {
      result_.entries.push_back(entry(Entry::Kind::Jump, input));
      result_.entries.back().event = kInEvent;
    }
    jumps_.clear();
  }

  void read_time() {
    long double ticks = 0;
    const std::string& field = rows_.fields()[0];
    const std::string text = plain_value(Type::Float64, field);
    checked([&] { ticks = parse_ticks(text); });
    const stride::Time rounded(
        stride::Duration(static_cast<stride::Picoseconds>(std::round(ticks))));
    const stride::Time time =
        stride::time_of_decimal(text, stride::Duration(ticks_)).value_or(rounded);
    if (!is_first_ && time < time_) {
      rows_.fail("column 'time': " + field + " is before the time of the line above");
    }
    const bool is_lost = time == stride::Time{} && std::abs(ticks) > kNoise;
    const bool is_merged = !is_first_ && time == time_ && ticks - exact_ticks_ > kNoise;
    if (is_lost || is_merged) {
      rows_.fail("column 'time': " + field + " is less than 1 ps from " +
                 (is_merged ? "the time of the line above" : "0") +
                 ", and 1 ps is the resolution of times");
    }
    time_ = time;
    exact_ticks_ = ticks;
    if (std::exchange(is_first_, false)) result_.begin = time;
  }

  /// In picoseconds.
  long double parse_ticks(const std::string& text) const {
    long double number = 0;
    const char* const last = text.data() + text.size();
    const auto [end, mistake] = std::from_chars(text.data(), last, number);
    const long double ticks = number * static_cast<long double>(ticks_);
    const bool is_time = mistake == std::errc() && end == last && !text.empty();
    if (is_time && std::abs(ticks) <= stride::kMaxSeconds * 1e12L) return ticks;
    const bool is_number = end == last && !text.empty() && !std::isnan(number);
    throw std::invalid_argument("column 'time': '" + text + "' is " +
                                (is_number
                                     ? "beyond 1e15 s, the largest time; let the times begin at 0"
                                     : "not a time; expected a number"));
  }

  bool has_field(std::size_t i) const { return rows_.is_quoted(i + 1) || !field(i).empty(); }
  /// In a form that can be read; blanks are a value of a String only.
  std::string field(std::size_t i) const {
    return plain_value(*columns_[i].heading.type, rows_.fields()[i + 1]);
  }

  void read_value(std::size_t i) {
    Column& column = columns_[i];
    Input& input = result_.inputs[column.input];
    if (column.course() == Course::Linear) return add_point(i, input);
    append_parsed(input.values, input.type, field(i));
    const bool is_changed = ends_with_change(input.values);
    require_time_for_value(column, is_changed);
    const bool is_first = !std::exchange(column.has_value, true);
    if (is_first) return;  // it is the start value
    if (!is_changed) return drop_last(input.values);
    result_.entries.push_back(value_of(column.input));
  }

  /// A value between two others of one time would never be seen.
  void require_time_for_value(Column& column, bool is_changed) const {
    const bool is_later = !column.has_value || column.latest != time_;
    column.latest = time_;
    if (is_later) column.values_at_once = 0;
    if (is_later || is_changed) ++column.values_at_once;
    if (column.values_at_once < 3) return;
    throw std::invalid_argument("a third value at the time " + rows_.fields()[0] +
                                "; two are a jump, from the first one to the second, so expected "
                                "two, and another time for the third");
  }

  void add_point(std::size_t i, Input& input) {
    Values own = values_of(input.type);
    append_parsed(own, input.type, field(i));  // which has the range of its type
    Values number = values_of(Type::Float64);
    append_parsed(number, Type::Float64, field(i));
    const double value = std::get<std::vector<double>>(number).front();
    if (!std::isfinite(value)) {
      throw std::invalid_argument("'" + field(i) + "' is not finite, so no line leads to it");
    }
    const bool is_changed = input.curve->is_empty() || input.curve->last() != value;
    require_time_for_value(columns_[i], is_changed);
    input.curve->add(time_, value);
    columns_[i].has_value = true;
    if (input.curve->ends_with_jump()) jumps_.push_back(columns_[i].input);
  }

  Entry entry(Entry::Kind kind, std::size_t input) const {
    Entry made;
    made.time = time_;
    made.kind = kind;
    made.input = input;
    return made;
  }

  /// The last one of the input.
  Entry value_of(std::size_t input) const {
    Entry value = entry(Entry::Kind::Value, input);
    value.first = size_of(result_.inputs[input].values) - 1;
    return value;
  }

  void read_message(std::size_t clock) {
    std::vector<std::size_t> parts, missing;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const bool is_of_clock = result_.inputs[columns_[i].input].clock == clock;
      if (is_of_clock) (has_field(i) ? parts : missing).push_back(i);
    }
    if (parts.empty()) return;
    if (!missing.empty()) {
      in_column(missing.front(), [&] {
        throw std::invalid_argument("the message has a value in the column '" +
                                    columns_[parts.front()].heading.name + "', and none here");
      });
    }
    result_.entries.push_back(entry(Entry::Kind::Tick, clock));
    for (const std::size_t i : parts) in_column(i, [&] { read_part(i); });
  }

  void read_part(std::size_t i) {
    Input& input = result_.inputs[columns_[i].input];
    append_parsed(input.values, input.type, field(i));
    columns_[i].has_value = true;
    result_.entries.push_back(value_of(columns_[i].input));
  }

  void finish_column(std::size_t i) {
    if (!columns_[i].has_value) {
      rows_.fail_at(1, "column '" + columns_[i].heading.name + "' has no value in any row");
    }
    Input& input = result_.inputs[columns_[i].input];
    if (!input.curve) return;
    append_nothing(input.values);  // the unit shows its curve
  }

  // ---- Mistakes ----

  template <class Work>
  void checked(Work&& work) const {
    try {
      work();
    } catch (const std::invalid_argument& mistake) {
      rows_.fail(mistake.what());
    }
  }
  template <class Work>
  void in_column(std::size_t i, Work&& work) const {
    try {
      work();
    } catch (const std::invalid_argument& mistake) {
      rows_.fail("column '" + columns_[i].heading.name + "': " + mistake.what());
    }
  }

  const std::string& text_;
  const std::string& file_;
  CsvRows rows_;
  Stimuli result_;
  std::int64_t ticks_ = 0;  ///< picoseconds of the unit of the time
  std::vector<Column> columns_;
  std::map<std::string, std::size_t> places_;  ///< of columns, by name
  std::map<std::string, std::size_t> clocks_;  ///< inputs, by name
  std::vector<std::size_t> jumps_;             ///< inputs, in the present row
  stride::Time time_{};
  long double exact_ticks_ = 0;  ///< of the same time, before it was rounded
  bool is_first_ = true;
};

/// Without the lines at the end that have no value, which spreadsheets write, and the last line
/// feed. A time is a value, so no such line is a row.
std::size_t size_without_blank_end(const std::string& text) {
  const std::size_t last = text.find_last_not_of(" \t,\r\n");
  return last == std::string::npos ? 0 : std::min(text.find('\n', last), text.size());
}

}  // namespace

Stimuli parse_table(const std::string& text, const std::string& file) {
  const std::size_t size = size_without_blank_end(text);
  const bool is_whole = size == 0 ? text.empty() : size + 1 == text.size() && text.back() == '\n';
  const std::string whole = is_whole || size == 0 ? "" : text.substr(0, size) + '\n';
  return TableReader(is_whole ? text : whole, file).read();
}

}  // namespace player
