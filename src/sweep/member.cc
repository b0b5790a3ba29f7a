#include "sweep/member.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

#include "tourmaline/error.h"

namespace tourmaline::sweep {

namespace {

constexpr std::size_t most_members = 10000, longest_name = 120;

// "bound" of "contact.friction.bound", as long as no other key ends so.
std::string short_key(const Variation &variation, const std::vector<Variation> &all) {
  const auto last_part = [](const std::string &key) { return key.substr(key.rfind('.') + 1); };
  const std::string last = last_part(variation.key);
  const auto alike = std::count_if(
      all.begin(), all.end(), [&](const Variation &other) { return last_part(other.key) == last; });
  return alike == 1 ? last : variation.key;
}

// Six digits tell a number to people; the table has all of them.
std::string rounded(const std::string &value) {
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool whole = error == std::errc() && end == value.data() + value.size();
  const bool integer = value.find_first_not_of("+-0123456789") == std::string::npos;
  return whole && !integer ? fmt::format("{:.6g}", number) : value;
}

// Of what shells and file systems have no other use for.
std::string plain(const std::string &value) {
  std::string text;
  for (const char c : value)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+')
      text += c;
    else if (!text.empty() && text.back() != '_')
      text += '_';
  while (text.ends_with('_'))
    text.pop_back();
  return text;
}

std::string name_of(const Member &member, const std::vector<Variation> &variations) {
  std::string name;
  for (std::size_t i = 0; i < variations.size(); ++i)
    name += (i == 0 ? "" : "_") + plain(short_key(variations[i], variations)) + "=" +
            plain(rounded(member.values[i]));
  return name.size() > longest_name ? name.substr(0, longest_name) : name;
}

// Values that differ in other characters only, or too far behind, are told apart by a number.
void make_distinct(std::vector<Member> &members) {
  std::set<std::string> taken;
  for (Member &member : members) {
    const std::string name = member.name;
    for (int number = 2; !taken.insert(member.name).second; ++number)
      member.name = fmt::format("{}-{}", name, number);
  }
}

}  // namespace

std::vector<Member> members_of(const std::vector<Variation> &variations) {
  std::vector<Member> all(1);
  for (const Variation &variation : variations) {
    std::vector<Member> longer;
    for (const Member &member : all)
      for (const std::string &value : variation.values) {
        longer.push_back(member);
        longer.back().values.push_back(value);
      }
    all = std::move(longer);
    if (all.size() > most_members)
      throw CaseError(
          fmt::format("--vary: the values make more than {} cases; vary fewer keys or "
                      "give fewer values",
                      most_members));
  }
  for (Member &member : all)
    member.name = name_of(member, variations);
  make_distinct(all);
  return all;
}

std::vector<std::string> overrides_of(const std::vector<Variation> &variations,
                                      const Member &member) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < variations.size(); ++i)
    all.push_back(variations[i].key + "=" + member.values[i]);
  return all;
}

}  // namespace tourmaline::sweep
