#include "master/engine/run/context/intervention.h"

#include <fmt/format.h>

#include "master/base/message_text.h"
#include "master/base/text/counted.h"
#include "master/base/time_text.h"

namespace stride::core {
namespace {

struct Words {
  const char* name;
  const char* effect;
};

Words words(Intervention::Kind kind) {
  switch (kind) {
    case Intervention::Kind::Set:
      return {"set", "set to"};
    case Intervention::Kind::Force:
      return {"force", "forced to"};
    case Intervention::Kind::Hold:
      return {"hold", "held at"};
    case Intervention::Kind::Drop:
      return {"drop", "messages are dropped"};
    case Intervention::Kind::Delay:
      return {"delay", "messages are delayed by"};
    case Intervention::Kind::Corrupt:
      return {"corrupt", "messages are received with wrong bits,"};
  }
  return {"", ""};
}

std::string until_text(const Intervention& intervention) {
  if (!intervention.until) return "";
  return fmt::format(" until {} s", to_text(*intervention.until));
}

}  // namespace

bool disturbs_messages(Intervention::Kind kind) {
  return kind == Intervention::Kind::Drop || kind == Intervention::Kind::Delay ||
         kind == Intervention::Kind::Corrupt;
}

const char* name(Intervention::Kind kind) { return words(kind).name; }

std::string amount_text(const Intervention& intervention) {
  if (intervention.kind == Intervention::Kind::Delay) {
    return fmt::format("{} s", to_text(intervention.delay));
  }
  if (intervention.kind == Intervention::Kind::Corrupt) {
    const std::string bits = counted(intervention.bits, "bit");
    if (intervention.header == 0) return bits;
    return fmt::format("{} after a header of {}", bits, counted(intervention.header, "byte"));
  }
  return intervention.value ? elements_text(*intervention.value) : "";
}

std::string to_text(const Intervention& intervention, const System& system,
                    const ValueBlock& value) {
  constexpr std::size_t kMostElements = 8;
  const Variable& variable = system.variable(intervention.id);
  std::string text = words(intervention.kind).effect;
  for (std::size_t i = 0; i < std::min(value.size(), kMostElements); ++i) {
    text += ' ' + name_text(element_text(value, i));
  }
  if (value.size() > kMostElements) text += " …";
  if (!variable.unit.empty()) text += ' ' + variable.unit;
  return text + until_text(intervention);
}

std::string to_text(const Intervention& intervention) {
  const std::string amount = amount_text(intervention);
  return words(intervention.kind).effect + (amount.empty() ? "" : ' ' + amount) +
         until_text(intervention);
}

}  // namespace stride::core
