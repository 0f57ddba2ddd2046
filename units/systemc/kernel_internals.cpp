#define SC_INCLUDE_DYNAMIC_PROCESSES
#include "units/systemc/kernel_internals.h"

namespace stride::systemc {
namespace {

using sc_core::sc_clock;
using sc_core::sc_event;
using sc_core::sc_event_timed;
using sc_core::sc_process_b;
using sc_core::sc_process_handle;
using sc_core::sc_process_host;
using sc_core::sc_simcontext;

// names in an explicit instantiation are not checked for access, and there is no other way in
template <class Tag, typename Tag::Type Member>
struct Expose {
  friend typename Tag::Type member(Tag) { return Member; }
};
template <class T, int Number>
struct Tag {
  using Type = T;
};

struct ResetFinders : Tag<sc_core::sc_reset_finder * sc_simcontext::*, 0> {
  friend Type member(ResetFinders);
};
struct ForcedStop : Tag<bool sc_simcontext::*, 0> {
  friend Type member(ForcedStop);
};
struct Ready : Tag<bool sc_simcontext::*, 1> {
  friend Type member(Ready);
};
struct Status : Tag<sc_core::sc_status sc_simcontext::*, 0> {
  friend Type member(Status);
};
struct TimedEvents : Tag<sc_core::sc_ppq<sc_event_timed*> * sc_simcontext::*, 0> {
  friend Type member(TimedEvents);
};
struct Heap : Tag<void* * sc_core::sc_ppq_base::*, 0> {
  friend Type member(Heap);
};
struct EventOf : Tag<sc_event* (sc_event_timed::*)() const, 0> {
  friend Type member(EventOf);
};
struct TimeOf : Tag<const sc_core::sc_time& (sc_event_timed::*)() const, 0> {
  friend Type member(TimeOf);
};
struct RisingEdge : Tag<sc_event sc_clock::*, 0> {
  friend Type member(RisingEdge);
};
struct FallingEdge : Tag<sc_event sc_clock::*, 1> {
  friend Type member(FallingEdge);
};
struct ChangeStamp : Tag<sc_dt::uint64 sc_core::sc_signal_channel::*, 0> {
  friend Type member(ChangeStamp);
};
struct HasStack : Tag<bool sc_process_b::*, 0> {
  friend Type member(HasStack);
};
struct Entry : Tag<void (sc_process_host::*sc_process_b::*)(), 0> {
  friend Type member(Entry);
};
struct CurrentProcess : Tag<sc_core::sc_curr_proc_info sc_simcontext::*, 0> {
  friend Type member(CurrentProcess);
};
struct CurrentWriter : Tag<sc_process_b * sc_simcontext::*, 0> {
  friend Type member(CurrentWriter);
};

template struct Expose<ResetFinders, &sc_simcontext::m_reset_finder_q>;
template struct Expose<ForcedStop, &sc_simcontext::m_forced_stop>;
template struct Expose<Ready, &sc_simcontext::m_ready_to_simulate>;
template struct Expose<Status, &sc_simcontext::m_simulation_status>;
template struct Expose<TimedEvents, &sc_simcontext::m_timed_events>;
template struct Expose<Heap, &sc_core::sc_ppq_base::m_heap>;
template struct Expose<EventOf, &sc_event_timed::event>;
template struct Expose<TimeOf, &sc_event_timed::notify_time>;
template struct Expose<RisingEdge, &sc_clock::m_next_posedge_event>;
template struct Expose<FallingEdge, &sc_clock::m_next_negedge_event>;
template struct Expose<ChangeStamp, &sc_core::sc_signal_channel::m_change_stamp>;
template struct Expose<CurrentProcess, &sc_simcontext::m_curr_proc_info>;
template struct Expose<CurrentWriter, &sc_simcontext::m_current_writer>;
template struct Expose<HasStack, &sc_process_b::m_has_stack>;
template struct Expose<Entry, &sc_process_b::m_semantics_method_p>;

struct Nothing : sc_process_host {
  void run() {}
};

// kill() resumes what has a stack only
void let_run_nothing(sc_process_b& thread) {
  thread.*member(Entry()) = static_cast<void (sc_process_host::*)()>(&Nothing::run);
  thread.*member(HasStack()) = true;
}

sc_process_b* to_process(const sc_process_handle& handle) {
  return dynamic_cast<sc_process_b*>(handle.get_process_object());
}

// only a process can end another one at once
class InTheNameOf {
 public:
  InTheNameOf(sc_simcontext& context, sc_process_b* process) : context_(context) {
    note(process, process->proc_kind());
  }
  ~InTheNameOf() {
    note(nullptr, sc_core::SC_NO_PROC_);
    context_.*member(CurrentWriter()) = nullptr;
  }

 private:
  void note(sc_process_b* process, sc_core::sc_curr_proc_kind kind) {
    sc_core::sc_curr_proc_info& info = context_.*member(CurrentProcess());
    info.process_handle = process;
    info.kind = kind;
  }
  sc_simcontext& context_;
};

// after an error, a thread that ends is followed by no other
void set_any_error(sc_simcontext& context) {
  try {
    throw "ended";
  } catch (...) {
    context.set_error(sc_core::sc_handle_exception());
  }
}

}  // namespace

void forget_reset_finders(sc_simcontext& context) { context.*member(ResetFinders()) = nullptr; }

void allow_start_after_stop(sc_simcontext& context) {
  context.*member(ForcedStop()) = false;
  context.*member(Ready()) = true;
  context.*member(Status()) = sc_core::SC_RUNNING;
}

void end_threads(sc_simcontext& context, const std::vector<sc_process_handle>& threads,
                 const sc_process_handle& method) {
  set_any_error(context);
  const InTheNameOf scope(context, to_process(method));
  for (sc_process_handle thread : threads) {
    if (thread.terminated()) continue;
    sc_process_b& process = *to_process(thread);
    if (!(process.*member(HasStack()))) let_run_nothing(process);
    thread.kill();
  }
}

std::vector<Notification> pending_notifications(const sc_simcontext& context) {
  const auto& queue = *(context.*member(TimedEvents()));
  void* const* const heap = queue.*member(Heap());
  std::vector<Notification> pending;
  for (int i = 1; i <= queue.size(); ++i) {
    const auto& timed = *static_cast<const sc_event_timed*>(heap[i]);
    const sc_event* const event = (timed.*member(EventOf()))();
    if (event != nullptr) pending.push_back({event, (timed.*member(TimeOf()))()});
  }
  return pending;
}

std::array<const sc_event*, 2> own_events(const sc_clock& clock) {
  return {&(clock.*member(RisingEdge())), &(clock.*member(FallingEdge()))};
}

std::uint64_t change_stamp(const sc_core::sc_signal_channel& signal) {
  return signal.*member(ChangeStamp());
}

}  // namespace stride::systemc
