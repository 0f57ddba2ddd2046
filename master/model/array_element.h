// The names of the elements of arrays.
#ifndef STRIDE_MASTER_MODEL_ARRAY_ELEMENT_H
#define STRIDE_MASTER_MODEL_ARRAY_ELEMENT_H

#include <cstddef>
#include <string>

#include "master/model/description.h"

namespace stride::core {

/// The name of an element: that of a scalar variable, else "name[1]" or "name[2,1]", counted from 1
/// in row-major order.
std::string element_name(const Variable& variable, std::size_t element);

}  // namespace stride::core

#endif
