#include "master/recorders/vcd_scope.h"

#include <algorithm>

#include <fmt/format.h>

namespace stride::io {
namespace {

using core::ValueType;

/// The dump's word for the type, and its width in bits.
const char* declaration(ValueType type) {
  switch (type) {
    case ValueType::Float32:
    case ValueType::Float64:
      return "real 64";
    case ValueType::Int8:
      return "integer 8";
    case ValueType::Int16:
      return "integer 16";
    case ValueType::Int32:
      return "integer 32";
    case ValueType::Int64:
    case ValueType::Enumeration:
      return "integer 64";
    case ValueType::UInt8:
      return "wire 8";
    case ValueType::UInt16:
      return "wire 16";
    case ValueType::UInt32:
      return "wire 32";
    case ValueType::UInt64:
      return "wire 64";
    case ValueType::Boolean:
      return "wire 1";
    case ValueType::Clock:
      return "event 1";
    case ValueType::String:
    case ValueType::Binary:
      break;
  }
  return "string 1";
}

/// Blanks would end the name.
std::string word(std::string_view name) {
  std::string text(name);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c <= ' ' || c == 127; }, '_');
  return text;
}

}  // namespace

VcdScope& VcdScope::scope(std::string_view name) {
  const std::string wanted = word(name);
  const auto found = std::find_if(scopes_.begin(), scopes_.end(),
                                  [&](const VcdScope& scope) { return scope.name_ == wanted; });
  return found != scopes_.end() ? *found : scopes_.emplace_back(wanted);
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

void VcdScope::write(OutputFile& file) const {
  for (const std::string& variable : variables_) file.write(variable);
  for (const VcdScope& scope : scopes_) {
    file.write(fmt::format("$scope module {} $end\n", scope.name_));
    scope.write(file);
    file.write("$upscope $end\n");
  }
}

}  // namespace stride::io
