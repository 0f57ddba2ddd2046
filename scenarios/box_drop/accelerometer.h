// accelerometer.h - an accelerometer for one axis, with a threshold interrupt and a FIFO
//
// Each 1000th cycle of clk takes a sample, in 1/256 g, and puts it into the FIFO of 32. One at the
// threshold or beyond it, up or down, raises irq. When 24 more have been taken, the FIFO is written
// to shocks, and irq falls.
#ifndef ACCELEROMETER_H
#define ACCELEROMETER_H

#include <systemc.h>

struct shock {
  sc_int<13> sample[32];  // the oldest first; the eighth has raised irq
};

SC_MODULE(accelerometer) {
  sc_in<bool> clk{"clk"}, rst_n{"rst_n"};
  sc_in<double> acceleration{"acceleration"};  // m/s2, 9.81 at rest
  sc_out<sc_int<13>> code{"code"};             // the last sample
  sc_out<bool> irq{"irq"};
  sc_fifo_out<shock> shocks{"shocks"};

  // threshold: in g
  accelerometer(sc_module_name name, double threshold)
      : sc_module(name), threshold(256 * threshold) {
    SC_HAS_PROCESS(accelerometer);
    SC_METHOD(cycle);
    sensitive << clk.pos();
    dont_initialize();
  }

  void cycle() {
    if (!rst_n) {
      cycles = left = 0;
      irq = false;
    } else if (++cycles == 1000) {
      cycles = 0;
      take(converted());
    }
  }

  int converted() const {
    const double counts = 256 * acceleration / 9.81;
    return counts > 4095    ? 4095
           : counts < -4096 ? -4096
                            : int(counts < 0 ? counts - 0.5 : counts + 0.5);
  }

  void take(int sample) {
    code = sample;
    for (int i = 1; i < 32; ++i) fifo.sample[i - 1] = fifo.sample[i];
    fifo.sample[31] = sample;
    if (left == 0 && (sample >= threshold || -sample >= threshold)) {
      left = 24;
      irq = true;
    } else if (left > 0 && --left == 0) {
      shocks.write(fifo);
      irq = false;
    }
  }

  const double threshold;  // in counts
  shock fifo;
  int cycles = 0, left = 0;  // since the last sample, until the FIFO is written
};

#endif
