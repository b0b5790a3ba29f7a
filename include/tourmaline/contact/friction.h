#pragma once

#include <variant>

#include "tourmaline/case/case.h"
#include "tourmaline/contact/tresca.h"

namespace tourmaline::contact {

/// The friction laws there are. A new law is its file, its place here, and its line in
/// `friction_at`. A law is convex in the slip increment and offers what Tresca offers; no friction
/// is the bound zero.
using Friction = std::variant<Tresca>;

/// The law at one point and time. Throws CaseError for a negative bound.
Friction friction_at(const casefile::FrictionCase &asked, const output::Vector &point, double time);

}  // namespace tourmaline::contact
