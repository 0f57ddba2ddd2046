#include "master/loader/fmu/instance/printf_text.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <sys/syscall.h>
#include <unistd.h>

namespace stride::importer {
namespace {

constexpr const char* kNoText = "(no text)";

/// The parts of a conversion: %[argument$][flags][width][.precision][length]type.
struct Conversion {
  std::size_t argument = 0;  ///< its place, from 1 on; 0 = the next one
  std::string flags;
  bool has_width_argument = false;
  bool has_precision_argument = false;
  std::string length;
  char type = '\0';
};

std::string_view take_while(std::string_view& text, std::string_view characters) {
  const std::string_view taken = text.substr(0, text.find_first_not_of(characters));
  text.remove_prefix(taken.size());
  return taken;
}

bool take(std::string_view& text, char character) {
  if (!text.starts_with(character)) return false;
  text.remove_prefix(1);
  return true;
}

/// Of a width or a precision. Returns whether it is not so large that it is a mistake.
bool take_number(std::string_view& text, std::string& into) {
  constexpr std::size_t kMostDigits = 5;
  const std::string_view digits = take_while(text, "0123456789");
  into += digits;
  return digits.size() <= kMostDigits;
}

/// "2$"; 0 if there is none.
std::size_t take_argument(std::string_view& text) {
  std::string_view rest = text;
  std::string digits;
  if (!take_number(rest, digits) || !take(rest, '$')) return 0;
  const std::size_t argument = std::strtoul(digits.c_str(), nullptr, 10);
  if (argument > 0) text = rest;
  return argument;
}

/// The conversion that the text behind a % begins with; nothing if printf knows none such.
std::optional<Conversion> take_conversion(std::string_view& text) {
  constexpr std::string_view kTypes = "diouxXcfFeEgGaAsp%";
  Conversion conversion;
  conversion.argument = take_argument(text);
  conversion.flags = take_while(text, " #+-0'");
  conversion.has_width_argument = take(text, '*');
  if (!conversion.has_width_argument && !take_number(text, conversion.flags)) return std::nullopt;
  if (take(text, '.')) {
    conversion.flags += '.';
    conversion.has_precision_argument = take(text, '*');
    if (!conversion.has_precision_argument && !take_number(text, conversion.flags)) {
      return std::nullopt;
    }
  }
  conversion.length = take_while(text, "hlLqjzt");
  if (text.empty() || kTypes.find(text.front()) == kTypes.npos) return std::nullopt;
  conversion.type = text.front();
  text.remove_prefix(1);
  return conversion;
}

/// Whether the eight bytes at this address, a multiple of eight, can be read: the kernel reads them
/// before it refuses the first argument.
bool is_readable(std::uintptr_t address) {
  if (address == 0) return false;  // to the kernel it is no argument
  constexpr int kNoSuchChange = ~0;
  const int kept = errno;
  const long answer = ::syscall(SYS_rt_sigprocmask, kNoSuchChange, address, nullptr, 8);
  const bool is_refused_address = answer == -1 && errno == EFAULT;
  errno = kept;
  return !is_refused_address;
}

/// A text of the unit, of `most` characters at most. What is there may be anything.
__attribute__((no_sanitize("address"))) std::string text_at(const char* text, std::size_t most) {
  constexpr std::uintptr_t kPage = 4096;
  constexpr std::size_t kLongest = 100'000;
  std::string copy;
  for (const char* at = text; copy.size() < std::min(most, kLongest); ++at) {
    const auto address = reinterpret_cast<std::uintptr_t>(at);
    const bool is_on_new_page = at == text || address % kPage == 0;
    if (is_on_new_page && !is_readable(address - address % 8)) return kNoText;
    if (*at == '\0') break;
    copy += *at;
  }
  return copy;
}

template <class... Arguments>
std::string printed(const std::string& format, Arguments... arguments) {
  const int size = std::snprintf(nullptr, 0, format.c_str(), arguments...);
  if (size < 0) return format;
  std::string text(static_cast<std::size_t>(size), '\0');
  std::snprintf(text.data(), text.size() + 1, format.c_str(), arguments...);
  return text;
}

using Argument = std::variant<int, long long, double, long double, const void*>;

/// An argument of the type that the conversion is for, without a value.
Argument kind_of(const Conversion& conversion) {
  constexpr std::string_view kFloatingPoint = "fFeEgGaA";
  if (conversion.type == 's' || conversion.type == 'p') return static_cast<const void*>(nullptr);
  if (kFloatingPoint.find(conversion.type) != kFloatingPoint.npos) {
    return conversion.length == "L" ? Argument(0.0L) : Argument(0.0);
  }
  const bool is_int =
      conversion.type == 'c' || conversion.length.empty() || conversion.length.front() == 'h';
  return is_int ? Argument(0) : Argument(0LL);  // as large as the others
}

/// Those of a call, one after the other.
class Arguments {
 public:
  explicit Arguments(std::va_list arguments) { va_copy(arguments_, arguments); }
  ~Arguments() { va_end(arguments_); }
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;

