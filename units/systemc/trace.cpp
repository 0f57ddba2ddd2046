#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <unistd.h>

#include <stride/systemc/trace.h>

namespace stride::systemc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".vcd";
constexpr const char* kAdvanceTime = "advanceTime";

/// Absolute, and the same however a file is named.
std::string without_extension(const std::string& path) {
  fs::path file = fs::weakly_canonical(fs::absolute(path));
  if (file.extension() == kExtension) file.replace_extension();
  return file.string();
}

/// Opens the file and locks it against all others that open it so, in any process, until it is
/// unlocked. Returns its descriptor.
int lock_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) {
    throw std::invalid_argument("trace.file: cannot write " + path + ": " + std::strerror(errno));
  }
  if (::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return file;
  ::close(file);
  throw std::invalid_argument("trace.file: another device writes " + path +
                              "; each needs a file of its own");
}

/// By name, for a fork of this process may have the descriptor, too.
void unlock_file(int file) {
  ::flock(file, LOCK_UN);
  ::close(file);
}

std::string names_of(const SignalList& list) {
  std::string names;
  for (const SignalList::Signal& signal : list.signals()) {
    names += (names.empty() ? "" : ", ") + signal.name;
  }
  return names.empty() ? "none" : names;
}

std::vector<const SignalList::Signal*> choose(const SignalList& list, const std::string& patterns) {
  std::set<std::size_t> chosen;
  std::istringstream words(patterns);
  for (std::string pattern; words >> pattern;) {
    bool matches = false;
    for (std::size_t i = 0; i < list.signals().size(); ++i) {
      if (::fnmatch(pattern.c_str(), list.signals()[i].name.c_str(), 0) != 0) continue;
      chosen.insert(i);
      matches = true;
    }
    if (!matches) {
      throw std::invalid_argument("trace.signals: no signal matches \"" + pattern +
                                  "\"; the device has " + names_of(list));
    }
  }
  if (chosen.empty()) throw std::invalid_argument("trace.signals: it names no signal, try \"*\"");
  std::vector<const SignalList::Signal*> signals;
  for (const std::size_t i : chosen) signals.push_back(&list.signals()[i]);
  return signals;
}

}  // namespace

void SignalList::add_named(const sc_core::sc_object& object,
                           std::function<void(sc_core::sc_trace_file*, const std::string&)> trace) {
  const std::string full_name = object.name();
  signals_.push_back({full_name.substr(full_name.find('.') + 1), full_name, std::move(trace)});
}

template <class... T>
void SignalList::add_if_any_of(const sc_core::sc_object& object) {
  const auto add_if = [&](auto* signal) {
    if (signal != nullptr) add_interface(object, *signal);
  };
  (add_if(dynamic_cast<const sc_core::sc_signal_in_if<T>*>(&object)), ...);
}

template <int... Width>
void SignalList::add_if_wide(const sc_core::sc_object& object,
                             std::integer_sequence<int, Width...>) {
  add_if_any_of<sc_dt::sc_uint<Width + 1>..., sc_dt::sc_int<Width + 1>...,
                sc_dt::sc_bv<Width + 1>..., sc_dt::sc_lv<Width + 1>...>(object);
}

void SignalList::add_all_within(const sc_core::sc_object& module) {
  for (const sc_core::sc_object* object : module.get_child_objects()) {
    add_if_any_of<bool, sc_dt::sc_logic, float, double, char, unsigned char, short, unsigned short,
                  int, unsigned int, long, unsigned long, sc_dt::int64, sc_dt::uint64>(*object);
    add_if_wide(*object, std::make_integer_sequence<int, 64>());
    add_all_within(*object);
  }
}

Trace::Trace(Kernel& kernel, const TraceOptions& options, const SignalList& signals)
    : kernel_(kernel) {
  const std::vector<const SignalList::Signal*> chosen = choose(signals, options.signals);
  path_ = without_extension(options.file);
  lock_ = lock_file(path_ + kExtension);
  try {
    kernel_.within([&] { open(chosen); });
  } catch (...) {
    unlock_file(lock_);
    throw;
  }
}

void Trace::open(const std::vector<const SignalList::Signal*>& chosen) {
  file_ = sc_core::sc_create_vcd_trace_file(path_.c_str());
  file_->set_time_unit(1000.0 / static_cast<double>(kernel_.ticks_per_picosecond()),
                       sc_core::SC_FS);
  kernel_.trace_skipped(file_, kAdvanceTime);
  for (const SignalList::Signal* signal : chosen) signal->trace(file_, signal->full_name);
}

Trace::~Trace() {
  kernel_.write_traces();
  try {
    kernel_.within([this] { sc_core::sc_close_vcd_trace_file(file_); });
  } catch (const DeviceError&) {  // a report about a file that is closed by now
  }
  unlock_file(lock_);
}

}  // namespace stride::systemc
