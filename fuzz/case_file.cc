// Any text is either a case or a CaseError; a case that was read is written as a text that reads
// alike.
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "case/resolved.h"
#include "tourmaline/case/reader.h"
#include "tourmaline/error.h"

namespace {

using namespace tourmaline::casefile;

void check_round_trip(const Case &asked) {
  const std::string text = resolved(asked);
  try {
    if (resolved(read_text(text, "resolved.toml")) == text)
      return;
    std::cerr << "this text reads otherwise than it was written:\n" << text;
  } catch (const tourmaline::CaseError &error) {
    std::cerr << "this text cannot be read again: " << error.what() << '\n' << text;
  }
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  try {
    check_round_trip(read_text(std::string(data, data + size), "case.toml"));
  } catch (const tourmaline::CaseError &) {
  }
  return 0;
}
