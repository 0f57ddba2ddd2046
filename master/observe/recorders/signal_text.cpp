#include "master/observe/recorders/signal_text.h"

#include <type_traits>

#include "master/base/text/readable_text.h"
#include "master/engine/model/array_element.h"

namespace stride::recorders {

std::string column_name(const core::System& system, core::VariableId id, std::size_t element) {
  return system.prefix(id) + core::element_name(system.variable(id), element);
}

std::string csv_field(std::string_view text) {
  if (!core::is_utf8(text)) return csv_field(core::utf8_text(text));
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field;
  quote_csv(text, [&](char c) { field += c; });
  return field;
}

void write_quoted(core::OutputFile& file, std::string_view text) {
  if (!core::is_utf8(text)) return write_quoted(file, core::utf8_text(text));
  quote_csv(text, [&](char c) { file.write(c); });
}

void write_csv(core::OutputFile& file, const core::ValueBlock& block, std::size_t element) {
  core::visit(block, [&](auto values) {
    const auto& value = values[element];
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::string>) {
      write_quoted(file, value);
    } else if constexpr (std::is_same_v<T, core::Binary>) {
      file.write_hex(value);
    } else if constexpr (std::is_same_v<T, bool>) {
      file.write(value ? std::string_view("true") : std::string_view("false"));
    } else {
      file.write_number(value);
    }
  });
}

}  // namespace stride::recorders
