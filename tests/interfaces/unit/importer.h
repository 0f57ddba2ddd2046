// A small importer for the tests of the unit kit: a library's entry table and an instance.
#ifndef STRIDE_TESTS_INTERFACES_UNIT_IMPORTER_H
#define STRIDE_TESTS_INTERFACES_UNIT_IMPORTER_H

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <dlfcn.h>

#include <stride/describe.h>
#include <stride/fmi3.h>
#include <stride/idle.h>
#include <stride/self_description.h>

namespace stride::tests {

class UnitLibrary {
 public:
  explicit UnitLibrary(const std::string& path) : handle_(dlopen(path.c_str(), RTLD_NOW)) {
    if (handle_ == nullptr) throw std::runtime_error(dlerror());
#define RESOLVE(name) name = reinterpret_cast<fmi3##name##TYPE*>(symbol("fmi3" #name));
    FMI3_FUNCTIONS(RESOLVE)
#undef RESOLVE
#define RESOLVE(name) name = reinterpret_cast<stride##name##TYPE*>(symbol("stride" #name));
    STRIDE_IDLE_FUNCTIONS(RESOLVE)
    STRIDE_DESCRIBE_FUNCTIONS(RESOLVE)
#undef RESOLVE
  }
  ~UnitLibrary() { dlclose(handle_); }
  UnitLibrary(const UnitLibrary&) = delete;
  UnitLibrary& operator=(const UnitLibrary&) = delete;

  std::string describe(const std::string& resources = "") const {
    return self_description<strideModelDescriptionTYPE>("strideModelDescription", resources);
  }
  std::string idle_manifest() const {
    return self_description<strideIdleManifestTYPE>("strideIdleManifest", "");
  }

#define POINTER(name) fmi3##name##TYPE* name = nullptr;
  FMI3_FUNCTIONS(POINTER)
#undef POINTER
#define POINTER(name) stride##name##TYPE* name = nullptr;
  STRIDE_IDLE_FUNCTIONS(POINTER)
  STRIDE_DESCRIBE_FUNCTIONS(POINTER)
#undef POINTER

 private:
  template <class Function>
  std::string self_description(const char* name, const std::string& resources) const {
    auto* function = reinterpret_cast<Function*>(symbol(name));
    const char* error = "";
    const char* text = function(resources.empty() ? nullptr : resources.c_str(), &error);
    if (text == nullptr) throw std::runtime_error(error);
    return text;
  }
  void* symbol(const char* name) const {
    void* found = dlsym(handle_, name);
    if (found == nullptr) throw std::runtime_error(name);
    return found;
  }
  void* handle_;
};

/// The value of an attribute in the element that contains `anchor`.
inline std::string attribute(const std::string& xml, const std::string& anchor,
                             const std::string& name) {
  const std::size_t inside = xml.find(anchor);
  if (inside == std::string::npos) throw std::runtime_error("no " + anchor + " in the description");
  const std::size_t end = xml.find('>', inside);
  const std::string element = xml.substr(xml.rfind('<', inside), end - xml.rfind('<', inside));
  const std::string key = " " + name + "=\"";
  const std::size_t at = element.find(key);
  if (at == std::string::npos) return "";
  const std::size_t first = at + key.size();
  return element.substr(first, element.find('"', first) - first);
}

struct InstanceChoices {
  bool event_mode = true;
  bool early_return = false;
  bool logging = false;
  std::string resources = "";
  std::string token = "";                 ///< empty: the right one
  std::vector<std::string> intermediate;  ///< the variables that it sets within steps
};

class UnitInstance {
 public:
  explicit UnitInstance(const UnitLibrary& library, const InstanceChoices& choices = {})
      : fmi(library), xml_(library.describe(choices.resources)) {
    const std::string right = attribute(xml_, "<fmiModelDescription", "instantiationToken");
    std::vector<fmi3ValueReference> intermediate;
    for (const std::string& name : choices.intermediate) intermediate.push_back(reference(name));
    handle = fmi.InstantiateCoSimulation(
        "unit", (choices.token.empty() ? right : choices.token).c_str(),
        choices.resources.empty() ? nullptr : choices.resources.c_str(), false, choices.logging,
        choices.event_mode, choices.early_return, intermediate.data(), intermediate.size(), this,
        &on_log, &on_update);
  }
  ~UnitInstance() {
    if (handle != nullptr) fmi.FreeInstance(handle);
  }
  UnitInstance(const UnitInstance&) = delete;
  UnitInstance& operator=(const UnitInstance&) = delete;

  fmi3ValueReference reference(const std::string& name) const {
    const std::string number = attribute(xml_, "name=\"" + name + "\"", "valueReference");
    return static_cast<fmi3ValueReference>(std::stoul(number));
  }

  fmi3Status initialize(double start = 0, double stop = -1) {
    const fmi3Status entered =
        fmi.EnterInitializationMode(handle, false, 0, start, stop >= 0, stop);
    return entered == fmi3OK ? fmi.ExitInitializationMode(handle) : entered;
  }
  fmi3Status start_steps(double start = 0, double stop = -1) {
    if (initialize(start, stop) != fmi3OK) return fmi3Error;
    update();
    return fmi.EnterStepMode(handle);
  }

