#include "master/observe/recorders/vcd_recorder.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <chrono>
#include <iterator>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/base/text/vcd_code.h"
#include "master/engine/model/array_element.h"

namespace stride::recorders {
namespace {

using core::ValueType;

/// The dump's word for the type, and its width in bits.
const char* declaration(ValueType type) {
  constexpr const char* kDeclarations[] = {"real 64",    "real 64",    "integer 8",  "wire 8",
                                           "integer 16", "wire 16",    "integer 32", "wire 32",
                                           "integer 64", "wire 64",    "wire 1",     "string 1",
                                           "string 1",   "integer 64", "event 1"};
  static_assert(std::size(kDeclarations) == core::kValueTypeCount);
  return kDeclarations[static_cast<std::size_t>(type)];
}

/// Blanks would end the name.
std::string word(std::string_view name) {
  std::string text(name);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c <= ' ' || c == 127; }, '_');
  return text;
}

template <class T>
constexpr bool is_text = std::is_same_v<T, std::string> || std::is_same_v<T, core::Binary>;

/// The bits that distinguish two values: NaN is equal to itself, -0 is not 0.
template <class T>
std::uint64_t bits_of(T value) {
  if constexpr (std::is_same_v<T, double>) {
    return std::bit_cast<std::uint64_t>(value);
  } else if constexpr (std::is_same_v<T, float>) {
    return std::bit_cast<std::uint32_t>(value);
  } else {
    return static_cast<std::uint64_t>(value);
  }
}

/// A negative number is in two's complement of its type's width.
template <class Integer>
void write_binary_digits(core::OutputFile& file, Integer value) {
  auto rest = static_cast<std::make_unsigned_t<Integer>>(value);
  char digits[64];
  std::size_t first = sizeof digits;
  do {
    digits[--first] = static_cast<char>('0' + (rest & 1));
    rest = static_cast<decltype(rest)>(rest >> 1);
  } while (rest != 0);
  file.write('b');
  file.write(std::string_view(digits + first, sizeof digits - first));
}

/// GTKWave takes what is not a printable character as an octal escape.
void write_escaped(core::OutputFile& file, std::string_view text) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 127 && c != '\\') {
      file.write(c);
      continue;
    }
    file.write('\\');
    for (const int shift : {6, 3, 0}) file.write(static_cast<char>('0' + ((byte >> shift) & 7)));
  }
}

template <class T>
void write_change(core::OutputFile& file, const T& value, std::string_view code) {
  if constexpr (std::is_same_v<T, bool>) {
    file.write(value ? '1' : '0');
  } else if constexpr (std::is_floating_point_v<T>) {
    file.write('r');
    file.write_number(value);
    file.write(' ');
  } else if constexpr (std::is_same_v<T, core::Binary>) {
    file.write('s');
    file.write_hex(value);
    file.write(' ');
  } else if constexpr (std::is_same_v<T, std::string>) {
    file.write('s');
    write_escaped(file, value);
    file.write(' ');
  } else {
    write_binary_digits(file, value);
    file.write(' ');
  }
  file.write(code);
  file.write('\n');
}

/// What travels as a message. A clock that the master ticks does if it is connected to a triggered
/// one; what it samples otherwise does not.
bool is_message_variable(const core::System& system, core::VariableId id) {
  const core::Variable& variable = system.variable(id);
  const bool is_connector =
      variable.causality == core::Causality::Input || variable.causality == core::Causality::Output;
  if (!is_connector) return false;
  return variable.is_time_based_clock() ? system.ticks_triggered(id) : !system.is_signal(id);
}

}  // namespace

VcdScope& VcdScope::scope(std::string_view name) {
  const auto [place, is_new] = places_.emplace(word(name), scopes_.size());
  if (is_new) scopes_.emplace_back(place->first);
  return scopes_[place->second];
}

void VcdScope::add(std::string_view structured_name, ValueType type, std::string_view code) {
  const std::size_t dot = structured_name.find('.');
  const bool is_nested =
      dot != std::string_view::npos && dot > 0 && dot + 1 < structured_name.size();
  if (is_nested) {
    scope(structured_name.substr(0, dot)).add(structured_name.substr(dot + 1), type, code);
    return;
  }
  variables_.push_back(
      fmt::format("$var {} {} {} $end\n", declaration(type), code, word(structured_name)));
}

void VcdScope::write(core::OutputFile& file) const {
  for (const std::string& variable : variables_) file.write(variable);
  for (const VcdScope& scope : scopes_) {
    file.write(fmt::format("$scope module {} $end\n", scope.name_));
    scope.write(file);
    file.write("$upscope $end\n");
  }
}

VcdRecorder::VcdRecorder(const core::System& system, std::filesystem::path file,
                         core::OutputFile::Existing existing, Time stop)
    : system_(system), file_(std::move(file), {}, existing) {
  while (stop.time_since_epoch() / tick_ > std::numeric_limits<std::int64_t>::max()) tick_ *= 1000;
}

