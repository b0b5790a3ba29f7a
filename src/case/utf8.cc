#include "case/utf8.h"

#include <fmt/format.h>
#include <utf8.h>

#include <algorithm>

#include "tourmaline/error.h"

namespace tourmaline::casefile {

bool is_utf8(std::string_view text) {
  return utf8::find_invalid(text.begin(), text.end()) == text.end();
}

std::string readable(std::string_view text) {
  std::string all;
  for (auto at = text.begin(); at != text.end();) {
    const auto wrong = utf8::find_invalid(at, text.end());
    all.append(at, wrong);
    at = wrong;
    if (at != text.end())
      all += fmt::format("\\x{:02X}", static_cast<unsigned char>(*at++));
  }
  return all;
}

void require_utf8(std::string_view text, const std::string &file) {
  const auto wrong = utf8::find_invalid(text.begin(), text.end());
  if (wrong == text.end())
    return;
  const auto line = 1 + std::count(text.begin(), wrong, '\n');
  throw CaseError(
      fmt::format("{}:{}: is not UTF-8: there is the byte 0x{:02X}, as in files in Latin-1 or "
                  "UTF-16; save the file as UTF-8",
                  readable(file), line, static_cast<unsigned char>(*wrong)));
}

}  // namespace tourmaline::casefile
