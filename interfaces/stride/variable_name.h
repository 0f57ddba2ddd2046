// The names that FMI knows as structured.
#ifndef STRIDE_VARIABLE_NAME_H
#define STRIDE_VARIABLE_NAME_H

#include <string_view>

namespace stride {
namespace detail {

/// Each function takes a rule of the grammar from the front of what is left; where it answers
/// false, the name is wrong.
class NameParser {
 public:
  explicit NameParser(std::string_view name) : left_(name) {}

  bool name() {
    // '(' is in no identifier, so this is the derivative
    if (left_.substr(0, 4) != "der(") return identifier() && left_.empty();
    left_.remove_prefix(4);
    if (!identifier()) return false;
    if (take(',') && !unsigned_integer()) return false;
    return take(')') && left_.empty();
  }

 private:
  bool identifier() {
    do {
      if (!(next_is('\'') ? quoted_name() : plain_name())) return false;
      if (next_is('[') && !array_indices()) return false;
    } while (take('.'));
    return true;
  }

  bool plain_name() {
    if (left_.empty() || !is_nondigit(left_.front())) return false;
    while (!left_.empty() && (is_nondigit(left_.front()) || is_digit(left_.front()))) skip();
    return true;
  }

  bool quoted_name() {
    skip();
    if (next_is('\'')) return false;
    while (!left_.empty() && !next_is('\'')) {
      const bool escape = take('\\');
      if (left_.empty()) return false;
      if (!(escape ? is_escapable(left_.front()) : is_plain_in_quotes(left_.front()))) return false;
      skip();
    }
    return take('\'');
  }

  bool array_indices() {
    do {
      skip();
      if (!unsigned_integer()) return false;
    } while (next_is(','));
    return take(']');
  }

  bool unsigned_integer() {
    if (left_.empty() || !is_digit(left_.front())) return false;
    while (!left_.empty() && is_digit(left_.front())) skip();
    return true;
  }

  bool next_is(char c) const { return !left_.empty() && left_.front() == c; }
  bool take(char c) {
    const bool found = next_is(c);
    if (found) skip();
    return found;
  }
  void skip() { left_.remove_prefix(1); }

  // not those of <cctype>, which depend on the locale
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_nondigit(char c) {
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  }
  static bool is_one_of(std::string_view characters, char c) {
    return characters.find(c) != std::string_view::npos;
  }
  static bool is_plain_in_quotes(char c) {
    return is_nondigit(c) || is_digit(c) || is_one_of("!#$%&()*+,-./:;<>=?@[]^{}|~ ", c);
  }
  static bool is_escapable(char c) { return is_one_of("'\"?\\abfnrtv", c); }

  std::string_view left_;
};

}  // namespace detail

/// Whether a name follows the grammar of variableNamingConvention="structured" (FMI 3.0,
/// 2.4.7.5.1): parts joined by dots, each an identifier or quoted, with array indices if it is an
/// element ("robot.axes[2,1]", "'left arm'.angle"), or the derivative of such ("der(x)",
/// "der(x,2)").
inline bool is_structured_name(std::string_view name) { return detail::NameParser(name).name(); }

}  // namespace stride

#endif
