// Modules with sockets of TLM-2.0 as units.
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <tlm>
#include <vector>

#include <catch2/catch.hpp>
#include <tlm_utils/tlm_quantumkeeper.h>

#include <stride/systemc/time.h>
#include <stride/systemc/tlm_unit.h>

#include "tests/units/systemc/times.h"
#include "tests/units/systemc/unit_driver.h"

using Catch::Matchers::Contains;
using stride::Binary;
using stride::Clock;
using stride::Duration;
using stride::Time;
using stride::systemc::Access;
using stride::systemc::decode_transaction;
using stride::systemc::Register;
using stride::systemc::TlmUnit;
using stride::systemc::Transaction;
using stride::tests::at;
using stride::tests::kMicrosecond;
using stride::tests::kNanosecond;
using stride::tests::UnitDriver;
using Command = Transaction::Command;
using Status = Transaction::Status;

namespace {

/// Adds up what is written to address 0; the sum is at 4, the count of writes at 8. A write takes
/// 100 ns, a read 50 ns.
class Adder : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<Adder> socket{"socket"};
  explicit Adder(sc_core::sc_module_name name) : sc_module(name) {
    socket.register_b_transport(this, &Adder::transport);
    socket.register_transport_dbg(this, &Adder::debug);
  }

 private:
  void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    delay += sc_core::sc_time(payload.is_write() ? 100 : 50, sc_core::SC_NS);
    if (payload.get_address() > 8) {
      return payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
    }
    if (payload.is_read()) {
      debug(payload);
    } else {
      std::uint32_t number = 0;
      std::memcpy(&number, payload.get_data_ptr(), 4);
      words_[1] += number;
      ++words_[2];
    }
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
  }
  unsigned debug(tlm::tlm_generic_payload& payload) {
    if (payload.get_address() > 8) return 0;
    std::memcpy(payload.get_data_ptr(), &words_[payload.get_address() / 4],
                payload.get_data_length());
    return payload.get_data_length();
  }
  std::uint32_t words_[3] = {};
};

/// Copies the word at address 0 to address 4, adds 1, and does so again after 1 us; or, decoupled,
/// counts accesses of 10 ns each.
class Copier : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<Copier> socket{"socket"};
  sc_core::sc_out<int> copies{"copies"};
  std::vector<sc_core::sc_time> synchronized;

  Copier(sc_core::sc_module_name name, bool is_decoupled) : sc_module(name) {
    SC_HAS_PROCESS(Copier);
    if (is_decoupled) {
      SC_THREAD(run_ahead);
    } else {
      SC_THREAD(copy);
    }
  }

 private:
  tlm::tlm_response_status access(tlm::tlm_command command, unsigned address, std::uint32_t& word,
                                  sc_core::sc_time& delay) {
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
    payload.set_data_length(4);
    payload.set_streaming_width(4);
    socket->b_transport(payload, delay);
    return payload.get_response_status();
  }
  void copy() {
    std::uint32_t word = 0;
    for (;; wait(1, sc_core::SC_US)) {
      sc_core::sc_time delay;
      const auto status = access(tlm::TLM_READ_COMMAND, 0, word, delay);
      if (status != tlm::TLM_OK_RESPONSE) continue;
      ++word;
      access(tlm::TLM_WRITE_COMMAND, 4, word, delay);
      wait(delay);
      copies.write(copies.read() + 1);
    }
  }
  void run_ahead() {
    tlm_utils::tlm_quantumkeeper keeper;
    keeper.reset();
    for (std::uint32_t word = 0;;) {
      sc_core::sc_time delay = keeper.get_local_time();
      access(tlm::TLM_READ_COMMAND, 0, word, delay);
      keeper.set(delay);
      copies.write(copies.read() + 1);
      if (!keeper.need_sync()) continue;
      keeper.sync();
      synchronized.push_back(sc_core::sc_time_stamp());
    }
  }
};

template <class Module>
class TlmRows : public TlmUnit<Module> {
 public:
  template <class Function>
  explicit TlmRows(Function list) : TlmUnit<Module>("device", "A device") {
    list(*this);
  }
  using TlmUnit<Module>::construct;
  using TlmUnit<Module>::memory;
  using TlmUnit<Module>::output;
  using TlmUnit<Module>::quantum;
  using TlmUnit<Module>::registers;
  using TlmUnit<Module>::transactions;
};

template <class Module, class Function>
UnitDriver tlm_driver_of(Function list) {
  return UnitDriver(std::make_unique<TlmRows<Module>>(list));
}

UnitDriver adder(const std::vector<Register>& registers) {
  return tlm_driver_of<Adder>(
      [&](TlmRows<Adder>& rows) { rows.registers("bus", &Adder::socket, registers); });
}

UnitDriver copier(std::size_t size) {
  return tlm_driver_of<Copier>([=](TlmRows<Copier>& rows) {
    rows.construct(false);
    rows.memory("ram", &Copier::socket, size, 10 * kNanosecond, Binary{41});
    rows.output("copies", &Copier::copies);
  });
}

