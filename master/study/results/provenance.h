// What a run is made from, for whoever repeats it or goes on with it.
#ifndef STRIDE_MASTER_STUDY_RESULTS_PROVENANCE_H
#define STRIDE_MASTER_STUDY_RESULTS_PROVENANCE_H

#include <ctime>
#include <filesystem>
#include <string>

#include "master/base/files/file_digests.h"
#include "master/base/state_archive.h"
#include "master/observe/checkpoint/journals.h"
#include "master/observe/recorders/provenance.h"
#include "master/system/plan/run_plan.h"

namespace stride::results {

/// "2026-11-25T23:59:59Z"
std::string utc_text(std::time_t time);

/// Of a run that begins now. `command`: that has loaded it. Reads the files whose digests are not
/// known yet. Throws core::Error (Input).
recorders::Provenance provenance_of(const scenario::RunPlan& loaded, recorders::Command command,
                                    core::FileDigests& digests);

/// Throws core::Error (Input), at the checkpoint, that names all that differs.
void require_same(const recorders::Provenance& before, const recorders::Provenance& now,
                  const std::filesystem::path& checkpoint);

/// Makes units what they were at the checkpoint in this file. Throws as Journals::restore() does,
/// and as fail_checkpoint().
void restore_units(checkpoint::Journals& journals, const checkpoint::Checkpoint& from,
                   const std::filesystem::path& checkpoint);

/// Throws core::Error (Input): the checkpoint suits the files, but is none of this run.
[[noreturn]] void fail_checkpoint(const std::filesystem::path& checkpoint,
                                  const core::BadState& mistake);

}  // namespace stride::results

#endif
