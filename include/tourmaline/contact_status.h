#pragma once

#include <cstdint>

namespace tourmaline {

/// What a contact point does in a step.
enum class ContactStatus : std::uint8_t { open, stick, slip };

/// As it stands in contact.csv.
constexpr const char *name_of(ContactStatus status) {
  switch (status) {
    case ContactStatus::open:
      return "open";
    case ContactStatus::stick:
      return "stick";
    case ContactStatus::slip:
      return "slip";
  }
  return "unknown";
}

}  // namespace tourmaline
