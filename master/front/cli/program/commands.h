// The commands of the program; each adds itself with its options to the command line.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_COMMANDS_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_COMMANDS_H

namespace CLI {
class App;
}

namespace stride::cli {

void add_run(CLI::App& app);
void add_resume(CLI::App& app);
void add_check(CLI::App& app);
void add_inspect(CLI::App& app);
void add_compare(CLI::App& app);
void add_complete(CLI::App& app);
void add_new(CLI::App& app);
void add_pack(CLI::App& app);
void add_build(CLI::App& app);
void add_campaign(CLI::App& app);
void add_coverage(CLI::App& app);
void add_report(CLI::App& app);
void add_serve(CLI::App& app);
void add_trace(CLI::App& app);
void add_reference(CLI::App& app);
void add_verify(CLI::App& app);

}  // namespace stride::cli

#endif
