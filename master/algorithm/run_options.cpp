#include "master/algorithm/run_options.h"

namespace stride::core {

const char* name(Coupling coupling) {
  return coupling == Coupling::Jacobi ? "jacobi" : "gauss-seidel";
}

const char* name(Extrapolation extrapolation) {
  switch (extrapolation) {
    case Extrapolation::Hold:
      return "hold";
    case Extrapolation::Linear:
      return "linear";
    case Extrapolation::Quadratic:
      break;
  }
  return "quadratic";
}

}  // namespace stride::core
