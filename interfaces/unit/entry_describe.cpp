// The exported function of <stride/describe.h>.
#include <algorithm>

#include "interfaces/unit/entry_call.h"

using stride::kit::call;
using stride::kit::Function;
using stride::kit::Instance;

fmi3Status strideDescribeMessage(fmi3Instance instance, fmi3ValueReference variable,
                                 const fmi3Byte value[], size_t size, char text[], size_t capacity,
                                 size_t* text_size) {
  return call(instance, Function::DescribeMessage, [&](const Instance& unit) {
    const std::string line = unit.describe_message(variable, value, size, capacity);
    std::copy(line.begin(), line.end(), text);
    *text_size = line.size();
    return line.empty() ? fmi3Discard : fmi3OK;
  });
}