  struct Step {
    bool event = false, terminate = false, early = false;
    double reached = -1;
  };
  fmi3Status step(double point, double size) {
    last = {};
    return fmi.DoStep(handle, point, size, true, &last.event, &last.terminate, &last.early,
                      &last.reached);
  }
  fmi3Status update() {
    bool nominals = false, values = false;
    return fmi.UpdateDiscreteStates(handle, &iterate, &terminate, &nominals, &values,
                                    &has_next_event, &next_event);
  }

  double real(const std::string& name) { return read<double>(fmi.GetFloat64, name); }
  std::int32_t integer(const std::string& name) { return read<std::int32_t>(fmi.GetInt32, name); }
  fmi3Status set_real(const std::string& name, double value) {
    const fmi3ValueReference r = reference(name);
    return fmi.SetFloat64(handle, &r, 1, &value, 1);
  }
  fmi3Status set_boolean(const std::string& name, bool value) {
    const fmi3ValueReference r = reference(name);
    return fmi.SetBoolean(handle, &r, 1, &value, 1);
  }
  fmi3Status set_binary(const std::string& name, const std::vector<fmi3Byte>& bytes) {
    const fmi3ValueReference r = reference(name);
    const fmi3Binary value = bytes.data();
    const std::size_t size = bytes.size();
    return fmi.SetBinary(handle, &r, 1, &size, &value, 1);
  }
  fmi3Status set_clock(const std::string& name, bool value) {
    const fmi3ValueReference r = reference(name);
    return fmi.SetClock(handle, &r, 1, &value);
  }
  bool clock(const std::string& name) {
    const fmi3ValueReference r = reference(name);
    bool value = false;
    if (fmi.GetClock(handle, &r, 1, &value) != fmi3OK) throw std::runtime_error(last_message());
    return value;
  }
  struct Interval {
    double seconds = -1;
    fmi3UInt64 counter = 0, resolution = 0;
    fmi3IntervalQualifier qualifier = fmi3IntervalNotYetKnown;
  };
  /// By the decimal function; counter and resolution stay 0.
  Interval interval(const std::string& clock) {
    const fmi3ValueReference r = reference(clock);
    Interval said;
    if (fmi.GetIntervalDecimal(handle, &r, 1, &said.seconds, &said.qualifier) != fmi3OK) {
      throw std::runtime_error(last_message());
    }
    return said;
  }
  Interval interval_fraction(const std::string& clock) {
    const fmi3ValueReference r = reference(clock);
    Interval said;
    if (fmi.GetIntervalFraction(handle, &r, 1, &said.counter, &said.resolution, &said.qualifier) !=
        fmi3OK) {
      throw std::runtime_error(last_message());
    }
    return said;
  }
  double shift(const std::string& clock) {
    const fmi3ValueReference r = reference(clock);
    double seconds = -1;
    if (fmi.GetShiftDecimal(handle, &r, 1, &seconds) != fmi3OK) {
      throw std::runtime_error(last_message());
    }
    return seconds;
  }
  fmi3Status set_interval(const std::string& clock, double seconds) {
    const fmi3ValueReference r = reference(clock);
    return fmi.SetIntervalDecimal(handle, &r, 1, &seconds);
  }
  fmi3Status set_shift(const std::string& clock, double seconds) {
    const fmi3ValueReference r = reference(clock);
    return fmi.SetShiftDecimal(handle, &r, 1, &seconds);
  }
  /// Until when the unit promises to be idle [s].
  double idle_until() {
    double until = -1;
    if (fmi.GetIdlePromise(handle, &until) != fmi3OK) throw std::runtime_error(last_message());
    return until;
  }
  fmi3Status set_tolerance(const std::string& output, double tolerance) {
    const fmi3ValueReference r = reference(output);
    return fmi.SetIdleTolerances(handle, &r, 1, &tolerance, 1);
  }
  std::string last_message() const { return messages.empty() ? "" : messages.back(); }

  const UnitLibrary& fmi;
  fmi3Instance handle = nullptr;
  std::vector<std::string> messages;
  std::vector<fmi3Status> message_statuses;
  std::vector<std::string> message_categories;
  bool log_throws = false;  ///< as an importer in C++ may do by mistake
  /// What the importer does in Intermediate Update Mode, at this time [s].
  std::function<void(double)> on_intermediate_update = [](double) {};
  Step last;
  bool iterate = false;
  bool terminate = false;
  bool has_next_event = false;
  double next_event = 0;

 private:
  template <class T, class Getter>
  T read(Getter* getter, const std::string& name) {
    const fmi3ValueReference r = reference(name);
    T value{};
    if (getter(handle, &r, 1, &value, 1) != fmi3OK) throw std::runtime_error(last_message());
    return value;
  }
  static void on_log(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                     fmi3String message) {
    auto& self = *static_cast<UnitInstance*>(environment);
    self.messages.emplace_back(message);
    self.message_statuses.push_back(status);
    self.message_categories.emplace_back(category);
    if (self.log_throws) throw std::runtime_error("the log is full");
  }

  static void on_update(fmi3InstanceEnvironment environment, fmi3Float64 time,
                        fmi3Boolean set_requested, fmi3Boolean get_allowed,
                        fmi3Boolean step_finished, fmi3Boolean can_return_early,
                        fmi3Boolean* early_return_requested, fmi3Float64*) {
    if (!set_requested || get_allowed || step_finished || can_return_early) {
      throw std::runtime_error("this is no request for inputs");
    }
    *early_return_requested = true;  // which has no meaning then
    static_cast<UnitInstance*>(environment)->on_intermediate_update(time);
  }

  std::string xml_;
};

}  // namespace stride::tests

#endif
