#pragma once

#include <ostream>
#include <streambuf>
#include <string>

/// While it lives, what goes to the stream cannot command a terminal: titles, names, formulas and
/// file names are a user's, who may have them from somebody else. Control characters but for line
/// breaks and tabs, characters that turn the direction of writing, and bytes that are not UTF-8 are
/// written as \u001B or \xE9.
class PrintableOutput : public std::streambuf {
 public:
  explicit PrintableOutput(std::ostream &stream);
  ~PrintableOutput() override;
  PrintableOutput(const PrintableOutput &) = delete;
  PrintableOutput &operator=(const PrintableOutput &) = delete;

 protected:
  int_type overflow(int_type c) override;
  int sync() override;

 private:
  bool put(const std::string &text);
  bool put_byte(unsigned char byte);
  bool put_unfinished();

  std::ostream &stream_;
  std::streambuf *behind_;
  std::string character_;   ///< the bytes so far of one that is not complete
  std::size_t length_ = 0;  ///< of that one, in bytes
};
