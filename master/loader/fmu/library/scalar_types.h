// The types of FMI 1.0 and of FMI 2.0, as their functions are named.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_SCALAR_TYPES_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_SCALAR_TYPES_H

#include "master/engine/model/description.h"

namespace stride::importer {

/// "Real" of fmi2GetReal.
inline const char* scalar_type_word(core::ValueType type) {
  switch (type) {
    case core::ValueType::Float64:
      return "Real";
    case core::ValueType::Boolean:
      return "Boolean";
    case core::ValueType::String:
      return "String";
    default:
      return "Integer";
  }
}

}  // namespace stride::importer

#endif