std::string VcdRecorder::next_code() { return core::vcd_code(codes_++); }

std::string VcdRecorder::declare(VcdScope& top, core::VariableId id, std::size_t element) {
  const core::Variable& variable = system_.variable(id);
  std::string code = next_code();
  top.add(system_.prefix(id) + core::element_name(variable, element), variable.type, code);
  return code;
}

void VcdRecorder::declare_signals(std::span<const core::Signal> signals, VcdScope& top) {
  for (const core::Signal& signal : signals) {
    for (std::size_t i = 0; i < system_.variable(signal.id).size; ++i) {
      recorded_.push_back({signal.block, signal.first + i, declare(top, signal.id, i)});
    }
  }
}

void VcdRecorder::declare_messages(VcdScope& top) {
  for (std::size_t c = 0; c < system_.components().size(); ++c) {
    const core::UnitDescription& description = *system_.components()[c].description;
    std::vector<MessageCodes>& codes = messages_.emplace_back(description.variables.size());
    for (std::size_t v = 0; v < codes.size(); ++v) {
      const core::Variable& variable = description.variables[v];
      if (!is_message_variable(system_, {c, v})) continue;
      const bool is_clock = variable.type == core::ValueType::Clock;
      std::vector<std::string>& own = is_clock ? codes[v].clocks : codes[v].elements;
      for (std::size_t i = 0; i < variable.size; ++i) own.push_back(declare(top, {c, v}, i));
    }
    for (std::size_t v = 0; v < codes.size(); ++v) {
      for (const core::ValueReference reference : description.variables[v].clocks) {
        const auto clock = description.find(reference);
        if (!clock) continue;
        const std::vector<std::string>& ticks = codes[*clock].clocks;
        codes[v].clocks.insert(codes[v].clocks.end(), ticks.begin(), ticks.end());
      }
    }
  }
}

void VcdRecorder::on_start(std::span<const core::Signal> signals) {
  VcdScope top;
  declare_signals(signals, top);
  declare_messages(top);
  constexpr const char* kUnits[] = {"ps", "ns", "us", "ms", "s"};
  const char* const* unit = kUnits;
  for (Duration tick = tick_; tick > Duration(1); tick /= 1000) ++unit;
  file_.write(fmt::format("$version stride $end\n$timescale 1 {} $end\n", *unit));
  top.write(file_);
}

/// Time stamps are not negative in a dump; viewers add $timezero to them.
void VcdRecorder::end_header(Time start) {
  if (start < Time()) {
    origin_ = start;
    file_.write(fmt::format("$timezero {} $end\n", start.time_since_epoch() / tick_));
  }
  file_.write("$enddefinitions $end\n");
}

void VcdRecorder::move_to(Time time) {
  if (written_time_ == time) return;
  if (!written_time_) end_header(time);
  written_time_ = time;
  file_.write('#');
  file_.write_number(static_cast<std::int64_t>((time - origin_) / tick_));
  file_.write('\n');
}

void VcdRecorder::on_message(const core::Message& message) {
  file_.set_time(message.time);
  move_to(message.time);
  const MessageCodes& codes = messages_[message.id.component][message.id.variable];
  for (std::size_t i = 0; message.block != nullptr && i < codes.elements.size(); ++i) {
    core::visit(*message.block, [&](auto values) {
      write_change(file_, values[message.first + i], codes.elements[i]);
    });
  }
  for (const std::string& clock : codes.clocks) write_change(file_, true, clock);
}

void VcdRecorder::write_changes(bool all) {
  for (VcdVariable& variable : recorded_) {
    core::visit(*variable.block, [&](auto values) {
      const auto& value = values[variable.element];
      using T = std::remove_cvref_t<decltype(value)>;
      if constexpr (is_text<T>) {
        const std::string_view text(reinterpret_cast<const char*>(value.data()), value.size());
        if (!all && text == variable.text) return;
        variable.text = text;
      } else {
        const std::uint64_t bits = bits_of(value);
        if (!all && bits == variable.bits) return;
        variable.bits = bits;
      }
      move_to(last_point_);
      write_change(file_, value, variable.code);
    });
  }
}

void VcdRecorder::on_communication_point(Time time) {
  file_.set_time(time);
  last_point_ = time;
  if (!is_first_point_) return write_changes(false);
  is_first_point_ = false;
  move_to(time);
  file_.write("$dumpvars\n");
  write_changes(true);
  file_.write("$end\n");
}

void VcdRecorder::persist(core::StateArchive& state) {
  state.mark("trace");
  file_.persist(state);
  state.fixed(recorded_, [&](VcdVariable& variable) {
    state.value(variable.bits);
    state.value(variable.text);
  });
  state.value(written_time_);
  state.value(origin_);
  state.value(tick_);
  state.value(last_point_);
  state.value(is_first_point_);
}

void VcdRecorder::on_finish() {
  if (!written_time_) end_header(Time());
  if (written_time_ && *written_time_ < last_point_) move_to(last_point_);
  file_.close();
}

}  // namespace stride::recorders