  Argument next(const Conversion& conversion) {
    return std::visit([&](auto kind) { return Argument(take<decltype(kind)>()); },
                      kind_of(conversion));
  }
  template <class T>
  T take() {
    return va_arg(arguments_, T);
  }

 private:
  std::va_list arguments_;
};

class Printer {
 public:
  explicit Printer(std::va_list arguments) : arguments_(arguments) {}

  /// To be called before print() where arguments have places.
  void take_placed(std::vector<Argument> arguments) { placed_ = std::move(arguments); }
  Arguments& arguments() { return arguments_; }

  std::string print(const Conversion& conversion) {
    if (conversion.type == '%') return "%";
    const int width = conversion.has_width_argument ? bounded(arguments_.take<int>()) : 0;
    const int precision = conversion.has_precision_argument ? bounded(arguments_.take<int>()) : 0;
    const Argument argument =
        conversion.argument > 0 ? placed_[conversion.argument - 1] : arguments_.next(conversion);
    const std::string format = format_of(conversion, width, precision);
    if (conversion.type == 's') return text(conversion, format, std::get<const void*>(argument));
    return std::visit(
        [&](auto value) {
          return printed(format + length_of(conversion) + conversion.type, value);
        },
        argument);
  }

 private:
  static int bounded(int size) { return std::clamp(size, -kMostPadding, kMostPadding); }

  /// The format without its length and type.
  static std::string format_of(const Conversion& conversion, int width, int precision) {
    const std::size_t point = conversion.flags.find('.');
    std::string format = "%" + conversion.flags.substr(0, point);
    if (conversion.has_width_argument) format += std::to_string(width);
    if (point == std::string::npos || precision < 0) return format;  // below 0 it counts as none
    format += conversion.flags.substr(point);
    if (conversion.has_precision_argument) format += std::to_string(precision);
    return format;
  }

  /// That of the argument as kind_of() has it.
  static std::string length_of(const Conversion& conversion) {
    const bool has_none = conversion.type == 'c' || conversion.type == 'p' ||
                          (std::holds_alternative<double>(kind_of(conversion)));
    return has_none ? "" : conversion.length;
  }

  static std::string text(const Conversion& conversion, const std::string& format,
                          const void* address) {
    if (!conversion.length.empty()) return kNoText;  // of wide characters, which no unit has
    const std::size_t point = format.find('.');
    const std::size_t most = point == std::string::npos
                                 ? std::string::npos
                                 : std::strtoul(format.c_str() + point + 1, nullptr, 10);
    return printed(format + "s", text_at(static_cast<const char*>(address), most).c_str());
  }

  static constexpr int kMostPadding = 100'000;
  Arguments arguments_;
  std::vector<Argument> placed_;
};

/// A conversion, or the text before it.
using Piece = std::variant<std::string_view, Conversion>;

/// From a conversion on that printf does not know, all is text.
std::vector<Piece> pieces_of(std::string_view rest) {
  std::vector<Piece> pieces;
  for (std::size_t at = rest.find('%'); at != rest.npos; at = rest.find('%')) {
    std::string_view behind = rest.substr(at + 1);
    auto conversion = take_conversion(behind);
    if (!conversion) break;
    pieces.emplace_back(rest.substr(0, at));
    pieces.emplace_back(std::move(*conversion));
    rest = behind;
  }
  pieces.emplace_back(rest);
  return pieces;
}

/// The arguments in their order, where each conversion names its place; none if no conversion does.
/// Nothing if the type of one is not known or not clear, or if they are mixed with others.
std::optional<std::vector<Argument>> take_placed(const std::vector<Piece>& pieces,
                                                 Arguments& arguments) {
  std::map<std::size_t, const Conversion*> by_place;
  bool has_next = false;
  for (const Piece& piece : pieces) {
    const auto* const conversion = std::get_if<Conversion>(&piece);
    if (conversion == nullptr || conversion->type == '%') continue;
    has_next |= conversion->argument == 0 || conversion->has_width_argument ||
                conversion->has_precision_argument;
    if (conversion->argument == 0) continue;
    const auto& first = by_place.emplace(conversion->argument, conversion).first->second;
    if (kind_of(*first).index() != kind_of(*conversion).index()) return std::nullopt;
  }
  if (by_place.empty()) return std::vector<Argument>();
  if (has_next || by_place.rbegin()->first != by_place.size()) return std::nullopt;
  std::vector<Argument> placed;
  for (const auto& [place, conversion] : by_place) placed.push_back(arguments.next(*conversion));
  return placed;
}

}  // namespace

std::string printf_text(const char* format, std::va_list arguments) {
  const std::vector<Piece> pieces = pieces_of(format);
  Printer printer(arguments);
  auto placed = take_placed(pieces, printer.arguments());
  if (!placed) return format;
  printer.take_placed(std::move(*placed));
  std::string text;
  for (const Piece& piece : pieces) {
    const auto* const conversion = std::get_if<Conversion>(&piece);
    text += conversion != nullptr ? printer.print(*conversion)
                                  : std::string(std::get<std::string_view>(piece));
  }
  return text;
}

}  // namespace stride::importer
