#pragma once

#include <string>

#include "tourmaline/case/formula.h"
#include "tourmaline/vector.h"

/// What a law's formulas in the case file say.
namespace tourmaline::contact {

/// The value at a point and time, which must be at least `least`; `what`: its name in the message.
/// Throws CaseError.
double value_from(double least, const casefile::Formula &formula, const Vector3 &point, double time,
                  const char *what);
/// The same from 0 on; and above 0, of a formula without time.
double not_negative(const casefile::Formula &formula, const Vector3 &point, double time,
                    const char *what);
double positive(const casefile::Formula &formula, const Vector3 &point, const char *what);

/// A constant with its power of ten, or the formula; UTF-8.
std::string text_of(const casefile::Formula &formula);

}  // namespace tourmaline::contact
