#include "units/process/declaration.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "units/xml/document.h"
#include "units/xml/file.h"

namespace process {
namespace {

namespace fs = std::filesystem;
using xml::Element;

constexpr const char* kFile = "process.xml";
constexpr const char* kOrigin = "origin.txt";

template <class Function>
auto checked(const Element& element, Function&& f) {
  try {
    return f();
  } catch (const std::invalid_argument& mistake) {
    element.fail(mistake.what());
  }
}

bool flag(const Element& element, const char* attribute) {
  if (!element.has(attribute)) return false;
  bool value = false;
  checked(element, [&] { stride::process::parse_value(element.text(attribute), value); });
  return value;
}

std::string text_or_nothing(const Element& element, const char* attribute) {
  return element.has(attribute) ? element.text(attribute) : "";
}

stride::Duration read_time_unit(const Element& root) {
  if (!root.has("time-unit")) return stride::Duration(1);
  constexpr std::array<std::pair<const char*, std::int64_t>, 5> kUnits = {
      {{"ps", 1},
       {"ns", 1'000},
       {"us", 1'000'000},
       {"ms", 1'000'000'000},
       {"s", 1'000'000'000'000}}};
  const std::string name = root.text("time-unit");
  for (const auto& [unit, picoseconds] : kUnits) {
    if (name == unit) return stride::Duration(picoseconds);
  }
  root.fail("time-unit=\"" + name + "\" is not known: expected ps, ns, us, ms or s");
}

class Reader {
 public:
  explicit Reader(const Element& root) : root_(root) {}

  Declaration read() {
    read_root();
    for (const Element& child : root_.children()) read_child(child);
    if (result_.command.empty()) {
      root_.fail("expected <program file=\"…\"/> or <program name=\"…\"/>, which is run");
    }
    check_dependencies();
    return std::move(result_);
  }

 private:
  void read_root() {
    result_.description = text_or_nothing(root_, "description");
    result_.may_stop = flag(root_, "may-stop");
    result_.split_invariant = flag(root_, "split-invariant");
    result_.has_trace = flag(root_, "trace");
    result_.time_unit = read_time_unit(root_);
    if (!root_.has("maximum-step")) return;
    result_.maximum_step = root_.time("maximum-step").time_since_epoch();
    if (*result_.maximum_step == stride::Duration{})
      root_.fail("maximum-step: expected more than 0");
  }

  void read_child(const Element& child) {
    const std::string name = child.name();
    if (name == "program") return read_program(child);
    if (name == "argument") return read_argument(child);
    if (name == "file") return child.allow_only_leaf({"file"});
    if (name == "unit-of-measure") return read_unit_of_measure(child);
    if (name == "parameter") {
      return read_variable(child, Role::Parameter, {"min", "max", "unit", "relative"});
    }
    if (name == "input") {
      return read_variable(child, Role::Input, {"min", "max", "unit", "relative", "variability"});
    }
    if (name == "output") {
      return read_variable(child, Role::Output,
                           {"min", "max", "unit", "relative", "variability", "depends-on"});
    }
    if (name == "message-input") {
      return read_variable(child, Role::MessageInput, {"clock", "mime-type", "unit", "relative"});
    }
    if (name == "message-output") {
      return read_variable(child, Role::MessageOutput, {"clock", "mime-type", "unit", "relative"});
    }
    child.fail(
        "not known here: expected <program>, <argument>, <file>, <unit-of-measure>, <parameter>, "
        "<input>, <output>, <message-input> or <message-output>");
  }

  // ---- The command ----

  void read_program(const Element& child) {
    child.allow_only_leaf({"file", "name", "outside"});
    if (!result_.command.empty()) {
      child.fail("expected one <program>, before its arguments");
    }
    result_.command.push_back(read_word(child, "name"));
  }

  void read_argument(const Element& child) {
    child.allow_only_leaf({"file", "text", "outside"});
    if (result_.command.empty()) child.fail("expected behind <program>");
    result_.command.push_back(read_word(child, "text"));
  }

  Word read_word(const Element& child, const char* other) {
    if (child.has("file") == child.has(other)) {
      child.fail("expected either 'file' or '" + std::string(other) + "'");
    }
    if (!child.has("file")) {
      if (child.has("outside")) child.fail("outside: expected where there is a 'file' only");
      return {Word::Kind::Text, child.text(other)};
    }
    const fs::path file = child.text("file");
    if (flag(child, "outside")) return {Word::Kind::Outside, file.string()};
    return {Word::Kind::Resource, file.filename().string()};
  }

  void read_unit_of_measure(const Element& child) {
    child.allow_only_leaf({"name", "factor", "unit", "offset"});
    result_.units_of_measure.push_back({child.text("name"), child.number("factor", 1),
                                        child.text("unit"), child.number("offset", 0)});
  }

  // ---- Variables ----

  void read_variable(const Element& child, Role role, std::vector<std::string> attributes) {
    attributes.insert(attributes.begin(), {"name", "type", "dimensions", "start", "description"});
    child.allow_only_leaf(attributes);
    Variable variable;
    variable.name = child.text("name");
    variable.role = role;
    variable.description = text_or_nothing(child, "description");
    variable.unit = text_or_nothing(child, "unit");
    variable.is_relative = flag(child, "relative");
    variable.mime_type = text_or_nothing(child, "mime-type");
    claim(child, variable.name);
    read_type(child, variable);
    read_range(child, variable);
    if (role == Role::MessageInput || role == Role::MessageOutput) read_clock(child, variable);
    if (role == Role::Input || role == Role::Output) read_variability(child, variable);
    if (child.has("depends-on")) {
      std::istringstream words(child.text("depends-on"));
      variable.depends_on.emplace(std::istream_iterator<std::string>(words),
                                  std::istream_iterator<std::string>());
    }
    result_.variables.push_back(std::move(variable));
    places_.push_back(child);
  }

  void claim(const Element& child, const std::string& name) {
    if (name.empty()) child.fail("expected a name");
    if (!names_.insert(name).second) child.fail("'" + name + "' is declared twice");
  }

  static void read_type(const Element& child, Variable& variable) {
    if (child.has("dimensions")) variable.dimensions = read_dimensions(child);
    checked(child, [&] {
      variable.start = value_of_type(child.text("type"), variable.dimensions);
      if (child.has("start")) parse(child.text("start"), variable.start);
    });
    const bool is_float = type_of(variable.start) <= stride::Type::Float64;
    if (!is_float && child.has("relative")) {
      child.fail("relative: expected of Float32 and Float64 only");
    }
    const bool is_number = type_of(variable.start) < stride::Type::Boolean;
    for (const char* attribute : {"unit", "min", "max"}) {
      if (!is_number && child.has(attribute)) {
        child.fail(std::string(attribute) + ": expected of numbers only");
      }
    }
    const bool is_binary = std::holds_alternative<Binary>(variable.start);
    if (!is_binary && child.has("mime-type")) child.fail("mime-type: expected of a Binary only");
  }

  static std::vector<std::size_t> read_dimensions(const Element& child) {
    constexpr std::size_t kMost = std::size_t{1} << 20;
    std::vector<std::size_t> dimensions;
    std::size_t size = 1;
    std::istringstream words(child.text("dimensions"));
    for (std::string word; words >> word;) {
      std::uint32_t dimension = 0;
      checked(child, [&] { stride::process::parse_value(word, dimension); });
      if (dimension == 0 || dimension > kMost / size) {
        child.fail("dimensions: expected from 1 to " + std::to_string(kMost) +
                   " elements; a Binary can have more bytes");
      }
      size *= dimension;
      dimensions.push_back(dimension);
    }
    if (dimensions.empty()) child.fail("dimensions: expected a number for each, such as \"3 2\"");
    return dimensions;
  }

  static void read_range(const Element& child, Variable& variable) {
    if (child.has("min")) variable.min = child.number("min");
    if (child.has("max")) variable.max = child.number("max");
  }

  /// `receive.frame` has the clock `receive.clock`, unless another name is given.
  void read_clock(const Element& child, Variable& variable) {
    const std::size_t dot = variable.name.rfind('.');
    if (child.has("clock")) {
      variable.clock = child.text("clock");
    } else if (dot != std::string::npos) {
      variable.clock = variable.name.substr(0, dot) + ".clock";
    } else {
      child.fail("expected the attribute 'clock', or a name such as '" + variable.name +
                 ".value', whose clock is '" + variable.name + ".clock'");
    }
    claim(child, variable.clock);
  }

  static void read_variability(const Element& child, Variable& variable) {
    const bool is_float = type_of(variable.start) <= stride::Type::Float64;
    variable.is_discrete = !is_float;
    if (!child.has("variability")) return;
    const std::string word = child.text("variability");
    if (word != "discrete" && (word != "continuous" || !is_float)) {
      child.fail("variability=\"" + word + "\": expected discrete" +
                 (is_float ? ", or continuous" : ""));
    }
    variable.is_discrete = word == "discrete";
  }

  void check_dependencies() const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!result_.variables[i].depends_on) continue;
      for (const std::string& name : *result_.variables[i].depends_on) {
        const auto& all = result_.variables;
        const auto is_it = [&](const Variable& v) {
          return v.role == Role::Input && v.name == name;
        };
        if (std::none_of(all.begin(), all.end(), is_it)) {
          places_[i].fail("depends-on: there is no <input name=\"" + name + "\"/>");
        }
      }
    }
  }

