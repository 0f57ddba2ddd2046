#include "master/study/compare/criteria/difference.h"

namespace stride::compare {

const char* name(Kind kind) {
  switch (kind) {
    case Kind::Message:
      return "message";
    case Kind::Event:
      return "event";
    case Kind::Signal:
      return "signal";
    case Kind::Coverage:
      return "coverage";
    case Kind::Check:
      return "check";
    case Kind::Verdict:
      return "verdict";
    case Kind::Outcome:
      return "outcome";
    case Kind::File:
      break;
  }
  return "file";
}

}  // namespace stride::compare
