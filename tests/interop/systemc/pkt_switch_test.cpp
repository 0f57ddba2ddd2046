// A packet switch of four ports between senders and receivers, with two clocks. Its packets are
// structs, it counts in globals, and it finishes by itself.
#define sc_main design_main
#include "sysc/pkt_switch/main.cpp"
#undef sc_main

#include <string>

#include <catch2/catch.hpp>

#include "tests/interop/systemc/network.h"

using stride::tests::kNanosecond;
using stride::tests::Network;
using stride::tests::Rows;
using stride::tests::UnitDriver;

/// The senders begin their random numbers with the time of day; the linker puts this in the place
/// of srand().
extern "C" void __wrap_srand(unsigned) {}

template <>
struct stride::systemc::Conversion<pkt> {
  using Fmi = std::string;
  static Fmi to_fmi(const pkt& packet) {
    return std::to_string(packet.id) + ": " + std::to_string(packet.data);
  }
  static pkt from_fmi(const Fmi&) { return {}; }
  static void describe(VariableBuilder&) {}
};

namespace {

/// The lines of sc_main.
struct Board : sc_module {
  sc_signal<pkt> in[4], out[4];
  sc_signal<sc_int<4>> id[4];
  sc_signal<bool> control;
  sc_clock clock1{"CLOCK1", 75, SC_NS, 0.5, 0.0, SC_NS};
  sc_clock clock2{"CLOCK2", 30, SC_NS, 0.5, 10.0, SC_NS};
  sender senders[4]{sender("SENDER0"), sender("SENDER1"), sender("SENDER2"), sender("SENDER3")};
  switch_clk divider{"SWITCH_CLK"};
  mcast_pkt_switch crossbar{"SWITCH"};
  receiver receivers[4]{receiver("RECEIVER0"), receiver("RECEIVER1"), receiver("RECEIVER2"),
                        receiver("RECEIVER3")};

  explicit Board(sc_module_name name) : sc_module(name) {
    for (int i = 0; i < 4; ++i) {
      senders[i](in[i], id[i], clock1);
      receivers[i](out[i], id[i]);
    }
    divider.switch_cntrl(control);
    divider.CLK(clock2);
    crossbar(control, in[0], in[1], in[2], in[3], out[0], out[1], out[2], out[3]);
  }
};

void run_as_unit() {
  Network network;
  UnitDriver& board = network.add<Board>([](Rows<Board>& rows) {
    for (int i = 0; i < 4; ++i) {
      rows.input(
          "id" + std::to_string(i), [i](Board & b) -> auto& { return b.id[i]; },
          static_cast<std::int8_t>(i));
      rows.output(
          "in" + std::to_string(i), [i](Board & b) -> auto& { return b.in[i]; });
    }
  });
  network.initialize();
  while (network.step(10 * kNanosecond)) continue;
  std::cout << board.value<std::string>("in0");
}

/// Without what SystemC says about sc_stop(), in the middle; a unit sends it to its log.
std::string without_stop(std::string text) {
  const std::string report = "\nInfo: /OSCI/SystemC: Simulation stopped by user.\n";
  const std::size_t at = text.find(report);
  REQUIRE(at != std::string::npos);
  return text.erase(at, report.size());
}

/// The last one that the first sender reports, as the Conversion has it.
std::string last_packet(const std::string& text) {
  const std::string last = "\nSender ID: 1\n", value = "Packet Value: ";
  const std::size_t packet = text.rfind(value, text.rfind(last));
  REQUIRE(packet != std::string::npos);
  return "0: " + std::to_string(std::stoi(text.substr(packet + value.size())));
}

}  // namespace

TEST_CASE("the packet switch") {
  const std::string expected = stride::tests::printed_apart([] { design_main(0, nullptr); });
  CHECK(expected.find("Total number of packets received") != std::string::npos);
  const std::string own = without_stop(expected);
  for (int life = 0; life < 2; ++life) {
    CHECK(stride::tests::printed_apart(run_as_unit) == own + last_packet(own));
  }
}
