#include "contact/kinds.h"

#include <algorithm>

namespace tourmaline::contact {

namespace {

// The schema lets no other names through.
template <class Kinds>
const auto &named(const std::string &name, const Kinds &kinds) {
  return **std::find_if(kinds.begin(), kinds.end(), [&](auto *kind) { return kind->name == name; });
}

}  // namespace

const NormalKind &kind_of(const casefile::NormalCase &asked) {
  return named(asked.law, normal_kinds::all);
}

const FrictionKind &kind_of(const casefile::FrictionCase &asked) {
  return named(asked.law, friction_kinds::all);
}

}  // namespace tourmaline::contact
