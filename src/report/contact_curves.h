#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/canvas.h"
#include "report/result.h"

namespace tourmaline::report {

/// Whether a name that somebody asked for is that of a curve along the contact: contact.COLUMN.
bool is_contact_curve(const std::string &name);

/// The curves that can be drawn, "contact.pressure, contact.gap, ..."; empty where there are none.
std::string contact_curve_names(const Result &result);

/// Draws the column of contact.csv, or `pressure`, along each connected piece of the contact of a
/// plane body, at the end of the step that is nearest to `time` [s], not given: of the last one.
/// Returns the files, contact_COLUMN.svg, of several pieces contact_COLUMN_1.svg, .... Throws
/// CaseError when there is no such curve, MachineError when a file cannot be written.
std::vector<std::filesystem::path> write_contact_curves(const Result &result,
                                                        const std::string &name,
                                                        std::optional<double> time,
                                                        const std::filesystem::path &directory,
                                                        FigureFormat format);

}  // namespace tourmaline::report
