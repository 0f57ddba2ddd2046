// What commands and their parts are called in programs, reports and messages.
#ifndef STRIDE_NFC_NAMES_H
#define STRIDE_NFC_NAMES_H

#include <cstdint>
#include <string>

#include <stride/nfc/commands.h>

namespace nfc {

inline constexpr Status kStatuses[] = {Status::Ok, Status::UnknownCommand, Status::BadArgument};

/// Such as "read_temperature"; "raw 0x7F" for a byte that is not a command.
std::string name_of(Command command);

/// Such as "bad_argument"; "status 0x7F" for a byte that is none.
std::string name_of(Status status);

/// Of an identifier, such as "0x0A2B3C4D".
std::string hexadecimal(std::uint32_t number);

}  // namespace nfc

#endif
