// A module that is being elaborated, and which of its ports are bound by now.
#ifndef STRIDE_SYSTEMC_ELABORATION_H
#define STRIDE_SYSTEMC_ELABORATION_H

#include <map>
#include <string>
#include <systemc>

#include <stride/systemc/kernel.h>

namespace stride::systemc::detail {

/// What a row of a ModuleUnit takes of a port: all of it, or, of an sc_inout, one direction.
enum class Share { Whole, Input, Output };

/// Lives while a ModuleUnit makes its module.
class Elaboration {
 public:
  Elaboration(Kernel& kernel, sc_core::sc_module& module) : kernel_(kernel), module_(module) {}

  Kernel& kernel() { return kernel_; }
  sc_core::sc_module& module() { return module_; }

  /// Notes that the row binds the port. Returns the channel to which the row of the other direction
  /// has bound it already; null if this row is to make one. Throws std::invalid_argument if the
  /// port's share is taken.
  sc_core::sc_interface* take(const sc_core::sc_object& port, const std::string& row,
                              Share share = Share::Whole);
  /// The channel that the row has made for the port.
  void bound(const sc_core::sc_object& port, sc_core::sc_interface& channel);

 private:
  struct Binding {
    std::map<Share, std::string> rows;
    sc_core::sc_interface* channel = nullptr;
  };
  Kernel& kernel_;
  sc_core::sc_module& module_;
  std::map<const sc_core::sc_object*, Binding> bindings_;
};

/// What to write for a port that SystemC reports as not bound; empty for another report.
std::string hint_of_binding(const std::string& report);

}  // namespace stride::systemc::detail

#endif
