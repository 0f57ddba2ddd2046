// Rows that must not compile, one for each macro. None of them: it compiles.
#include <stride/systemc/module_unit.h>

namespace {

struct Complex {
  double re = 0, im = 0;
  bool operator==(const Complex& other) const { return re == other.re && im == other.im; }
};
std::ostream& operator<<(std::ostream& stream, const Complex& value) { return stream << value.re; }

struct Socket : virtual sc_core::sc_interface {};

struct Chip : sc_core::sc_module {
  sc_core::sc_in<sc_dt::sc_uint<64>> number{"number"};
  sc_core::sc_in<int> count{"count"};
  sc_core::sc_out<bool> ready{"ready"};
  sc_core::sc_out_rv<4> line{"line"};
  sc_core::sc_signal<Complex> phasor{"phasor"};
  sc_core::sc_signal<sc_dt::sc_biguint<65>> key{"key"};
  sc_core::sc_fifo_in<Complex> phasors{"phasors"};
  sc_core::sc_port<Socket> socket{"socket"};
  double charge = 0;
  explicit Chip(sc_core::sc_module_name name) : sc_module(name) {}
};

class ChipUnit : public stride::systemc::ModuleUnit<Chip> {
 public:
  ChipUnit() : ModuleUnit("chip", "A chip") {
    input("number", &Chip::number);
    output("charge", &Chip::charge);
    output("key", &Chip::key);
    idle_when([](const Chip&) { return true; }, stride::systemc::counts_nothing());
#ifdef unknown_type
    output("phasor", &Chip::phasor);
#endif
#ifdef port_of_interface
    output("socket", &Chip::socket);
#endif
#ifdef plain_input
    input("charge_in", &Chip::charge);
#endif
#ifdef input_of_output
    input("ready", &Chip::ready);
#endif
#ifdef input_of_resolved_output
    input(
        "line", [](Chip & chip) -> auto& { return chip.line; });
#endif
#ifdef clock_of_int
    clock(&Chip::count, stride::Duration(1000));
#endif
#ifdef wrong_arguments
    construct(1, 2);
#endif
#ifdef unknown_element
    message_input("phasors.data", &Chip::phasors);
#endif
#ifdef idle_without_edges
    idle_when([](const Chip&) { return true; });
#endif
#ifdef idle_with_something
    idle_when([](const Chip&) { return true; }, 100);
#endif
#ifdef message_to_signal
    message_input("count.data", &Chip::count);
#endif
  }
};

}  // namespace

int main() { ChipUnit unit; }