  Element root_;
  Declaration result_;
  std::vector<Element> places_;  ///< of the variables
  std::set<std::string> names_;
};

fs::path origin_of(const fs::path& resources) {
  const fs::path file = resources / kOrigin;
  std::string folder;
  if (fs::exists(file)) {
    folder = xml::read_file(file.string(), "the path of a folder, as stride pack writes it");
    folder.resize(std::min(folder.find('\n'), folder.size()));
  }
  return folder.empty() ? fs::absolute(resources) : fs::path(folder);
}

std::string existing(const fs::path& file, const std::string& remedy) {
  if (fs::exists(file)) return file.string();
  throw std::runtime_error("there is no " + file.string() + ": " + remedy);
}

std::string path_of(const Word& word, const fs::path& resources) {
  switch (word.kind) {
    case Word::Kind::Text:
      break;
    case Word::Kind::Resource:
      return existing(
          fs::absolute(resources) / word.text,
          "it is declared in process.xml, so pack it: stride pack FILE.xml -o NAME.fmu");
    case Word::Kind::Outside:
      return existing((origin_of(resources) / word.text).lexically_normal(),
                      "it is declared in process.xml as outside of the unit; put it there, or pack "
                      "the declaration again from where it is now");
  }
  return word.text;
}

}  // namespace

Declaration load_declaration(const fs::path& resources) {
  if (resources.empty()) {
    throw std::runtime_error(
        "the unit process has no resources folder: expected one with process.xml; `stride pack "
        "FILE.xml -o NAME.fmu` makes a unit of the program that FILE.xml declares");
  }
  const xml::Document document = xml::Document::load(
      (resources / kFile).string(), "process",
      {"name", "description", "may-stop", "split-invariant", "trace", "time-unit", "maximum-step"});
  return Reader(document.root()).read();
}

std::vector<std::string> command_line(const Declaration& declaration, const fs::path& resources,
                                      const std::string& other_program) {
  std::vector<std::string> line;
  for (const Word& word : declaration.command) {
    const bool is_replaced = line.empty() && !other_program.empty();
    line.push_back(is_replaced ? other_program : path_of(word, resources));
  }
  return line;
}

}  // namespace process
