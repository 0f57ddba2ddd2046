// testbench.cpp - the accelerometer alone, with SystemC and the stimuli of a run of box_drop
//
//   accelerometer_testbench STIMULI.csv
//
// It prints when irq changes, and each shock.
#include <exception>
#include <iomanip>
#include <iostream>
#include <string>

#include <stride/systemc/stimuli_player.h>

#include "accelerometer.h"

using stride::systemc::StimuliPlayer;

/// sc_fifo wants it.
std::ostream& operator<<(std::ostream& stream, const shock& recorded) {
  for (const auto& sample : recorded.sample) stream << ' ' << sample;
  return stream;
}

SC_MODULE(testbench) {
  sc_clock clk{"clk", 1, SC_US};
  sc_signal<bool> rst_n{"rst_n"}, irq{"irq"};
  sc_signal<double> acceleration{"acceleration"};
  sc_signal<sc_int<13>> code{"code"};
  sc_fifo<shock> shocks{"shocks"};
  accelerometer chip;

  testbench(sc_module_name name, double threshold) : sc_module(name), chip("chip", threshold) {
    SC_HAS_PROCESS(testbench);
    chip.clk(clk);
    chip.rst_n(rst_n);
    chip.acceleration(acceleration);
    chip.code(code);
    chip.irq(irq);
    chip.shocks(shocks);
    SC_THREAD(reset);
    SC_THREAD(print_shocks);
    SC_METHOD(print_irq);
    sensitive << irq;
    dont_initialize();
  }

  static std::ostream& say() {
    return std::cout << std::fixed << std::setprecision(6) << sc_time_stamp().to_seconds();
  }

  void reset() {
    wait(10, SC_US);
    rst_n = true;
  }
  void print_irq() { say() << " irq " << irq << '\n'; }
  void print_shocks() {
    for (;;) {
      const shock recorded = shocks.read();
      say() << " shock" << recorded << '\n';
    }
  }
};

int sc_main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "accelerometer_testbench: expected one argument, a file of stimuli\n";
    return 2;
  }
  try {
    StimuliPlayer player(arguments[1]);
    const auto threshold = player.settings().find("threshold");
    const bool is_set = threshold != player.settings().end();
    testbench bench("bench", is_set ? std::stod(threshold->second.front()) : 3);
    player.drive("acceleration", bench.acceleration);
    player.run();
  } catch (const std::exception& error) {
    std::cerr << "accelerometer_testbench: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
