// Functions of C and a class of C++ with the names that zlib, libmd and tinyxml2 have, and with
// other arguments.
#include <string>

#include "tests/test_units/own_symbols/own_symbols.h"

extern "C" double compress(double volume);
extern "C" double compress(double volume) { return volume / 2; }

struct Sensor {
  double offset;
};
extern "C" double MD5Init(const Sensor& sensor);
extern "C" double MD5Init(const Sensor& sensor) { return sensor.offset; }

namespace tinyxml2 {

class XMLDocument {
 public:
  XMLDocument(bool is_long, int pages);
  virtual ~XMLDocument();
  virtual void Clear();
  double pages() const { return pages_; }

 private:
  double pages_;
};

XMLDocument::XMLDocument(bool is_long, int pages) : pages_(is_long ? 100 : pages) {}
XMLDocument::~XMLDocument() = default;
void XMLDocument::Clear() { pages_ = 0; }

}  // namespace tinyxml2

OwnSymbols call_own_symbols() {
  const double volume = compress(6);
  const double offset = MD5Init({0.25});
  const tinyxml2::XMLDocument document(false, 7);
  // the program has functions of the standard library's templates, too
  std::string text("tank");
  text.append(" and ").append("pump");
  const bool is_text = text.compare("tank and pump") == 0;
  return {4, (volume == 3) + (offset == 0.25) + (document.pages() == 7) + is_text, volume};
}
