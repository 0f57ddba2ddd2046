// Value change dumps, which are read, expanded and compressed.
#include <optional>

#include "master/observe/trace/compress.h"
#include "master/observe/trace/expand.h"
#include "master/observe/trace/info.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"
#include "tests/master/observe/trace/random_trace.h"

namespace stride::tests {
namespace {

using trace::CutOff;
namespace fs = std::filesystem;

constexpr std::nullopt_t kMinGap = std::nullopt;  // the default suits all time scales

void ensure_same(const fs::path& found, CutOff cut_off, const fs::path& made) {
  const trace::Info a = trace::info(found, kMinGap, cut_off);
  const trace::Info b = trace::info(made, kMinGap, CutOff::Refuse);
  ensure(a.changes == b.changes && a.instants == b.instants && a.gaps == b.gaps,
         "the content stays the same");
}

void expand(const fs::path& file, CutOff cut_off) {
  refusing_input(file.string(), [&] {
    const fs::path longer = working_path("long.vcd");
    fs::remove(longer);
    trace::expand(file, longer, cut_off);
    ensure_same(file, cut_off, longer);
  });
}

void compress(const fs::path& file, CutOff cut_off) {
  refusing_input(file.string(), [&] {
    const fs::path shorter = working_path("short.vcd");
    const fs::path longer = working_path("long.vcd");
    for (const fs::path& old : {shorter, longer}) fs::remove(old);
    trace::compress(file, shorter, kMinGap, cut_off);
    ensure_same(file, cut_off, shorter);
    trace::expand(shorter, longer, CutOff::Refuse);
    ensure_same(file, cut_off, longer);
  });
}

/// A trace can be expanded or compressed, not both; either may refuse it.
void read_trace(const std::string& bytes, CutOff cut_off) {
  const fs::path file = write_file("x.vcd", bytes);
  refusing_input(file.string(), [&] { trace::info(file, kMinGap, cut_off); });
  for (auto* const change : {expand, compress}) {
    try {
      change(file, cut_off);
    } catch (const Refusal&) {
    }
  }
  for (const char* name : {"short.vcd.stride-new", "long.vcd.stride-new"}) {
    ensure(!fs::exists(working_path(name)), "no part of a file is left");
  }
}

std::vector<std::string> random_traces() {
  std::vector<std::string> texts;
  for (unsigned i = 0; i < 20; ++i) {
    const trace::RandomTrace trace(i);
    texts.push_back(i % 2 == 0 ? trace.text() : trace.untidy_text());
  }
  return texts;
}

constexpr const char* kTraceAlphabet = "#$01xzbrs!\"\n 9-";

const Registration kTraceParsers(
    "trace", {
                 {.name = "vcd",
                  .read = [](const std::string& bytes) { read_trace(bytes, CutOff::Refuse); },
                  .seed_files = {"tests/fuzz/seeds/vcd"},
                  .seeds = random_traces(),
                  .alphabet = kTraceAlphabet},
                 {.name = "vcd_cut_off",
                  .read = [](const std::string& bytes) { read_trace(bytes, CutOff::Accept); },
                  .seed_files = {"tests/fuzz/seeds/vcd"},
                  .seeds = random_traces(),
                  .alphabet = kTraceAlphabet},
             });

}  // namespace
}  // namespace stride::tests
