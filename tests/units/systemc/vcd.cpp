#include "tests/units/systemc/vcd.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace stride::tests {
namespace {

class Reader {
 public:
  Vcd read(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path);
    std::ostringstream text;
    text << file.rdbuf();
    vcd_.bytes = text.str().size();
    std::istringstream words(text.str());
    read_header(words);
    for (std::string word; words >> word;) read_word(word, words);
    end_stamp();
    if (!dumped_) throw std::runtime_error(path + " has no values");
    return vcd_;
  }

 private:
  static std::string until_end(std::istream& words) {
    std::string text;
    for (std::string word; words >> word && word != "$end";)
      text += (text.empty() ? "" : " ") + word;
    return text;
  }

  void read_header(std::istream& words) {
    std::vector<std::string> scopes;
    for (std::string word; words >> word;) {
      const std::string body = until_end(words);
      if (word == "$enddefinitions") return;
      if (word == "$timescale") vcd_.timescale = body;
      if (word == "$upscope") scopes.pop_back();
      std::istringstream fields(body);
      std::string kind, name;
      if (word == "$scope" && fields >> kind >> name) scopes.push_back(name);
      if (word == "$var") read_variable(fields, scopes);
    }
    throw std::runtime_error("the header has no end");
  }

  // the outermost scope is SystemC's own
  void read_variable(std::istream& fields, const std::vector<std::string>& scopes) {
    std::string type, width, id, name;
    fields >> type >> width >> id >> name;
    std::string full;
    for (std::size_t i = 1; i < scopes.size(); ++i) full += scopes[i] + ".";
    names_[id] = full + name;
    vcd_.signals[full + name];
  }

  void read_word(const std::string& word, std::istream& words) {
    if (word == "$comment") {
      until_end(words);
    } else if (word == "$dumpvars") {
      dumped_ = true;
    } else if (word[0] == '#') {
      end_stamp();
      vcd_.last_stamp = stamp_ = std::stoll(word.substr(1));
    } else if (word[0] == 'b' || word[0] == 'r') {
      std::string id;
      words >> id;
      changes_.emplace_back(names_.at(id), word.substr(1));
    } else if (word[0] != '$') {
      changes_.emplace_back(names_.at(word.substr(1)), word.substr(0, 1));
    }
  }

  void end_stamp() {
    for (const auto& [name, value] : changes_) {
      if (name == "advanceTime") advance_ = std::stoll(value, nullptr, 2);
    }
    const std::int64_t time = stamp_ + advance_;
    if (!changes_.empty() && time <= last_time_) throw std::runtime_error("time goes back");
    if (!changes_.empty()) last_time_ = time;
    for (const auto& [name, value] : changes_) vcd_.signals[name].emplace_back(time, value);
    changes_.clear();
  }

  Vcd vcd_;
  std::map<std::string, std::string> names_;                  ///< by identifier code
  std::vector<std::pair<std::string, std::string>> changes_;  ///< at the present stamp
  bool dumped_ = false;
  std::int64_t stamp_ = 0;
  std::int64_t advance_ = 0;
  std::int64_t last_time_ = -1;
};

}  // namespace

Vcd read_vcd(const std::string& path) { return Reader().read(path); }

}  // namespace stride::tests
