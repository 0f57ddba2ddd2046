#include "master/observe/checks/definition.h"

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::checks {

const char* name(Kind kind) {
  switch (kind) {
    case Kind::Always:
      return "always";
    case Kind::Never:
      return "never";
    case Kind::Eventually:
      return "eventually";
    case Kind::Until:
      return "until";
    case Kind::Final:
      return "final";
    case Kind::Count:
      return "count";
    case Kind::Answer:
      break;
  }
  return "answer";
}

std::string Window::text() const {
  std::string text;
  if (from) text += fmt::format(" from {} s", core::to_text(*from));
  if (to) text += fmt::format("{} {} s", from ? " to" : " up to", core::to_text(*to));
  return text;
}

}  // namespace stride::checks
