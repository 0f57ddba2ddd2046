// Messages, which quote names and values of any length and content.
#ifndef STRIDE_MASTER_BASE_MESSAGE_TEXT_H
#define STRIDE_MASTER_BASE_MESSAGE_TEXT_H

#include <string>
#include <string_view>

namespace stride::core {

/// A message as a log has it: each line behind the first one begins with blanks, so that what is
/// quoted cannot look like a message of its own; NUL, which ends a text of C, is "\\x00".
std::string log_text(std::string_view message);

/// Likewise, and not longer than a message can be read: a long word, a long line, and the lines
/// behind the hundredth are replaced by their length. A second call changes nothing.
std::string message_text(std::string_view message);

/// A name or a value within a message, in one line: a line feed is "\\x0a", and NUL "\\x00". Needed
/// for what an exception of the standard library quotes, whose text NUL would end.
std::string name_text(std::string_view name);

/// "name [unit]", as files and tables have it; the name alone where there is no unit of measure.
std::string with_unit(const std::string& name, const std::string& unit);

/// Without what follows it.
std::string first_line(std::string_view text);

}  // namespace stride::core

#endif
