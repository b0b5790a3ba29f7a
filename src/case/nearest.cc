#include "case/nearest.h"

#include <algorithm>
#include <cctype>

namespace tourmaline::casefile {

namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Short names allow one slip, longer ones a third of their letters.
int slips_allowed(const std::string &name) {
  return name.size() <= 3 ? 1 : std::max(2, static_cast<int>(name.size()) / 3);
}

}  // namespace

int edit_distance(const std::string &one, const std::string &other) {
  const std::string a = lower(one), b = lower(other);
  const std::size_t rows = a.size() + 1, columns = b.size() + 1;
  std::vector<int> table(rows * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> int & { return table[i * columns + j]; };
  for (std::size_t i = 0; i < rows; ++i)
    at(i, 0) = static_cast<int>(i);
  for (std::size_t j = 0; j < columns; ++j)
    at(0, j) = static_cast<int>(j);
  for (std::size_t i = 1; i < rows; ++i)
    for (std::size_t j = 1; j < columns; ++j) {
      const int replaced = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return table.back();
}

std::optional<std::string> nearest(const std::string &name,
                                   const std::vector<std::string> &candidates) {
  // A pasted paragraph is no misspelt name, and the table of distances would be large.
  if (name.empty() || name.size() > 64)
    return std::nullopt;
  std::optional<std::string> best;
  int least = slips_allowed(name) + 1;
  for (const std::string &candidate : candidates)
    if (const int distance = edit_distance(name, candidate); distance < least) {
      least = distance;
      best = candidate;
    }
  if (best || name.size() < 3)
    return best;
  // "temp" and "iterations" are abbreviations rather than misspellings.
  for (const std::string &candidate : candidates)
    if (lower(candidate).find(lower(name)) != std::string::npos)
      return candidate;
  return std::nullopt;
}

std::string did_you_mean(const std::string &name, const std::vector<std::string> &candidates) {
  const std::optional<std::string> meant = nearest(name, candidates);
  return meant ? "; did you mean \"" + *meant + "\"?" : "";
}

}  // namespace tourmaline::casefile
