#include <stride/nfc/names.h>

namespace nfc {
namespace {

/// The lowest digits of a number, with "0x" before them.
std::string hexadecimal(std::uint32_t number, int digits) {
  std::string text = "0x";
  while (digits-- > 0) text += "0123456789ABCDEF"[number >> (4 * digits) & 0xF];
  return text;
}

}  // namespace

std::string name_of(Command command) {
  const CommandFormat* const format = find_format(command);
  return format != nullptr ? format->name
                           : "raw " + hexadecimal(static_cast<std::uint8_t>(command), 2);
}

std::string name_of(Status status) {
  switch (status) {
    case Status::Ok:
      return "ok";
    case Status::UnknownCommand:
      return "unknown_command";
    case Status::BadArgument:
      return "bad_argument";
  }
  return "status " + hexadecimal(static_cast<std::uint8_t>(status), 2);
}

std::string hexadecimal(std::uint32_t number) { return hexadecimal(number, 8); }

}  // namespace nfc
