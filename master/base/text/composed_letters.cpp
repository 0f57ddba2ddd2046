#include "master/base/text/composed_letters.h"

#include <cstddef>

namespace stride::core {
namespace {

/// A mark behind one of the bases makes the letter in the same place, which has two bytes, as the
/// mark has.
struct Mark {
  std::string_view mark;
  std::string_view bases;
  std::string_view letters;
};

constexpr std::size_t kBytes = 2;

constexpr Mark kMarks[] = {
    {"\u0300", "AEIOUaeiou", "ÀÈÌÒÙàèìòù"},
    {"\u0301", "AEIOUYaeiouyCcLlNnRrSsZz", "ÁÉÍÓÚÝáéíóúýĆćĹĺŃńŔŕŚśŹź"},
    {"\u0302", "AEIOUaeiouCcGgHhJjSsWwYy", "ÂÊÎÔÛâêîôûĈĉĜĝĤĥĴĵŜŝŴŵŶŷ"},
    {"\u0303", "ANOanoIiUu", "ÃÑÕãñõĨĩŨũ"},
    {"\u0304", "AaEeIiOoUu", "ĀāĒēĪīŌōŪū"},
    {"\u0306", "AaEeGgIiOoUu", "ĂăĔĕĞğĬĭŎŏŬŭ"},
    {"\u0307", "CcEeGgIZz", "ĊċĖėĠġİŻż"},
    {"\u0308", "AEIOUaeiouyY", "ÄËÏÖÜäëïöüÿŸ"},
    {"\u030A", "AaUu", "ÅåŮů"},
    {"\u030B", "OoUu", "ŐőŰű"},
    {"\u030C", "CcDdEeLlNnRrSsTtZzAaIiOoUuGgKkj", "ČčĎďĚěĽľŇňŘřŠšŤťŽžǍǎǏǐǑǒǓǔǦǧǨǩǰ"},
    {"\u0326", "SsTt", "ȘșȚț"},
    {"\u0327", "CcGgKkLlNnRrSsTt", "ÇçĢģĶķĻļŅņŖŗŞşŢţ"},
    {"\u0328", "AaEeIiUuOo", "ĄąĘęĮįŲųǪǫ"},
};

void compose(std::string& text, const Mark& kind) {
  for (std::size_t at = 1; (at = text.find(kind.mark, at)) != text.npos;) {
    const std::size_t place = kind.bases.find(text[at - 1]);
    if (place == kind.bases.npos) {
      ++at;
    } else {
      text.replace(at - 1, 1 + kBytes, kind.letters.substr(kBytes * place, kBytes));
    }
  }
}

}  // namespace

std::string composed(std::string_view text) {
  std::string result(text);
  for (const Mark& kind : kMarks) compose(result, kind);
  return result;
}

}  // namespace stride::core
