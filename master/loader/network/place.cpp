#include "master/loader/network/place.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include <fmt/format.h>

#include "master/base/text/shell_word.h"

namespace stride::remote {
namespace {

constexpr std::string_view kSsh = "ssh://";
constexpr std::string_view kExec = "exec:";

[[noreturn]] void fail(std::string_view text, const std::string& why) {
  throw std::invalid_argument(fmt::format(
      "'{}' is no place for a unit: {}; expected ssh://[user@]machine[:port], or exec:COMMAND",
      text, why));
}

bool is_of_name(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '.' ||
         c == '_' || c == '-' || c == '+' || c == '\\';
}

/// Of a user or a machine, whatever ssh's own configuration makes of it. What begins with '-' would
/// be an option.
bool is_name(std::string_view text) {
  return !text.empty() && text.front() != '-' && std::ranges::all_of(text, is_of_name);
}

bool is_address(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](char c) { return is_of_name(c) || c == ':' || c == '%'; }) &&
         text.front() != '-';
}

int parse_port(std::string_view whole, std::string_view text) {
  int port = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, port);
  if (error == std::errc() && rest == end && port > 0 && port <= 65535) return port;
  fail(whole, fmt::format("'{}' is no port", text));
}

struct Address {
  std::string_view user, machine, port;
};

Address split_address(std::string_view text) {
  Address address;
  std::string_view rest = text.substr(kSsh.size());
  if (rest.ends_with('/')) rest.remove_suffix(1);
  if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
    address.user = rest.substr(0, at);
    if (!is_name(address.user)) fail(text, fmt::format("'{}' is no user", address.user));
    rest.remove_prefix(at + 1);
  }
  if (rest.starts_with('[')) {  // an address of IPv6
    const std::size_t end = rest.find(']');
    if (end == std::string_view::npos) fail(text, "']' is missing");
    address.machine = rest.substr(1, end - 1);
    rest.remove_prefix(end + 1);
    if (!is_address(address.machine))
      fail(text, fmt::format("'{}' is no address", address.machine));
    if (!rest.empty() && rest.front() != ':') fail(text, "what follows ']' is no port");
    if (!rest.empty()) address.port = rest.substr(1);
    if (!rest.empty() && address.port.empty()) fail(text, "the port is missing");
    return address;
  }
  const std::size_t colon = rest.find(':');
  address.machine = rest.substr(0, colon);
  if (!is_name(address.machine)) {
    fail(text, fmt::format("'{}' is no name of a machine", address.machine));
  }
  if (colon == std::string_view::npos) return address;
  address.port = rest.substr(colon + 1);
  if (address.port.empty()) fail(text, "the port is missing");
  return address;
}

Place ssh_place(std::string_view text, const std::string& program) {
  const Address address = split_address(text);
  Place place;
  place.text = text;
  place.machine = address.user.empty() ? std::string(address.machine)
                                       : fmt::format("{}@{}", address.user, address.machine);
  place.command = {"ssh", "-T", "-o", "BatchMode=yes"};
  if (!address.port.empty()) {
    place.command.insert(place.command.end(),
                         {"-p", std::to_string(parse_port(text, address.port))});
    place.machine += fmt::format(" (port {})", address.port);
  }
  if (!address.user.empty()) {
    place.command.insert(place.command.end(), {"-l", std::string(address.user)});
  }
  place.command.insert(place.command.end(),
                       {"--", std::string(address.machine),
                        core::shell_word(program.empty() ? "stride" : program) + " serve"});
  return place;
}

Place exec_place(std::string_view text, const std::string& program) {
  const std::string command(text.substr(kExec.size()));
  if (!program.empty()) fail(text, "a program is named besides; it belongs into the command");
  if (command.find_first_not_of(" \t\r\n") == std::string::npos) fail(text, "there is no command");
  return {std::string(text), command, {"/bin/sh", "-c", command}};
}

}  // namespace

Place parse_place(std::string_view text, const std::string& program) {
  if (text.find('\0') != std::string_view::npos) fail("…", "it has a NUL in it");
  if (text.starts_with(kSsh)) return ssh_place(text, program);
  if (text.starts_with(kExec)) return exec_place(text, program);
  fail(text, "it is of no kind that is known");
}

}  // namespace stride::remote
