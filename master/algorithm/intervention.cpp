#include "master/algorithm/intervention.h"

#include <fmt/format.h>

#include "master/util/message_text.h"
#include "master/util/time_text.h"

namespace stride::core {
namespace {

const char* word(Intervention::Kind kind) {
  switch (kind) {
    case Intervention::Kind::Set:
      return "set to";
    case Intervention::Kind::Force:
      return "forced to";
    case Intervention::Kind::Hold:
      return "held at";
  }
  return "";
}

}  // namespace

const char* name(Intervention::Kind kind) {
  switch (kind) {
    case Intervention::Kind::Set:
      return "set";
    case Intervention::Kind::Force:
      return "force";
    case Intervention::Kind::Hold:
      return "hold";
  }
  return "";
}

std::string to_text(const Intervention& intervention, const System& system,
                    const ValueBlock& value) {
  constexpr std::size_t kMostElements = 8;
  const Variable& variable = system.variable(intervention.id);
  std::string text = word(intervention.kind);
  for (std::size_t i = 0; i < std::min(value.size(), kMostElements); ++i) {
    text += ' ' + name_text(element_text(value, i));
  }
  if (value.size() > kMostElements) text += " …";
  if (!variable.unit.empty()) text += ' ' + variable.unit;
  if (intervention.until) text += fmt::format(" until {} s", to_text(*intervention.until));
  return text;
}

}  // namespace stride::core
