#include <stdexcept>

#include <stride/systemc/message.h>

namespace stride::systemc::detail {

std::string MessageRow::clock_name() const {
  const std::size_t dot = name_.rfind('.');
  if (dot != std::string::npos) return name_.substr(0, dot) + ".clock";
  throw std::invalid_argument("the message " + name_ + " needs a name with a dot, such as " +
                              name_ + ".data: its clock is then called " + name_ + ".clock");
}

}  // namespace stride::systemc::detail
