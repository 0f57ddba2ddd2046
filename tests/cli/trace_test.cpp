// trace info, expand and compress.
#include <fstream>

#include <sys/resource.h>

#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string kHeader =
    "$timescale 1 ns $end\n$scope module top $end\n$var wire 1 ! lit $end\n";
const std::string kBehind = "$upscope $end\n$enddefinitions $end\n";
const std::string kPlain = kHeader + kBehind + "#0\n0!\n#10\n1!\n#30000000010\n0!\n";
const std::string kShort =
    "$timescale 1 ns $end\n$scope module top $end\n$var integer 64 \" advanceTime $end\n"
    "$var wire 1 ! lit $end\n" +
    kBehind + "#0\nb0 \"\n0!\n#10\n1!\n#1000010\nb11011111100000101000110100111000000 \"\n0!\n";

/// A scratch folder in which the program runs.
class Folder {
 public:
  explicit Folder(const std::string& text = kPlain) { scratch_.write("in.vcd", text); }

  Outcome trace(const Arguments& further) const {
    Arguments arguments{"trace"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return run_program(arguments, scratch_.path());
  }
  fs::path operator/(const std::string& name) const { return scratch_ / name; }

  /// An input error that leaves no file behind.
  std::string error(const Arguments& further) const {
    const std::string message = input_error_of(trace(further));
    CHECK_FALSE(fs::exists(scratch_ / "out.vcd"));
    CHECK_FALSE(fs::exists(scratch_ / "out.vcd.stride-new"));
    return message;
  }

 private:
  Scratch scratch_;
};

void check_quiet(const Outcome& outcome) {
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "");
  CHECK(outcome.err == "");
}

}  // namespace

TEST_CASE("trace compress and trace expand are each other's reverse, and print nothing") {
  const Folder folder;
  check_quiet(folder.trace({"compress", "in.vcd", "short.vcd"}));
  CHECK(read(folder / "short.vcd") == kShort);
  check_quiet(folder.trace({"expand", "short.vcd", "long.vcd"}));
  CHECK(read(folder / "long.vcd") == kPlain);
  check_quiet(folder.trace({"compress", "in.vcd", "short.vcd", "--min-gap", "40"}));
  CHECK_THAT(read(folder / "short.vcd"), Contains("#30000000010\n0!\n"));
}

