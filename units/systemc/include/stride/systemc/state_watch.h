// Whether a module stays what it is.
#ifndef STRIDE_SYSTEMC_STATE_WATCH_H
#define STRIDE_SYSTEMC_STATE_WATCH_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <systemc>
#include <vector>

namespace stride::systemc {

/// Compares a module with what it was: its members, with those of the submodules that are members,
/// byte by byte; and all signals that are elsewhere: those that the ports are bound to, and those
/// of submodules that it has made with `new`. What SystemC itself notes in clocks, signals and
/// events does not count. Out of its sight is what else the module has on the heap, and the
/// variables of threads.
class StateWatch {
 public:
  /// To be called in the module's context, when that is elaborated. The module outlives the watch.
  template <class Module>
  explicit StateWatch(const Module& module)
      : StateWatch(module, reinterpret_cast<const unsigned char*>(&module), sizeof(Module)) {}

  /// Whether there has been a change since the last call, or ever before the first one.
  bool has_changed();
  /// The name of the object in which the last change was found, or behind which in the module;
  /// empty before the first change.
  const std::string& place() const { return place_; }

 private:
  struct Range {
    std::size_t begin;
    std::size_t size;
  };
  struct Signal {
    const sc_core::sc_signal_channel* channel;
    std::function<std::uint64_t()> state;
    std::uint64_t before;
  };
  struct Landmark {
    std::size_t offset;
    const sc_core::sc_object* object;
  };

  StateWatch(const sc_core::sc_module& module, const unsigned char* bytes, std::size_t size);
  void add_all(const std::vector<sc_core::sc_object*>& objects);
  void add(const sc_core::sc_object& object);
  /// Blanks this part, if it is one of the module's bytes.
  void ignore(const void* begin, std::size_t size);
  /// size() for what is elsewhere.
  std::size_t offset_of(const void* address) const;
  /// A signal outside of the module has the name of a port that is bound to it.
  std::string name_of(const sc_core::sc_signal_channel& channel) const;
  bool bytes_have_changed();
  bool signals_have_changed();
  std::string place_at(std::size_t offset) const;

  const unsigned char* bytes_;
  std::vector<unsigned char> before_;
  std::vector<unsigned char> present_;
  std::vector<Range> ignored_;
  std::vector<Signal> signals_;
  std::vector<Landmark> landmarks_;
  std::map<const sc_core::sc_signal_channel*, std::string> ports_;
  std::string place_;
};

}  // namespace stride::systemc

#endif
