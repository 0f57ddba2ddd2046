#include <algorithm>
#include <array>
#include <stdexcept>

#include <stride/systemc/elaboration.h>

namespace stride::systemc::detail {
namespace {

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// Of "… port 'device.a' (sc_in)"; all of the report if it has no such words.
std::string kind_in(const std::string& report) {
  const std::size_t end = report.find("' (");
  if (end == std::string::npos) return report;
  const std::string kind = report.substr(end, report.find(')', end) - end);
  // "device.socket_port_0" is the way back from a target socket to its initiator
  const std::size_t dot = report.rfind('.', end);
  const std::size_t suffix = report.rfind("_port_", end);
  const bool is_way_back = suffix != std::string::npos && suffix > dot + 1;
  return is_way_back && contains(kind, "sc_port") ? "target_socket" : kind;
}

struct Advice {
  const char* kind;  ///< part of what SystemC calls the port
  const char* rows;
};
constexpr std::array kAdvices = {
    Advice{"fifo_in", "it needs a message_input()"},
    Advice{"fifo_out", "it needs a message_output()"},
    Advice{"initiator_socket",
           "it needs a memory() or a transactions() of TlmUnit (<stride/systemc/tlm_unit.h>)"},
    Advice{"target_socket",
           "it needs registers() or a transactions() of TlmUnit (<stride/systemc/tlm_unit.h>)"},
    Advice{"sc_inout", "it needs an input(), an output(), both, or tie()"},
    Advice{"sc_in", "it needs an input(), clock(), reset() or tie()"},
    Advice{"sc_out", "it needs an output() or tie()"},
    Advice{"sc_port",
           "it needs a bind(&Module::port, adapter), where the adapter is a channel with "
           "the port's interface"},
};

}  // namespace

sc_core::sc_interface* Elaboration::take(const sc_core::sc_object& port, const std::string& row,
                                         Share share) {
  Binding& binding = bindings_[&port];
  const bool is_free =
      std::all_of(binding.rows.begin(), binding.rows.end(), [share](const auto& other) {
        return share != Share::Whole && other.first != Share::Whole && other.first != share;
      });
  if (!is_free) {
    throw std::invalid_argument(std::string("the port ") + port.name() + " has two rows, " +
                                binding.rows.begin()->second + " and " + row + "; it takes one");
  }
  binding.rows.emplace(share, row);
  return binding.channel;
}

void Elaboration::bound(const sc_core::sc_object& port, sc_core::sc_interface& channel) {
  bindings_[&port].channel = &channel;
}

std::string hint_of_binding(const std::string& report) {
  if (contains(report, "resolved port not bound")) {
    return "; it is a port within the module, of which the outer port is not resolved: bind() the "
           "outer one to an sc_signal_resolved or sc_signal_rv of yours";
  }
  if (!contains(report, "not bound") && !contains(report, "actual binds")) return "";
  const std::string kind = kind_in(report);
  for (const Advice& advice : kAdvices) {
    if (contains(kind, advice.kind)) {
      return std::string("; ") + advice.rows +
             "; inner<T>(\"name\") names a port that is not a member, or within a submodule";
    }
  }
  return "; each port needs a row, see the table of ports in docs/wrap-systemc.md";
}

}  // namespace stride::systemc::detail
