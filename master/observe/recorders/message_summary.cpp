#include "master/observe/recorders/message_summary.h"

#include <type_traits>

#include <fmt/format.h>

#include "master/base/text/counted.h"
#include "master/base/text/readable_text.h"

namespace stride::recorders {
namespace {

template <class T>
std::string brief_text(const T& value) {
  if constexpr (std::is_same_v<T, core::Binary>) {
    return core::counted(value.size(), "byte");
  } else if constexpr (std::is_floating_point_v<T>) {
    return fmt::format("{:.6g}", value);
  } else {
    return fmt::format("{}", value);
  }
}

}  // namespace

std::string message_summary(const core::System& system, const core::Message& message,
                            std::size_t most) {
  if (message.block == nullptr) return {};
  if (!message.content.empty()) return core::readable_text(message.content, most);
  const core::Variable& variable = system.variable(message.id);
  std::string text;
  core::visit(*message.block, [&](auto values) {
    for (const auto& value : values.subspan(message.first, variable.size)) {
      text += (text.empty() ? "" : ", ") + brief_text(value);
      if (text.size() > 4 * most) break;  // no character has more bytes
    }
  });
  if (!variable.unit.empty()) text += " " + variable.unit;
  return core::readable_text(text, most);
}

}  // namespace stride::recorders
