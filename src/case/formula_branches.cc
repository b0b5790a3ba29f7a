#include "formula_branches.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace tourmaline::casefile {

namespace {

using Text = std::string_view;

int step_of(char c) {
  return c == '(' ? 1 : c == ')' ? -1 : 0;
}

// The parts between `mark`s that stand in no parentheses.
std::vector<Text> parts(Text text, Text mark) {
  std::vector<Text> all;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += step_of(text[i]);
    if (depth == 0 && text.substr(i, mark.size()) == mark) {
      all.push_back(text.substr(begin, i - begin));
      begin = i + mark.size();
      i = begin - 1;
    }
  }
  all.push_back(text.substr(begin));
  return all;
}

// Where the ":" stands that belongs to the "?" before `text`.
std::size_t colon_in(Text text) {
  int depth = 0, open = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += step_of(text[i]);
    if (depth == 0 && text[i] == '?')
      ++open;
    if (depth == 0 && text[i] == ':' && open-- == 0)
      return i;
  }
  return text.size();
}

std::size_t end_of_parentheses(Text text, std::size_t begin) {
  int depth = 0;
  std::size_t i = begin;
  do
    depth += step_of(text[i++]);
  while (depth > 0 && i < text.size());
  return i;
}

bool is_part_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Takes a name "if" from the end.
bool take_if(std::string &text) {
  std::size_t end = text.size();
  while (end > 0 && std::isspace(static_cast<unsigned char>(text[end - 1])) != 0)
    --end;
  std::size_t begin = end;
  while (begin > 0 && is_part_of_name(text[begin - 1]))
    --begin;
  if (Text(text).substr(begin, end - begin) != "if")
    return false;
  text.resize(begin);
  return true;
}

std::string lazy(Text text);

// Its parts need no parentheses: `?:` binds weakest, and inside of them it comes from here.
std::string branch(const std::string &condition, const std::string &yes, const std::string &no) {
  return "(" + condition + "?" + yes + ":" + no + ")";
}

std::string lazy_arguments(Text text) {
  std::string all;
  for (const Text argument : parts(text, ","))
    all += (all.empty() ? "" : ",") + lazy(argument);
  return "(" + all + ")";
}

// Without an operator outside of parentheses that this file is about.
std::string lazy_parentheses(Text text) {
  std::string all;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '(') {
      all += text[i++];
      continue;
    }
    const std::size_t end = end_of_parentheses(text, i);
    const Text inside = text.substr(i + 1, end - i - 2);
    i = end;
    if (!take_if(all)) {
      all += lazy_arguments(inside);
      continue;
    }
    const std::vector<Text> given = parts(inside, ",");
    all += branch(lazy(given.at(0)), lazy(given.at(1)), lazy(given.at(2)));
  }
  return all;
}

// `found` decides as soon as it is the truth of a part.
std::string chain(const std::vector<Text> &all, bool found) {
  std::string text = branch(lazy(all.back()), "1", "0");
  for (std::size_t i = all.size() - 1; i-- > 0;)
    text = found ? branch(lazy(all[i]), "1", text) : branch(lazy(all[i]), text, "0");
  return text;
}

// By precedence, the weakest operator first.
std::string lazy(Text text) {
  const Text condition = parts(text, "?").front();
  if (condition.size() < text.size()) {
    const Text rest = text.substr(condition.size() + 1);
    const std::size_t colon = colon_in(rest);
    return branch(lazy(condition), lazy(rest.substr(0, colon)), lazy(rest.substr(colon + 1)));
  }
  if (const auto all = parts(text, "||"); all.size() > 1)
    return chain(all, true);
  if (const auto all = parts(text, "&&"); all.size() > 1)
    return chain(all, false);
  return lazy_parentheses(text);
}

}  // namespace

std::string with_branches(const std::string &text) {
  const auto has = [&](const char *operation) { return text.find(operation) != std::string::npos; };
  return has("if") || has("&&") || has("||") ? lazy(text) : text;
}

int nesting(const std::string &text) {
  int depth = 0, deepest = 0;
  for (const char c : text)
    deepest = std::max(deepest, depth += step_of(c));
  return deepest;
}

}  // namespace tourmaline::casefile
