#include "master/importer/printf_text.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

#include <sys/syscall.h>
#include <unistd.h>

namespace stride::importer {
namespace {

constexpr const char* kNoText = "(no text)";

/// The parts of a conversion: %[flags][width][.precision][length]type.
struct Conversion {
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

/// The conversion that the text behind a % begins with; nothing if printf knows none such.
std::optional<Conversion> take_conversion(std::string_view& text) {
  constexpr std::string_view kTypes = "diouxXcfFeEgGaAsp%";
  Conversion conversion;
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

class Printer {
 public:
  explicit Printer(std::va_list arguments) { va_copy(arguments_, arguments); }
  ~Printer() { va_end(arguments_); }
  Printer(const Printer&) = delete;
  Printer& operator=(const Printer&) = delete;

  std::string print(const Conversion& conversion) {
    const int width = conversion.has_width_argument ? bounded(va_arg(arguments_, int)) : 0;
    const int precision = conversion.has_precision_argument ? bounded(va_arg(arguments_, int)) : 0;
    return value(conversion, format_of(conversion, width, precision));
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

  std::string value(const Conversion& conversion, const std::string& format) {
    switch (conversion.type) {
      case '%':
        return "%";
      case 'c':
        return printed(format + "c", va_arg(arguments_, int));
      case 's':
        return text(conversion, format);
      case 'p':
        return printed(format + "p", va_arg(arguments_, void*));
      case 'f':
      case 'F':
      case 'e':
      case 'E':
      case 'g':
      case 'G':
      case 'a':
      case 'A':
        return floating_point(conversion, format);
      default:
        return integer(conversion, format);
    }
  }

  std::string text(const Conversion& conversion, const std::string& format) {
    const void* const address = va_arg(arguments_, const void*);
    if (!conversion.length.empty()) return kNoText;  // of wide characters, which no unit has
    const std::size_t point = format.find('.');
    const std::size_t most = point == std::string::npos
                                 ? std::string::npos
                                 : std::strtoul(format.c_str() + point + 1, nullptr, 10);
    return printed(format + "s", text_at(static_cast<const char*>(address), most).c_str());
  }

  std::string floating_point(const Conversion& conversion, const std::string& format) {
    if (conversion.length == "L") {
      return printed(format + "L" + conversion.type, va_arg(arguments_, long double));
    }
    return printed(format + conversion.type, va_arg(arguments_, double));
  }

  std::string integer(const Conversion& conversion, const std::string& format) {
    const std::string whole = format + conversion.length + conversion.type;
    if (conversion.length.empty() || conversion.length.front() == 'h') {
      return printed(whole, va_arg(arguments_, int));
    }
    return printed(whole, va_arg(arguments_, long long));  // as large as the others
  }

  static constexpr int kMostPadding = 100'000;
  std::va_list arguments_;
};

}  // namespace

std::string printf_text(const char* format, std::va_list arguments) {
  Printer printer(arguments);
  std::string_view rest = format;
  std::string text;
  for (std::size_t at = rest.find('%'); at != rest.npos; at = rest.find('%')) {
    text += rest.substr(0, at);
    std::string_view behind = rest.substr(at + 1);
    const auto conversion = take_conversion(behind);
    if (!conversion) return text.append(rest.substr(at));
    text += printer.print(*conversion);
    rest = behind;
  }
  return text.append(rest);
}

}  // namespace stride::importer
