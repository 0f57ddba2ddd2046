#ifndef STRIDE_MASTER_STUDY_COMPARE_SIGNALS_SIGNALS_H
#define STRIDE_MASTER_STUDY_COMPARE_SIGNALS_SIGNALS_H

#include <string>

#include "master/study/compare/criteria/difference.h"
#include "master/study/compare/criteria/selection.h"
#include "master/study/compare/criteria/settings.h"
#include "master/study/compare/signals/recorded_signals.h"

namespace stride::compare {

/// Signals that only one has, of other units of measure, with other values; rows that only one has.
/// A signal is held between its instants if either run says so of it, otherwise it goes straight.
/// `file`: the name of the file. Throws core::Error (Input) for a tolerance of no signal.
Differences compare_signals(const RecordedSignals& a, const RecordedSignals& b,
                            const Settings& settings, const Selection& selection,
                            const std::string& file);

}  // namespace stride::compare

#endif
