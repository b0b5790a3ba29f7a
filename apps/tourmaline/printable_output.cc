#include "printable_output.h"

#include <fmt/format.h>

namespace {

// Of the UTF-8 character that begins with this byte; 0: none does.
std::size_t length_of(unsigned char first) {
  if (first < 0x80)
    return 1;
  if (first >= 0xC2 && first < 0xE0)
    return 2;
  if (first >= 0xE0 && first < 0xF0)
    return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

unsigned code_of(const std::string &character) {
  const auto first = static_cast<unsigned char>(character[0]);
  constexpr unsigned char bits[] = {0, 0x7F, 0x1F, 0x0F, 0x07};
  unsigned code = first & bits[character.size()];
  for (std::size_t i = 1; i < character.size(); ++i)
    code = code << 6 | (static_cast<unsigned char>(character[i]) & 0x3F);
  return code;
}

bool is_continuation(unsigned char byte) {
  return (byte & 0xC0) == 0x80;
}

bool is_printable(unsigned code) {
  const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  const bool breaks_line = code == 0x2028 || code == 0x2029;
  const bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) ||
                     code == 0x200E || code == 0x200F || code == 0x061C;
  return code == '\n' || code == '\t' || !(control || breaks_line || turns);
}

std::string as_bytes(const std::string &text) {
  std::string all;
  for (const char c : text)
    all += fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
  return all;
}

// Whether these bytes are the shortest form of a character that there is.
bool is_character(const std::string &bytes) {
  constexpr unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
  const unsigned code = code_of(bytes);
  return code >= least[bytes.size()] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
}

std::string printable(const std::string &character) {
  if (!is_character(character))
    return as_bytes(character);
  const unsigned code = code_of(character);
  return is_printable(code) ? character : fmt::format("\\u{:04X}", code);
}

}  // namespace

PrintableOutput::PrintableOutput(std::ostream &stream) : stream_(stream), behind_(stream.rdbuf()) {
  stream_.rdbuf(this);
}

PrintableOutput::~PrintableOutput() {
  put_unfinished();
  behind_->pubsync();
  stream_.rdbuf(behind_);
}

bool PrintableOutput::put(const std::string &text) {
  const auto size = static_cast<std::streamsize>(text.size());
  return behind_->sputn(text.data(), size) == size;
}

bool PrintableOutput::put_unfinished() {
  const std::string bytes = as_bytes(character_);
  character_.clear();
  return put(bytes);
}

bool PrintableOutput::put_byte(unsigned char byte) {
  if (!character_.empty() && !is_continuation(byte) && !put_unfinished())
    return false;
  if (character_.empty())
    length_ = length_of(byte);
  character_ += static_cast<char>(byte);
  if (length_ == 0)
    return put_unfinished();
  if (character_.size() < length_)
    return true;
  const std::string whole = printable(character_);
  character_.clear();
  return put(whole);
}

PrintableOutput::int_type PrintableOutput::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof()))
    return traits_type::not_eof(c);
  const auto byte = static_cast<unsigned char>(traits_type::to_char_type(c));
  return put_byte(byte) ? c : traits_type::eof();
}

// What is unfinished waits for its end, which may come with the next text.
int PrintableOutput::sync() {
  return behind_->pubsync();
}
