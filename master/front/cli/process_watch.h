// The process that waits for the end of the one in which units are.
#ifndef STRIDE_MASTER_FRONT_CLI_PROCESS_WATCH_H
#define STRIDE_MASTER_FRONT_CLI_PROCESS_WATCH_H

namespace stride::cli {

/// Forks the process and returns in the new one, which is to note its end (end_note()). This one
/// hands on the signals that it gets, waits for that end, whatever brings it about, and ends with
/// the same exit code or by the same signal.
///
/// An end that is not noted, as by a system call, SIGKILL or another program in place of this one,
/// is an error with the exit code 1: this process writes the lines that open files still held in
/// memory, prints the error, with the unit and the function that was being called, and adds it to
/// run.json, the report and the test report.
///
/// When this process is killed the new one is, too. A process that a debugger traces from its
/// beginning is not forked, and one that cannot be forked goes on with a warning.
///
/// To be called once, while there is one thread.
void go_on_watched();

}  // namespace stride::cli

#endif
