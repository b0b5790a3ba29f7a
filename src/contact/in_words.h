#pragma once

#include <string>
#include <vector>

#include "tourmaline/case/contact_case.h"

namespace tourmaline::contact {

/// The laws of a contact and what they are asked with, a text each: normal law, gap, foundation,
/// friction, heat. `friction_name`: of laws that a program brought along instead of the case's; "":
/// none. UTF-8.
std::vector<std::string> in_words(const casefile::ContactCase &asked,
                                  const std::string &friction_name, bool is_thermal);

}  // namespace tourmaline::contact
