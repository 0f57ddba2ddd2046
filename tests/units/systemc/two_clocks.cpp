// A chip with two clocks, and threads that count their edges: nothing of its state can be saved.
// It finishes by itself.
#include <chrono>

#include <stride/systemc/module_unit.h>

namespace {

class TwoClocks : public sc_core::sc_module {
 public:
  sc_core::sc_in<bool> fast{"fast"}, slow{"slow"};
  sc_core::sc_in<int> gain{"gain"};
  sc_core::sc_out<int> fast_edges{"fast_edges"}, slow_edges{"slow_edges"}, sum{"sum"};

  TwoClocks(sc_core::sc_module_name name, int last_edge) : sc_module(name), last_edge_(last_edge) {
    SC_HAS_PROCESS(TwoClocks);
    SC_THREAD(count_fast);
    sensitive << fast.pos();
    SC_THREAD(count_slow);
    sensitive << slow.pos();
  }

 private:
  void count_fast() {
    for (int edges = 1;; ++edges) {
      wait();
      fast_edges.write(edges);
      sum.write(sum.read() + gain.read() * slow_edges.read());
      if (edges == last_edge_) sc_core::sc_stop();
    }
  }
  void count_slow() {
    for (int edges = 1;; ++edges) {
      wait();
      slow_edges.write(edges);
    }
  }
  int last_edge_;
};

class TwoClocksUnit : public stride::systemc::ModuleUnit<TwoClocks> {
 public:
  TwoClocksUnit() : ModuleUnit("chip", "A chip with two clocks") {
    using namespace std::chrono_literals;
    parameter("last_edge", last_edge_).description("of the fast clock; then it has finished");
    construct(last_edge_);
    clock(&TwoClocks::fast, 10ms);
    clock(&TwoClocks::slow, 14ms);
    input("gain", &TwoClocks::gain, 1);
    output("fast_edges", &TwoClocks::fast_edges);
    output("slow_edges", &TwoClocks::slow_edges);
    output("sum", &TwoClocks::sum);
  }

 private:
  int last_edge_ = 1'000'000'000;
};

}  // namespace

STRIDE_UNIT(TwoClocksUnit)
