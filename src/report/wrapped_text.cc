#include "report/wrapped_text.h"

namespace tourmaline::report {
namespace {

/// The text in pieces, each with the letters of `ends` behind it.
std::vector<std::string> split_behind(const std::string &text, const std::string &ends) {
  std::vector<std::string> pieces;
  for (std::size_t from = 0; from < text.size();) {
    std::size_t end = text.find_first_of(ends, from);
    end = end == std::string::npos ? text.size() : text.find_first_not_of(ends, end);
    end = end == std::string::npos ? text.size() : end;
    pieces.push_back(text.substr(from, end - from));
    from = end;
  }
  return pieces;
}

/// One letter each, however many bytes it has.
std::vector<std::string> letters_of(const std::string &text) {
  std::vector<std::string> letters;
  for (const char byte : text)
    if (!letters.empty() && (static_cast<unsigned char>(byte) & 0xc0) == 0x80)
      letters.back() += byte;
    else
      letters.emplace_back(1, byte);
  return letters;
}

std::string without_blanks_behind(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

class FilledLines {
 public:
  FilledLines(double room, const std::function<double(const std::string &)> &width)
      : room_(room), width_(width) {}

  void add_word(const std::string &word) {
    if (!fits(lines_.back() + word) && fits(word))
      lines_.emplace_back();
    if (fits(lines_.back() + word)) {
      lines_.back() += word;
      return;
    }
    for (const std::string &piece : split_behind(word, ",;+*/()=<>&|?:^"))
      add_piece(piece);
  }

  std::vector<std::string> all() const {
    std::vector<std::string> all;
    for (const std::string &line : lines_)
      if (const std::string text = without_blanks_behind(line); !text.empty() || all.empty())
        all.push_back(text);
    return all;
  }

 private:
  bool fits(const std::string &line) const { return width_(without_blanks_behind(line)) <= room_; }

  void add_piece(const std::string &piece) {
    if (!fits(lines_.back() + piece) && fits(piece))
      lines_.emplace_back();
    if (fits(lines_.back() + piece))
      lines_.back() += piece;
    else
      for (const std::string &letter : letters_of(piece)) {
        if (!lines_.back().empty() && !fits(lines_.back() + letter))
          lines_.emplace_back();
        lines_.back() += letter;
      }
  }

  double room_;
  const std::function<double(const std::string &)> &width_;
  std::vector<std::string> lines_{""};
};

}  // namespace

std::vector<std::string> wrapped(const std::string &text, double room,
                                 const std::function<double(const std::string &)> &width) {
  FilledLines lines(room, width);
  for (const std::string &word : split_behind(text, " "))
    lines.add_word(word);
  return lines.all();
}

}  // namespace tourmaline::report
