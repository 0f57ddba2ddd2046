// Until when a robot has nothing to do.
#ifndef STRIDE_UNITS_READER_IDLE_H
#define STRIDE_UNITS_READER_IDLE_H

#include <stride/time.h>

#include "units/reader/model.h"

namespace reader {

/// Until when, from `now` on, all axes stay where they are: the waypoint from which one of them
/// moves next, or Time::max() if none does any more; `now` while one moves or trembles.
stride::Time axes_rest_until(const Program& program, stride::Time now);

/// Until when nothing happens by itself: the axes do not move, the carrier stays as it is, and
/// nothing is to be sent, given up or heard to its end. Not after `now` if something is due.
stride::Time idle_until(const Reader& reader, stride::Time now);

}  // namespace reader

#endif
