#include "tourmaline/output/records.h"

namespace tourmaline::output {

const char *name_of(ContactStatus status) {
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

}  // namespace tourmaline::output
