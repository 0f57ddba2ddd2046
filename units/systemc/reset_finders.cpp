#include "units/systemc/reset_finders.h"

namespace stride::systemc {
namespace {

using Queue = sc_core::sc_reset_finder* sc_core::sc_simcontext::*;

Queue queue();

// names in an explicit instantiation are not checked for access, and there is no other way in
template <Queue Member>
struct Access {
  friend Queue queue() { return Member; }
};
template struct Access<&sc_core::sc_simcontext::m_reset_finder_q>;

}  // namespace

void forget_reset_finders(sc_core::sc_simcontext& context) { context.*queue() = nullptr; }

}  // namespace stride::systemc
