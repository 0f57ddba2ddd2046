#include "units/mujoco_world/robot/line_keeping.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace mujoco_world {
namespace {

class Printer : public tinyxml2::XMLPrinter {
 public:
  Printer() : XMLPrinter(nullptr, true) {}

  // the tag above may still be open, in which an end of line is a blank
  bool VisitEnter(const tinyxml2::XMLElement& element,
                  const tinyxml2::XMLAttribute* attribute) override {
    while (line_ < element.GetLineNum()) Putc('\n');
    return XMLPrinter::VisitEnter(element, attribute);
  }

 protected:
  void Write(const char* data, std::size_t size) override {
    line_ += static_cast<int>(std::count(data, data + size, '\n'));
    XMLPrinter::Write(data, size);
  }
  void Putc(char character) override {
    if (character == '\n') ++line_;
    XMLPrinter::Putc(character);
  }

 private:
  int line_ = 1;
};

}  // namespace

void write_keeping_lines(const tinyxml2::XMLDocument& document, const std::filesystem::path& file) {
  Printer printer;
  document.Accept(&printer);
  std::ofstream stream(file, std::ios::binary);
  stream.write(printer.CStr(), printer.CStrSize() - 1);
  if (!stream.flush()) throw std::runtime_error("cannot write '" + file.string() + "'");
}

}  // namespace mujoco_world