void send(UnitDriver& unit, const std::string& name, const Transaction& transaction) {
  unit.value<Binary>(name + ".data") = encode(transaction);
  unit.value<Clock>(name + ".clock").tick();
  unit.event();
  unit.value<Clock>(name + ".clock").clear();
}

/// What has ticked just now.
Transaction taken(UnitDriver& unit, const std::string& name) {
  REQUIRE(unit.value<Clock>(name + ".clock").ticked());
  unit.value<Clock>(name + ".clock").clear();
  return decode_transaction(unit.value<Binary>(name + ".data"));
}

}  // namespace

TEST_CASE("registers are variables") {
  UnitDriver unit = adder({{"add", 0, Access::Write}, {"sum", 4}, {"writes", 8, Access::Read, 2}});
  CHECK(unit.row("bus.add").type == stride::Type::UInt32);
  CHECK(unit.row("bus.writes").type == stride::Type::UInt16);
  const auto sum = [&] { return unit.value<std::uint32_t>("bus.sum"); };
  unit.initialize();
  unit.step(at(kMicrosecond));
  CHECK(unit.value<std::uint16_t>("bus.writes") == 0);  // 0 is not written by itself
  unit.value<std::uint32_t>("bus.add") = 30;
  unit.step(at(2 * kMicrosecond));
  CHECK(sum() == 30);
  unit.step(at(3 * kMicrosecond));
  unit.value<std::uint32_t>("bus.add") = 12;
  unit.step(at(4 * kMicrosecond));
  CHECK(sum() == 42);
  CHECK(unit.value<std::uint16_t>("bus.writes") == 2);
  unit.initialize();  // with a register that is not 0
  CHECK(sum() == 12);
}

TEST_CASE("mistakes with registers are errors") {
  UnitDriver beyond = adder({{"none", 12}});
  CHECK_THROWS_WITH(beyond.initialize(),
                    Contains("bus.none") && Contains("address 12") && Contains("transactions()"));
  UnitDriver wrong = adder({{"none", 16, Access::Write}});
  wrong.value<std::uint32_t>("bus.none") = 1;
  const auto run = [&] {
    wrong.initialize();
    wrong.step(at(kMicrosecond));
  };
  CHECK_THROWS_WITH(run(), Contains("bus.none") && Contains("TLM_ADDRESS_ERROR_RESPONSE"));
  CHECK_THROWS_WITH(adder({{"odd", 0, Access::Read, 3}}), Contains("odd has 3 bytes"));
  UnitDriver open = tlm_driver_of<Adder>([](TlmRows<Adder>&) {});
  CHECK_THROWS_WITH(open.initialize(), Contains("device.socket") && Contains("registers()"));
  UnitDriver idle = tlm_driver_of<Copier>([](TlmRows<Copier>& rows) {
    rows.construct(false);
    rows.output("copies", &Copier::copies);
  });
  CHECK_THROWS_WITH(idle.initialize(), Contains("device.socket") && Contains("memory()"));
}

TEST_CASE("transactions come as messages, and their responses leave where they have ended") {
  UnitDriver unit =
      tlm_driver_of<Adder>([](TlmRows<Adder>& rows) { rows.transactions("bus", &Adder::socket); });
  unit.initialize();
  send(unit, "bus.request", {Command::Write, Status::Incomplete, 0, 4, {42, 1, 0, 0}});
  CHECK(unit.step(at(kMicrosecond), true) == at(100 * kNanosecond));
  CHECK(taken(unit, "bus.response").status == Status::Ok);

  send(unit, "bus.request", {Command::Read, Status::Incomplete, 4, 4, {}});
  CHECK(unit.step(at(kMicrosecond), true) == at(150 * kNanosecond));
  const Transaction response = taken(unit, "bus.response");
  CHECK(response.data == Binary{42, 1, 0, 0});
  CHECK(response.address == 4);
  send(unit, "bus.request", {Command::Read, Status::Incomplete, 16, 4, {}});
  unit.step(at(kMicrosecond), true);
  CHECK(taken(unit, "bus.response").status == Status::AddressError);
  CHECK_THROWS_WITH(decode_transaction({1, 2, 3}), Contains("3 bytes is no transaction"));
}

TEST_CASE("an initiator has a memory in the unit") {
  UnitDriver unit = copier(8);
  for (int life = 0; life < 2; ++life) {
    unit.initialize();
    CHECK(unit.value<int>("copies") == 0);
    unit.step(at(20 * kNanosecond));
    CHECK(unit.value<int>("copies") == 1);
  }
  UnitDriver small = copier(0);  // its content has one byte
  small.initialize();
  small.step(at(20 * kMicrosecond));
  CHECK(small.value<int>("copies") == 0);
}

