// Lists no state, so it cannot be saved, and reads a file of its resources.
#include <fstream>
#include <stdexcept>
#include <string>

#include <stride/unit.h>

namespace {

class Stateless : public stride::Unit {
 public:
  explicit Stateless(const stride::Setup& setup) {
    std::ifstream file(setup.resources / "note.txt");
    if (!std::getline(file, note_)) throw std::runtime_error("its resource note.txt is missing");
    output("note", note_).exact().depends_on({});
  }
  void step(stride::Step&) override {}

 private:
  std::string note_;
};

}  // namespace

STRIDE_UNIT(Stateless)
