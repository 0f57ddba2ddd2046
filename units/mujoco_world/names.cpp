#include "units/mujoco_world/names.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace mujoco_world {
namespace {

bool is_identifier(const std::string& name) {
  const auto is_word = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) &&
         std::all_of(name.begin(), name.end(), is_word);
}

}  // namespace

std::string name_part(const std::string& name) {
  if (is_identifier(name)) return name;
  const auto is_allowed = [](char c) { return c >= ' ' && c <= '~' && c != '`'; };
  if (!std::all_of(name.begin(), name.end(), is_allowed)) {
    throw std::runtime_error("the name '" + name +
                             "' cannot be a part of an FMI variable's: give it printable ASCII "
                             "characters only, and no `, in the MJCF");
  }
  std::string quoted = "'";
  for (const char c : name) {
    if (c == '\'' || c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

}  // namespace mujoco_world