TEST_CASE("a memory is accessed directly, and refuses at once what is beyond it") {
  struct Prober : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Prober> socket{"socket"};
    tlm::tlm_dmi direct;
    bool is_direct = false, is_hinted = false;
    sc_core::sc_time taken, refused;
    explicit Prober(sc_core::sc_module_name name) : sc_module(name) {
      SC_HAS_PROCESS(Prober);
      SC_THREAD(probe);
    }
    void read(unsigned address, sc_core::sc_time& delay, tlm::tlm_generic_payload& payload) {
      unsigned char byte = 0;
      payload.set_read();
      payload.set_address(address);
      payload.set_data_ptr(&byte);
      payload.set_data_length(1);
      payload.set_streaming_width(1);
      socket->b_transport(payload, delay);
    }
    void probe() {
      tlm::tlm_generic_payload payload;
      read(8, refused, payload);
      read(7, taken, payload);
      is_hinted = payload.is_dmi_allowed();
      is_direct = socket->get_direct_mem_ptr(payload, direct);
    }
  };
  const Prober* prober = nullptr;
  const auto with = [&](std::size_t size) {
    return tlm_driver_of<Prober>([&](TlmRows<Prober>& rows) {
      rows.memory("ram", &Prober::socket, size, 10 * kNanosecond, Binary(size, 41));
      rows.output("found", [&prober](const Prober& module) {
        prober = &module;
        return true;
      });
    });
  };
  const sc_core::sc_time latency(10, sc_core::SC_NS);
  UnitDriver some = with(8);
  some.initialize();
  CHECK(prober->refused == sc_core::SC_ZERO_TIME);
  CHECK(prober->taken == latency);
  CHECK(prober->is_hinted);
  REQUIRE(prober->is_direct);
  CHECK(prober->direct.is_read_write_allowed());
  CHECK(prober->direct.get_start_address() == 0);
  CHECK(prober->direct.get_end_address() == 7);
  CHECK(prober->direct.get_dmi_ptr()[7] == 41);
  CHECK(prober->direct.get_read_latency() == latency);
  CHECK(prober->direct.get_write_latency() == latency);
  UnitDriver none = with(0);
  none.initialize();
  CHECK_FALSE(prober->is_direct);
}

TEST_CASE("the transactions of an initiator leave as messages, and end with the response") {
  UnitDriver unit = tlm_driver_of<Copier>([](TlmRows<Copier>& rows) {
    rows.construct(false);
    rows.transactions("bus", &Copier::socket);
    rows.output("copies", &Copier::copies);
  });
  unit.initialize();
  CHECK(unit.step(at(kMicrosecond), true) == at(Duration(0)));
  Transaction request = taken(unit, "bus.request");
  CHECK(request.command == Command::Read);
  CHECK(request.size == 4);
  CHECK(unit.step(at(kMicrosecond), true) == at(kMicrosecond));  // it waits

  request.status = Status::Ok;
  request.data = {9, 0, 0, 0};
  send(unit, "bus.response", request);
  request = taken(unit, "bus.request");
  CHECK(request.command == Command::Write);
  CHECK(request.address == 4);
  CHECK(request.data == Binary{10, 0, 0, 0});
  request.status = Status::Ok;
  send(unit, "bus.response", request);
  CHECK(unit.value<int>("copies") == 1);
  CHECK_THROWS_WITH(send(unit, "bus.response", request), Contains("no transaction waits"));
}

TEST_CASE("an initiator runs ahead up to its quantum, and never beyond a step") {
  const auto synchronized = [](Duration quantum, const std::vector<int>& ends) {
    std::vector<sc_core::sc_time> times;
    auto unit = tlm_driver_of<Copier>([&](TlmRows<Copier>& rows) {
      rows.construct(true);
      rows.memory("ram", &Copier::socket, 8, 10 * kNanosecond);
      rows.quantum(quantum);
      rows.output("copies", &Copier::copies);
      rows.output("times", [&times](const Copier& copier) {
        times = copier.synchronized;
        return static_cast<int>(times.size());
      });
    });
    unit.initialize();
    for (const int end : ends) unit.step(at(end * kNanosecond));
    return times;
  };
  CHECK(synchronized(Duration{}, {100}).size() == 10);
  const auto whole = synchronized(kMicrosecond, {1000, 2000});
  REQUIRE(whole.size() >= 2);
  CHECK(whole.back() == sc_core::sc_time(2, sc_core::SC_US));
  CHECK(whole.size() < 20);
}

TEST_CASE("a quantum divides both ends of a step") {
  using stride::systemc::detail::quantum_within;
  CHECK(quantum_within(Duration(0), Duration(1000), Duration(5000)) == Duration(1000));
  CHECK(quantum_within(Duration(0), Duration(1000), Duration(300)) == Duration(250));
  CHECK(quantum_within(Duration(1000), Duration(600), Duration(5000)) == Duration(200));
  CHECK(quantum_within(Duration(0), Duration(999'983), Duration(10)) == Duration(1));
}
