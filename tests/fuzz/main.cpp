// fuzz list | run PARSER... | read PARSER FILE... | seeds PARSER FOLDER
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>

#include <spdlog/spdlog.h>

#include "tests/fuzz/engine.h"
#include "tests/fuzz/working_folder.h"

using namespace stride::tests;

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr const char* kUsage =
    "fuzz list                  the names of all parsers\n"
    "fuzz run [OPTION...] PARSER...  or the groups of some\n"
    "    --inputs N             for each of the parsers (1000)\n"
    "    --seed N               other inputs (1)\n"
    "    --findings FOLDER      a file for each finding, and one with the command that repeats it\n"
    "fuzz read PARSER FILE...   reads these files, in this process\n"
    "fuzz seeds PARSER FOLDER   writes its seeds there, as a corpus\n";

struct Options {
  std::size_t inputs = 1000;
  unsigned seed = 1;
  fs::path findings;
  Words parsers;
};

Options options_of(const Words& words) {
  Options options;
  for (auto word = words.begin(); word != words.end(); ++word) {
    const auto value = [&] {
      if (std::next(word) == words.end()) throw std::invalid_argument(*word + ": a value follows");
      return *++word;
    };
    if (*word == "--inputs") {
      options.inputs = std::stoul(value());
    } else if (*word == "--seed") {
      options.seed = static_cast<unsigned>(std::stoul(value()));
    } else if (*word == "--findings") {
      options.findings = value();
    } else {
      options.parsers.push_back(*word);
    }
  }
  return options;
}

std::string command_for(const Parser& parser, const fs::path& file) {
  return fs::read_symlink("/proc/self/exe").string() + " read " + parser.name + " " +
         fs::absolute(file).string();
}

void report(const Parser& parser, const Finding& finding, const fs::path& folder) {
  std::cerr << parser.name << ": finding: " << finding.what << "\n";
  if (folder.empty()) return;
  fs::create_directories(folder);
  const std::size_t hash = std::hash<std::string>()(finding.bytes);
  const fs::path file = folder / (parser.name + "-" + std::to_string(hash));
  std::ofstream(file, std::ios::binary) << finding.bytes;
  std::ofstream(file.string() + ".txt") << finding.what << "\n"
                                        << command_for(parser, file) << "\n";
  std::cerr << "  " << command_for(parser, file) << "\n";
}

/// Seeds and alphabet are of use if damaged seeds go both ways.
bool tests_something(const Parser& parser, const Tally& tally, std::size_t inputs) {
  const std::size_t least = inputs / 500;
  const bool accepts_enough = !parser.may_accept || tally.accepted > least;
  const bool refuses_enough = !parser.may_refuse || tally.refused > least;
  if (accepts_enough && refuses_enough) return true;
  std::cerr << parser.name << ": nearly all inputs end alike; its seeds have to change\n";
  return false;
}

bool run_parser(const Parser& parser, const Options& options) {
  const Tally tally = run(parser, options.inputs, options.seed);
  std::cout << parser.name << ": " << tally.accepted << " accepted, " << tally.refused
            << " refused, " << tally.findings.size() << " findings" << std::endl;
  for (const Finding& finding : tally.findings) report(parser, finding, options.findings);
  return tally.findings.empty() && tests_something(parser, tally, options.inputs);
}

bool run_all(const Words& words) {
  const Options options = options_of(words);
  bool is_well = !options.parsers.empty();
  for (const std::string& name : options.parsers) {
    for (const Parser& parser : find_parsers(name)) {
      is_well = run_parser(parser, options) && is_well;
    }
  }
  return is_well;
}

bool read_files(const Parser& parser, const Words& files) {
  bool is_well = true;
  for (const std::string& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    std::string what = "accepted";
    const Answer answer = read_once(parser, bytes, what);
    std::cout << file << ": " << (answer == Answer::Finding ? "finding: " : "") << what << "\n";
    is_well = is_well && answer != Answer::Finding;
  }
  return is_well;
}

void write_seeds(const Parser& parser, const fs::path& folder) {
  fs::create_directories(folder);
  int number = 0;
  for (const std::string& seed : seeds_of(parser)) {
    std::ofstream(folder / std::to_string(++number), std::ios::binary) << seed;
  }
}

bool perform(const std::string& command, const Words& words) {
  if (command == "list" && words.empty()) {
    for (const Parser& parser : parsers()) std::cout << parser.name << "\n";
  } else if (command == "run") {
    return run_all(words);
  } else if (command == "read" && words.size() >= 2) {
    return read_files(find_parser(words[0]), {words.begin() + 1, words.end()});
  } else if (command == "seeds" && words.size() == 2) {
    write_seeds(find_parser(words[0]), words[1]);
  } else {
    throw std::invalid_argument(kUsage);
  }
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  spdlog::set_level(spdlog::level::off);
  try {
    const WorkingFolder folder;
    const Words words(arguments + 1, arguments + count);
    if (words.empty()) throw std::invalid_argument(kUsage);
    return perform(words[0], {words.begin() + 1, words.end()}) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "fuzz: " << error.what() << "\n";
    return 2;
  }
}
