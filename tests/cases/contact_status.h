#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "read_table.h"

namespace tourmaline::verified {

/// Whether any row of contact.csv has it.
inline bool has_status(const Table &contact, const std::string &status) {
  const std::vector<std::string> &all = contact.columns.at("status");
  return std::find(all.begin(), all.end(), status) != all.end();
}

inline void expect_every_status(const Table &contact) {
  for (const char *status : {"stick", "slip", "open"})
    EXPECT_TRUE(has_status(contact, status)) << status;
}

}  // namespace tourmaline::verified