TEST_CASE("trace info prints the content of a trace and its gaps") {
  const Folder folder(kShort);
  const Outcome outcome = folder.trace({"info", "in.vcd"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(outcome.out ==
        "in.vcd: idle time is left out (advanceTime)\n"
        "  size          " +
            std::to_string(kShort.size()) +
            " bytes\n"
            "  time scale    1 ns\n"
            "  variables     1\n"
            "  changes       3 at 3 instants\n"
            "  kernel time   0.00100001 s\n"
            "  true time     30.00000001 s\n"
            "  ratio         29999.7 : 1\n"
            "  skips         1\n"
            "  gaps          1 longer than 0.001 s\n"
            "\n"
            "Longest gaps\n"
            "    from [s]       to [s]  length [s]  skipped [s]\n"
            "  ──────────  ───────────  ──────────  ───────────\n"
            "  0.00000001  30.00000001          30       29.999\n");
}

TEST_CASE("trace info of a trace without idle time") {
  const Folder folder(kHeader + kBehind + "#0\n0!\n");
  const Outcome outcome = folder.trace({"info", "in.vcd", "--min-gap", "1e-6"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, StartsWith("in.vcd: no advanceTime, so its time is true\n") &&
                              Contains("  ratio         –\n") &&
                              Catch::EndsWith("  gaps          0 longer than 0.000001 s\n"));
}

TEST_CASE(
    "A trace that was cut off is refused, or read up to its last whole instant with --cut-off") {
  const Folder folder(kShort.substr(0, kShort.size() - 2));
  for (const Arguments& command : {Arguments{"expand", "in.vcd", "out.vcd"}, {"info", "in.vcd"}}) {
    CHECK_THAT(
        folder.error(command),
        StartsWith("stride: error: in.vcd:14: the file is cut off: it ends within '0' (no line") &&
            Contains("hint: where a run crashed, --cut-off takes"));
  }
  const Outcome expanded = folder.trace({"expand", "in.vcd", "out.vcd", "--cut-off"});
  CHECK(expanded.exit_code == 0);
  CHECK_THAT(expanded.err, Contains("in.vcd:14: the file is cut off here"));
  CHECK(read(folder / "out.vcd") == kHeader + kBehind + "#0\n0!\n#10\n1!\n");
  const Outcome info = folder.trace({"info", "in.vcd", "--cut-off"});
  CHECK(info.exit_code == 0);
  CHECK_THAT(info.out, Contains("2 at 2 instants"));
  CHECK_THAT(info.err, Contains("in.vcd:14: the file is cut off here"));
}

TEST_CASE("trace explains what is wrong with a file, and leaves nothing") {
  const auto error = [](const std::string& text, const std::string& command) {
    return Folder(text).error({command, "in.vcd", "out.vcd"});
  };
  CHECK_THAT(error(kPlain, "expand"), StartsWith("stride: error: in.vcd: the trace has no variable "
                                                 "advanceTime") &&
                                          Contains("hint: its time is true already"));
  CHECK_THAT(error(kShort, "compress"),
             StartsWith("stride: error: in.vcd: the trace has a variable "
                        "advanceTime") &&
                 Contains("'stride trace expand'"));
  CHECK_THAT(error(kShort + "#5\n", "expand"),
             StartsWith("stride: error: in.vcd:15: time goes back"));
  CHECK_THAT(error(kPlain + "#5\n", "compress"), StartsWith("stride: error: in.vcd:12: time goes"));
  CHECK_THAT(error("no trace", "expand"), StartsWith("stride: error: in.vcd:1: "));
}

TEST_CASE("trace explains what is wrong with its files") {
  const Folder folder;
  CHECK_THAT(folder.error({"info", "none.vcd"}), Contains("none.vcd: cannot open the file"));
  CHECK_THAT(folder.error({"compress", "in.vcd", "in.vcd"}),
             Contains("in.vcd: this is the file that is read"));
  CHECK_THAT(folder.error({"compress", "in.vcd", "none/out.vcd"}),
             Contains("none/out.vcd: the folder of this file does not exist"));
  CHECK_THAT(folder.error({"compress", "in.vcd", "."}), Contains("this is a folder"));
  CHECK(read(folder / "in.vcd") == kPlain);
}

TEST_CASE("trace takes no more memory for a long trace, nor for an instant at which much happens") {
  if (kSanitized) return;  // AddressSanitizer keeps memory that has been freed
  constexpr int kMany = 5'000'000;
  // of the children so far, the largest; what this process had when it forked counts, too
  const auto kilobytes = [] {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    return usage.ru_maxrss;
  };
  const auto run_all = [](int instants, int changes) {
    const Folder folder(kHeader + kBehind + "#0\n0!\n");
    {
      std::ofstream file(folder / "in.vcd", std::ios::app);
      for (int i = 1; i <= instants; ++i) file << '#' << i << "\n1!\n";
      for (int i = 0; i < changes; ++i) file << "0!\n1!\n";
      file << "#30000000010\n0!\n";
    }
    check_quiet(folder.trace({"compress", "in.vcd", "short.vcd"}));
    check_quiet(folder.trace({"expand", "short.vcd", "long.vcd"}));
    CHECK(folder.trace({"info", "short.vcd"}).exit_code == 0);
    CHECK(fs::file_size(folder / "long.vcd") == fs::file_size(folder / "in.vcd"));
  };
  run_all(100, 100);
  const auto before = kilobytes();
  run_all(kMany, 0);
  run_all(1, kMany);
  CHECK(before > 0);
  CHECK(kilobytes() - before < 20'000);  // the traces have 60'000 and 30'000
}

TEST_CASE("trace leaves nothing of a file that grows too large") {
  std::string changes;
  for (int i = 0; i < 100'000; ++i) changes += "0!\n1!\n";
  const Folder folder(kHeader + kBehind + "#0\n" + changes);
  Arguments limited{"bash", "-c", "ulimit -f 100; exec \"$@\"", "bash"};
  for (const auto& word : stride_command({"trace", "compress", "in.vcd", "out.vcd"})) {
    limited.push_back(word);
  }
  const Outcome outcome = Process(limited, (folder / "").parent_path()).wait();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("out.vcd.stride-new: cannot write the file: File too large"));
  CHECK_FALSE(fs::exists(folder / "out.vcd"));
  CHECK_FALSE(fs::exists(folder / "out.vcd.stride-new"));
}

TEST_CASE("trace writes into a pipe, too") {
  const Folder folder(kShort);
  const Outcome outcome = folder.trace({"expand", "in.vcd", "/dev/fd/1"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == kPlain);
}

TEST_CASE("trace explains its command line") {
  const Folder folder;
  CHECK_THAT(folder.error({}),
             Contains("subcommand is required") && Contains("stride trace --help"));
  CHECK_THAT(folder.error({"expnad", "in.vcd"}),
             Contains("no command 'expnad'") && Contains("did you mean 'expand'?"));
  CHECK_THAT(folder.error({"expand", "in.vcd"}),
             Contains("OUT.vcd is required") && Contains("stride trace expand --help"));
  CHECK_THAT(folder.error({"expand", "in.vcd", "out.vcd", "--min-gap", "1"}),
             Contains("--min-gap"));
  CHECK_THAT(folder.error({"compress", "in.vcd", "out.vcd", "--min-gap", "-1"}),
             Contains("--min-gap -1: '-1' is negative"));
  CHECK_THAT(folder.error({"compress", "in.vcd", "out.vcd", "--min-gap", "1e-10"}),
             Contains("a gap of 0.0000000001 s is shorter than 1 ns") &&
                 Contains("--min-gap 0.000000001"));
  for (const char* command : {"info", "expand", "compress"}) {
    const Outcome help = folder.trace({command, "--help"});
    CHECK(help.exit_code == 0);
    CHECK_THAT(help.out, Contains("IN.vcd") && Contains("--cut-off"));
  }
}
